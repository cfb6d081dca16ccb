//! Lipz files below a folder in which there are only files and folders, listed without asking about any of them.

use std::path::{Path, PathBuf};

/// What is below a folder.
pub(crate) struct Listed {
    /// In the order of their paths.
    pub(crate) files: Vec<PathBuf>,
    /// Hidden files and folders that were passed over.
    pub(crate) hidden_count: usize,
}

/// The Lipz files below `folder`; `None` if something there needs a closer look, such as a link or a folder that cannot be
/// read, and wherever the system does not tell files from folders while it lists them. A [`Walk`](crate::walk::Walk) takes
/// three times as long and can do all that.
#[cfg(not(target_os = "linux"))]
pub(crate) fn plain(_folder: &Path, _reads_hidden: bool) -> Option<Listed> {
    None
}

#[cfg(target_os = "linux")]
pub(crate) use linux::plain;

#[cfg(target_os = "linux")]
mod linux {
    use super::{Listed, Path, PathBuf};
    use crate::key::EXTENSION;
    use rustix::fs::{FileType, Mode, OFlags, RawDir, open};
    use rustix::io::retry_on_intr;
    use std::ffi::OsString;
    use std::os::unix::ffi::{OsStrExt, OsStringExt};

    /// Bytes of a folder that the system tells at a time.
    const AT_ONCE_BYTES: usize = 1 << 15;

    /// A folder that is not listed yet, or a Lipz file.
    struct Entry {
        /// That of a folder ends with `/`, so that it is where all paths below it are when it is sorted.
        path: Vec<u8>,
        is_folder: bool,
    }

    pub(crate) fn plain(folder: &Path, reads_hidden: bool) -> Option<Listed> {
        let mut path = folder.as_os_str().as_bytes().to_vec();
        if path.last() != Some(&b'/') {
            path.push(b'/');
        }
        let mut listed = Listed { files: Vec::new(), hidden_count: 0 };
        let mut buffer = Vec::with_capacity(AT_ONCE_BYTES);
        let mut pending = vec![Entry { path, is_folder: true }];
        while let Some(Entry { path, is_folder }) = pending.pop() {
            if !is_folder {
                listed.files.push(PathBuf::from(OsString::from_vec(path)));
                continue;
            }
            let first = pending.len();
            listed.hidden_count += list(&path, reads_hidden, &mut buffer, &mut pending)?;
            // The next one last. All start with the path of the folder.
            pending[first..].sort_unstable_by(|a, b| b.path[path.len()..].cmp(&a.path[path.len()..]));
        }
        Some(listed)
    }

    /// Adds what is in a folder, and returns how much of it is hidden.
    fn list(folder: &[u8], reads_hidden: bool, buffer: &mut Vec<u8>, entries: &mut Vec<Entry>) -> Option<usize> {
        let open = || open(folder, OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC, Mode::empty());
        let open = retry_on_intr(open).ok()?;
        let mut found = RawDir::new(open, buffer.spare_capacity_mut());
        let mut hidden_count = 0;
        while let Some(entry) = found.next() {
            let entry = entry.ok()?;
            let name = entry.file_name().to_bytes();
            if matches!(name, b"." | b"..") {
                continue;
            }
            if name.starts_with(b".") && !reads_hidden {
                hidden_count += 1;
                continue;
            }
            match entry.file_type() {
                FileType::Directory => entries.push(Entry { path: [folder, name, b"/"].concat(), is_folder: true }),
                FileType::RegularFile if is_lipz(name) => {
                    entries.push(Entry { path: [folder, name].concat(), is_folder: false });
                }
                FileType::Symlink | FileType::Unknown => return None,
                _ => {}
            }
        }
        Some(hidden_count)
    }

    /// Whether a file with this name is one of ours: the extension, behind a dot that is not all there is before it.
    fn is_lipz(name: &[u8]) -> bool {
        let Some((stem, extension)) = name.len().checked_sub(EXTENSION.len() + 1).map(|at| name.split_at(at)) else {
            return false;
        };
        !stem.is_empty() && extension[0] == b'.' && extension[1..].eq_ignore_ascii_case(EXTENSION.as_bytes())
    }
}

#[cfg(test)]
#[cfg(target_os = "linux")]
mod tests {
    use super::plain;
    use crate::walk::Walk;
    use std::fs;
    use std::path::{Path, PathBuf};

    const NAMES: [&str; 14] = [
        "a.lipz",
        "a-b.lipz",
        "a/b.lipz",
        "a/c/d.LIPZ",
        "a.b/c.lipz",
        "a b.lipz",
        "z/.hidden.lipz",
        ".git/x.lipz",
        "b.lipz/inside.lipz",
        "c.txt",
        "lipz",
        ".lipz",
        "ä.lipz",
        "empty/more/none",
    ];

    fn tree() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for name in NAMES {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "{}").unwrap();
        }
        folder
    }

    /// What a walk finds, in the order of paths, and how much of it is hidden.
    fn walked(folder: &Path, reads_hidden: bool) -> (Vec<PathBuf>, usize) {
        let mut walk = Walk::new(folder, reads_hidden);
        let is_lipz = |path: &Path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lipz"));
        let entries = (&mut walk).map(Result::unwrap).filter(|entry| entry.file_type().is_file());
        let mut files: Vec<_> = entries.map(walkdir::DirEntry::into_path).filter(|path| is_lipz(path)).collect();
        files.sort_by(|a, b| a.as_os_str().cmp(b.as_os_str()));
        (files, walk.hidden_count)
    }

    #[test]
    fn a_list_is_what_a_walk_finds_in_the_order_of_paths() {
        let folder = tree();
        for folder in [folder.path().to_owned(), folder.path().join("a"), folder.path().join("empty")] {
            for reads_hidden in [false, true] {
                let listed = plain(&folder, reads_hidden).unwrap();
                assert_eq!((listed.files, listed.hidden_count), walked(&folder, reads_hidden));
            }
        }
    }

    #[test]
    fn what_needs_a_closer_look_is_left_to_a_walk() {
        let folder = tree();
        assert!(plain(&folder.path().join("none"), false).is_none());
        assert!(plain(&folder.path().join("a.lipz"), false).is_none());
        std::os::unix::fs::symlink("../a", folder.path().join("z/.link")).unwrap();
        assert!(plain(folder.path(), false).is_some(), "what is passed over");
        assert!(plain(folder.path(), true).is_none());
        std::os::unix::fs::symlink("../a", folder.path().join("z/link")).unwrap();
        assert!(plain(folder.path(), false).is_none());
    }
}
