//! Listing the Lipz files below a folder that contains only files and folders, without querying each of them.

use std::path::{Path, PathBuf};

/// A Lipz file, and its key if its path determines it.
pub(crate) type ListedFile = (PathBuf, Option<String>);

/// The contents of a folder.
pub(crate) struct FileListing {
    /// Sorted by path, in pieces.
    pub(crate) files: Vec<Vec<ListedFile>>,
    /// The number of skipped hidden files and folders.
    pub(crate) hidden_count: usize,
}

/// Returns the Lipz files below `folder`, with keys from `key`. Returns `None` if an entry needs further examination,
/// such as a link or an unreadable folder, and on systems that do not distinguish files from folders in listings. A
/// [`FolderWalk`](crate::sources::walk::FolderWalk) handles all of that, but takes three times as long.
#[cfg(not(target_os = "linux"))]
pub(crate) fn plain(
    _folder: &Path,
    _reads_hidden: bool,
    _threads: Option<usize>,
    _key: impl Fn(&Path) -> Option<String> + Sync,
) -> Option<FileListing> {
    None
}

#[cfg(target_os = "linux")]
pub(crate) use linux::plain;

#[cfg(target_os = "linux")]
mod linux {
    use super::{FileListing, ListedFile, Path, PathBuf};
    use crate::sources::key::EXTENSION;
    use crate::util::parallel;
    use rustix::fs::{FileType, Mode, OFlags, RawDir, open};
    use rustix::io::retry_on_intr;
    use std::ffi::OsString;
    use std::os::unix::ffi::{OsStrExt, OsStringExt};

    /// The number of bytes of a listing that the system returns at a time.
    const AT_ONCE_BYTES: usize = 1 << 15;

    /// The number of folders that are listed faster than threads are started.
    const FEW_FOLDERS: usize = 100;

    /// The entries of a folder.
    #[derive(Default)]
    struct ListedFolder {
        /// Lipz files, sorted by path. No folder is sorted between those of a piece, and no piece is empty.
        files: Vec<Vec<ListedFile>>,
        folders: Vec<Vec<u8>>,
        hidden_count: usize,
    }

    /// A folder or a Lipz file.
    struct FolderEntry {
        /// The path. That of a folder ends with `/`, so that it is sorted among the paths below it.
        path: Vec<u8>,
        is_folder: bool,
    }

    pub(crate) fn plain(
        folder: &Path,
        reads_hidden: bool,
        threads: Option<usize>,
        key: impl Fn(&Path) -> Option<String> + Sync,
    ) -> Option<FileListing> {
        let mut path = folder.as_os_str().as_bytes().to_vec();
        if path.last() != Some(&b'/') {
            path.push(b'/');
        }
        let mut listed = FileListing { files: Vec::new(), hidden_count: 0 };
        let mut level = vec![path];
        while !level.is_empty() {
            let buffer = || Vec::with_capacity(AT_ONCE_BYTES);
            let list = |buffer: &mut _, path: &Vec<u8>| list(path, reads_hidden, buffer, &key);
            let all = || parallel::map_init(&level, buffer, list);
            let found: Option<Vec<ListedFolder>> =
                if level.len() <= FEW_FOLDERS { all() } else { parallel::in_pool(threads, all) };
            level.clear();
            for folder in found? {
                listed.files.extend(folder.files);
                level.extend(folder.folders);
                listed.hidden_count += folder.hidden_count;
            }
        }
        listed.files.sort_unstable_by(|a, b| path_bytes(&a[0]).cmp(path_bytes(&b[0])));
        Some(listed)
    }

    fn path_bytes((path, _): &ListedFile) -> &[u8] {
        path.as_os_str().as_bytes()
    }

