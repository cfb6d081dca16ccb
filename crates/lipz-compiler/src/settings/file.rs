//! The file `lipz.toml`: found and read, with every diagnostic at its place.

use super::{Settings, reading};
use crate::discover::{display, plain};
use lipz_diagnostics::{Code, Diagnostic, Report, Source};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

/// Name of the file that [`Settings::find`] looks for.
pub const FILE_NAME: &str = "lipz.toml";

/// The longest settings file that is read: what is longer was named by mistake.
const MAX_BYTES: u64 = 1 << 20;

impl Settings {
    /// The `lipz.toml` of `folder` or of the nearest folder above it that has one. A relative folder
    /// gives a relative path: `../lipz.toml`.
    pub fn find(folder: &Path) -> Option<PathBuf> {
        let folders = std::iter::successors(Some(plain(folder)), |folder| above(folder));
        folders.map(|folder| inside(&folder, FILE_NAME)).find(|file| file.is_file())
    }

    /// Reads the settings file at `path`.
    ///
    /// Paths in the file count from its folder. Settings with diagnostics at error level keep their
    /// defaults; the report says whether there are any.
    pub fn read(path: &Path) -> (Settings, Report) {
        let name = display(path);
        match read_limited(path) {
            Ok(bytes) => Settings::parse(&bytes, name, path.parent().unwrap_or(Path::new(""))),
            Err(error) => (Settings::default(), Report::about(name.as_str(), unreadable(&name, &error))),
        }
    }

    /// Reads the settings in `bytes`, which messages call `name`. Paths in them count from `folder`.
    ///
    /// ```
    /// use lipz_compiler::settings::Settings;
    /// let (settings, report) = Settings::parse(b"sources = [\"voices\"]", "lipz.toml", "game".as_ref());
    /// assert!(report.diagnostics.is_empty());
    /// assert_eq!(settings.sources, [std::path::Path::new("game/voices")]);
    /// ```
    pub fn parse(bytes: &[u8], name: impl Into<String>, folder: &Path) -> (Settings, Report) {
        // A byte order mark is allowed in TOML.
        let bytes = lipz_file::without_byte_order_mark(bytes);
        let mut diagnostics = Vec::new();
        let settings = match lipz_file::decode(bytes, &mut diagnostics) {
            Some(text) => reading::read(text, folder, &mut diagnostics),
            None => Settings::default(),
        };
        settings.options.levels.apply(&mut diagnostics);
        diagnostics.sort_by_key(Diagnostic::start);
        let source = Source::new(name, String::from_utf8_lossy(bytes));
        (settings, Report::new(source, diagnostics))
    }
}

/// The bytes of a settings file; no more than could be one are read.
fn read_limited(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES { Err(io::ErrorKind::FileTooLarge.into()) } else { Ok(bytes) }
}

fn unreadable(name: &str, error: &io::Error) -> Diagnostic {
    let diagnostic =
        |what: &str| Diagnostic::new(Code::SettingsUnreadable, format!("the settings file `{name}` {what}"));
    match error.kind() {
        io::ErrorKind::NotFound => diagnostic("does not exist").help("check the spelling of the path"),
        io::ErrorKind::IsADirectory => diagnostic("is a folder").help("name the file in it"),
        io::ErrorKind::FileTooLarge => diagnostic("is larger than 1 MiB").help("name a settings file: lipz.toml"),
        _ => diagnostic(&format!("cannot be read: {error}")),
    }
}

/// The folder above a [`plain`] one; `None` above the topmost.
fn above(folder: &Path) -> Option<PathBuf> {
    match folder.components().next_back()? {
        Component::Normal(_) => folder.parent().map(plain),
        Component::CurDir | Component::ParentDir => {
            let above = plain(&folder.join(".."));
            // The topmost folder lies above itself.
            let is_another = above.canonicalize().ok()? != folder.canonicalize().ok()?;
            is_another.then_some(above)
        }
        Component::RootDir | Component::Prefix(_) => None,
    }
}

/// The path of `name`, which counts from `folder`.
pub(super) fn inside(folder: &Path, name: &str) -> PathBuf {
    plain(&folder.join(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_file_above_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("project/voices/act1");
        std::fs::create_dir_all(&inner).unwrap();
        assert_eq!(Settings::find(&inner), None);
        std::fs::write(folder.path().join("project/lipz.toml"), "").unwrap();
        assert_eq!(Settings::find(&inner), Some(folder.path().join("project/lipz.toml")));
        let around = inner.join("../../voices");
        assert_eq!(Settings::find(&around), Some(inner.join("../../lipz.toml")), "`..` may be a link: it stays");
        std::fs::create_dir(folder.path().join("project/voices/lipz.toml")).unwrap();
        assert_eq!(Settings::find(&inner), Some(folder.path().join("project/lipz.toml")), "a folder is no file");
    }

    #[test]
    fn a_file_that_is_too_long_is_not_read() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let diagnostics = || Settings::read(file.path()).1.diagnostics;
        file.as_file().set_len(MAX_BYTES).unwrap();
        assert!(diagnostics().iter().all(|diagnostic| diagnostic.code != Code::SettingsUnreadable));
        file.as_file().set_len(MAX_BYTES + 1).unwrap();
        assert!(diagnostics().iter().any(|diagnostic| diagnostic.code == Code::SettingsUnreadable));
    }

    #[test]
    fn folders_above_a_relative_one() {
        let above = |folder: &str| above(Path::new(folder));
        assert_eq!(above("voices/act1"), Some("voices".into()));
        assert_eq!(above("voices"), Some(".".into()));
        assert_eq!(above("."), Some("..".into()));
        assert_eq!(above(".."), Some("../..".into()));
        assert_eq!(above("/"), None);
        let deep = "../".repeat(200);
        assert_eq!(above(&deep), None, "above the root folder");
    }
}
