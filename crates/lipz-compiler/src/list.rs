//! Lipz files below a folder in which there are only files and folders, listed without asking about any of them.

use std::path::{Path, PathBuf};

/// A Lipz file and its key, if the path says it.
pub(crate) type ListedFile = (PathBuf, Option<String>);

/// What is below a folder.
pub(crate) struct Listed {
    /// In the order of their paths; in pieces.
    pub(crate) files: Vec<Vec<ListedFile>>,
    /// Hidden files and folders that were passed over.
    pub(crate) hidden_count: usize,
}

/// The Lipz files below `folder`, with the keys that `key` gives them; `None` if something there needs a closer look, such as
/// a link or a folder that cannot be read, and wherever the system does not tell files from folders while it lists them. A
/// [`Walk`](crate::walk::Walk) takes three times as long and can do all that.
#[cfg(not(target_os = "linux"))]
pub(crate) fn plain(
    _folder: &Path,
    _reads_hidden: bool,
    _threads: Option<usize>,
    _key: impl Fn(&Path) -> Option<String> + Sync,
) -> Option<Listed> {
    None
}

#[cfg(target_os = "linux")]
pub(crate) use linux::plain;

#[cfg(target_os = "linux")]
mod linux {
    use super::{Listed, ListedFile, Path, PathBuf};
    use crate::key::EXTENSION;
    use crate::parallel;
    use rustix::fs::{FileType, Mode, OFlags, RawDir, open};
    use rustix::io::retry_on_intr;
    use std::ffi::OsString;
    use std::os::unix::ffi::{OsStrExt, OsStringExt};

    /// Bytes of a folder that the system tells at a time.
    const AT_ONCE_BYTES: usize = 1 << 15;

    /// So many folders are listed sooner than threads are made for them.
    const FEW_FOLDERS: usize = 100;

    /// What is in a folder.
    #[derive(Default)]
    struct Folder {
        /// Lipz files in the order of their paths. No folder comes between those of a piece, and none is empty.
        files: Vec<Vec<ListedFile>>,
        folders: Vec<Vec<u8>>,
        hidden_count: usize,
    }

    /// A folder or a Lipz file.
    struct Entry {
        /// That of a folder ends with `/`, so that it is where all paths below it are when it is sorted.
        path: Vec<u8>,
        is_folder: bool,
    }

    pub(crate) fn plain(
        folder: &Path,
        reads_hidden: bool,
        threads: Option<usize>,
        key: impl Fn(&Path) -> Option<String> + Sync,
    ) -> Option<Listed> {
        let mut path = folder.as_os_str().as_bytes().to_vec();
        if path.last() != Some(&b'/') {
            path.push(b'/');
        }
        let mut listed = Listed { files: Vec::new(), hidden_count: 0 };
        let mut level = vec![path];
        while !level.is_empty() {
            let buffer = || Vec::with_capacity(AT_ONCE_BYTES);
            let list = |buffer: &mut _, path: &Vec<u8>| list(path, reads_hidden, buffer, &key);
            let all = || parallel::map_init(&level, buffer, list);
            let found: Option<Vec<Folder>> =
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
    ) -> Option<Folder> {
        let open = || open(folder, OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC, Mode::empty());
        let open = retry_on_intr(open).ok()?;
        let mut found = RawDir::new(open, buffer.spare_capacity_mut());
        let mut listed = Folder::default();
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
                FileType::Directory => entries.push(Entry { path: [folder, name, b"/"].concat(), is_folder: true }),
                FileType::RegularFile if is_lipz(name) => {
                    entries.push(Entry { path: [folder, name].concat(), is_folder: false });
                }
                FileType::Symlink | FileType::Unknown => return None,
                _ => {}
            }
        }
        // All start with the path of the folder.
        entries.sort_unstable_by(|a, b| a.path[folder.len()..].cmp(&b.path[folder.len()..]));
        let mut piece = Vec::new();
        for Entry { path, is_folder } in entries {
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
    use super::{ListedFile, plain};
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

    /// The same by a list.
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
