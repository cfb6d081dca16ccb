//! The folder of the last file, kept open: opening a file by name in an open folder takes two thirds of the time of a
//! path.

use std::ffi::OsStr;
use std::fs::File;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;

/// The last folder in which a thread found a file.
#[derive(Debug, Default)]
pub(crate) struct LastFolder {
    /// Its path with a final `/`; empty at first.
    path: Vec<u8>,
    open: Option<File>,
}

impl LastFolder {
    /// Returns the open folder of the file at `path` and the name of the file in it; `None` if the whole path must be
    /// used.
    pub(crate) fn of<'p>(&mut self, path: &'p Path) -> Option<(&File, &'p OsStr)> {
        // Use bytes, because splitting a path into components costs as much as several system calls.
        let bytes = path.as_os_str().as_bytes();
        let (folder, name) = bytes.split_at(memchr::memrchr(b'/', bytes)? + 1);
        if self.path != folder {
            self.open = File::open(OsStr::from_bytes(folder)).ok();
            folder.clone_into(&mut self.path);
        }
        let open = self.open.as_ref().filter(|_| !name.is_empty())?;
        Some((open, OsStr::from_bytes(name)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn files_are_found_in_the_folder_of_their_path() {
        let scene = tempfile::tempdir().unwrap();
        for name in ["a/one", "a/two", "b/one"] {
            let path = scene.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, name).unwrap();
        }
        let mut folder = LastFolder::default();
        for name in ["a/one", "a/two", "b/one", "a//one", "b/../a/two"] {
            let path = scene.path().join(name);
            let (open, name) = folder.of(&path).unwrap();
            let file = rustix::fs::openat(open, name, rustix::fs::OFlags::RDONLY, rustix::fs::Mode::empty()).unwrap();
            let mut found = String::new();
            File::from(file).read_to_string(&mut found).unwrap();
            assert_eq!(found, std::fs::read_to_string(path).unwrap());
        }
        for path in ["one", "", "none/one"] {
            assert!(folder.of(Path::new(path)).is_none(), "{path}");
        }
        assert!(folder.of(&scene.path().join("a/")).is_none(), "no name");
    }
}