    /// Lists a folder.
    fn list(
        folder: &[u8],
        reads_hidden: bool,
        buffer: &mut Vec<u8>,
        key: impl Fn(&Path) -> Option<String>,
    ) -> Option<ListedFolder> {
        let open = || open(folder, OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC, Mode::empty());
        let open = retry_on_intr(open).ok()?;
        let mut found = RawDir::new(open, buffer.spare_capacity_mut());
        let mut listed = ListedFolder::default();
        let mut entries = Vec::new();
        while let Some(entry) = found.next() {
            let entry = entry.ok()?;
            let name = entry.file_name().to_bytes();
            if matches!(name, b"." | b"..") {
                continue;
            }
            if name.starts_with(b".") && !reads_hidden {
                listed.hidden_count += 1;
                continue;
            }
            match entry.file_type() {
                FileType::Directory => {
                    entries.push(FolderEntry { path: [folder, name, b"/"].concat(), is_folder: true });
                }
                FileType::RegularFile if is_lipz(name) => {
                    entries.push(FolderEntry { path: [folder, name].concat(), is_folder: false });
                }
                FileType::Symlink | FileType::Unknown => return None,
                _ => {}
            }
        }
        // All of them start with the path of the folder.
        entries.sort_unstable_by(|a, b| a.path[folder.len()..].cmp(&b.path[folder.len()..]));
        let mut piece = Vec::new();
        for FolderEntry { path, is_folder } in entries {
            if is_folder {
                listed.files.push(std::mem::take(&mut piece));
                listed.folders.push(path);
            } else {
                let path = PathBuf::from(OsString::from_vec(path));
                let key = key(&path);
                piece.push((path, key));
            }
        }
        listed.files.push(piece);
        listed.files.retain(|files| !files.is_empty());
        Some(listed)
    }

    /// Whether a file name has the extension of Lipz files, with at least one character before the dot.
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
    use super::{ListedFile, plain};
    use crate::sources::walk::FolderWalk;
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

    /// Returns the files found by a walk, sorted by path, and the number of hidden entries.
    fn walked(folder: &Path, reads_hidden: bool) -> (Vec<PathBuf>, usize) {
        let mut walk = FolderWalk::new(folder, reads_hidden);
        let is_lipz = |path: &Path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lipz"));
        let entries = (&mut walk).map(Result::unwrap).filter(|entry| entry.file_type().is_file());
        let mut files: Vec<_> = entries.map(walkdir::DirEntry::into_path).filter(|path| is_lipz(path)).collect();
        files.sort_by(|a, b| a.as_os_str().cmp(b.as_os_str()));
        (files, walk.hidden_count)
    }

    /// Returns the same from a listing.
    fn listed(folder: &Path, reads_hidden: bool) -> Option<(Vec<PathBuf>, usize)> {
        let listed = plain(folder, reads_hidden, Some(2), |path| path.to_str().map(str::to_owned))?;
        let hidden_count = listed.hidden_count;
        let path = |(path, key): ListedFile| {
            assert_eq!(path.to_str(), key.as_deref());
            path
        };
        Some((listed.files.into_iter().flatten().map(path).collect(), hidden_count))
    }

    #[test]
    fn a_list_is_what_a_walk_finds_in_the_order_of_paths() {
        let folder = tree();
        for folder in [folder.path().to_owned(), folder.path().join("a"), folder.path().join("empty")] {
            for reads_hidden in [false, true] {
                let listed = listed(&folder, reads_hidden).unwrap();
                assert_eq!(listed, walked(&folder, reads_hidden));
            }
        }
    }

    #[test]
    fn what_needs_a_closer_look_is_left_to_a_walk() {
        let folder = tree();
        assert!(listed(&folder.path().join("none"), false).is_none());
        assert!(listed(&folder.path().join("a.lipz"), false).is_none());
        std::os::unix::fs::symlink("../a", folder.path().join("z/.link")).unwrap();
        assert!(listed(folder.path(), false).is_some(), "what is passed over");
        assert!(listed(folder.path(), true).is_none());
        std::os::unix::fs::symlink("../a", folder.path().join("z/link")).unwrap();
        assert!(listed(folder.path(), false).is_none());
    }

    #[test]
    fn many_folders_are_listed_in_order() {
        let folder = tempfile::tempdir().unwrap();
        for name in (0..300).flat_map(|number| [format!("{number}/a/b.lipz"), format!("{number}/a.lipz")]) {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "{}").unwrap();
        }
        assert_eq!(listed(folder.path(), false), Some(walked(folder.path(), false)));
    }
}
