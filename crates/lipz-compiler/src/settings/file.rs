//! The file `lipz.toml`: read, with every diagnostic at its place.

use super::{Settings, reading};
use crate::discover::{display, plain};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The longest settings file that is read: what is longer was named by mistake.
const MAX_BYTES: u64 = 1 << 20;

impl Settings {
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
        let mut diagnostics = Vec::new();
        let settings = match lipz_file::decode_marked(bytes, &mut diagnostics) {
            Some(text) => reading::read(text, folder, &mut diagnostics),
            None => Settings::default(),
        };
        settings.options.levels.apply(&mut diagnostics);
        diagnostics.sort_by_key(Diagnostic::start);
        (settings, Report::from_bytes(name, bytes, diagnostics))
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

/// The path of `name`, which counts from `folder`.
pub(super) fn inside(folder: &Path, name: &str) -> PathBuf {
    plain(&folder.join(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_too_long_is_not_read() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let diagnostics = || Settings::read(file.path()).1.diagnostics;
        file.as_file().set_len(MAX_BYTES).unwrap();
        assert!(diagnostics().iter().all(|diagnostic| diagnostic.code != Code::SettingsUnreadable));
        file.as_file().set_len(MAX_BYTES + 1).unwrap();
        assert!(diagnostics().iter().any(|diagnostic| diagnostic.code == Code::SettingsUnreadable));
    }
}
