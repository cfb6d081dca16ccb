//! Search for the settings file of a project, even without the feature `settings`, to report that it is not read.

use super::Settings;
use crate::files::path::plain;
use std::path::{Component, Path, PathBuf};

/// The name of the file that [`Settings::find`] searches for.
pub const FILE_NAME: &str = "lipz.toml";

impl Settings {
    /// Returns the `lipz.toml` of `folder` or of the nearest folder above it that has one. For a relative folder, the
    /// path is relative as well: `../lipz.toml`.
    pub fn find(folder: &Path) -> Option<PathBuf> {
        let folders = std::iter::successors(Some(plain(folder)), |folder| above(folder));
        folders.map(|folder| plain(&folder.join(FILE_NAME))).find(|file| file.is_file())
    }

    /// Returns the settings file of the project of these sources: the nearest one next to or above the first source,
    /// regardless of the working directory. Without sources, that of the current folder.
    pub fn find_of(sources: &[PathBuf]) -> Option<PathBuf> {
        let of_first = || {
            // A pattern or a file belongs to the first existing folder above it.
            let folder = sources.first()?.ancestors().find(|path| path.is_dir())?;
            Settings::find(folder)
        };
        of_first().or_else(|| Settings::find(Path::new(".")))
    }
}

/// Returns the folder above a [`plain`] one; `None` above the topmost.
fn above(folder: &Path) -> Option<PathBuf> {
    match folder.components().next_back()? {
        Component::Normal(_) => folder.parent().map(plain),
        Component::CurDir | Component::ParentDir => {
            let above = plain(&folder.join(".."));
            // The parent of the topmost folder is the folder itself.
            let is_another = above.canonicalize().ok()? != folder.canonicalize().ok()?;
            is_another.then_some(above)
        }
        Component::RootDir | Component::Prefix(_) => None,
    }
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
        let of = |sources: &[PathBuf]| Settings::find_of(sources);
        assert_eq!(of(&[inner.join("**/*.lipz")]), Some(folder.path().join("project/lipz.toml")), "above a pattern");
        assert_eq!(of(&[inner.join("a.lipz"), "/".into()]), of(std::slice::from_ref(&inner)));
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
