//! Folders with all their contents: links are followed, hidden files and folders are skipped.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, IntoIter, WalkDir};

/// The most visits of one folder through different links. A few links between folders can produce endless numbers of
/// paths: with two in each of twenty folders, a million.
const MOST_WAYS: usize = 100;

/// All files and folders in a folder, sorted by path.
pub(crate) struct FolderWalk {
    entries: IntoIter,
    reads_hidden: bool,
    /// Whether a link has led to a folder. Without one, each folder is visited once.
    has_linked: bool,
    ways: HashMap<Identity, usize>,
    /// The number of skipped hidden files and folders.
    pub(crate) hidden_count: usize,
}

/// An obstacle to a walk.
#[derive(Debug)]
pub(crate) enum Obstacle {
    /// The file system reports an error.
    Error(walkdir::Error),
    /// Too many paths lead to this folder. The walk ends there.
    TooManyWays(PathBuf),
}

/// Identifies a folder regardless of its path.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

impl FolderWalk {
    /// Creates a walk. `folder` itself may be hidden, because it was named.
    pub(crate) fn new(folder: &Path, reads_hidden: bool) -> FolderWalk {
        let by_path = |a: &DirEntry, b: &DirEntry| a.path().as_os_str().cmp(b.path().as_os_str());
        let entries = WalkDir::new(folder).follow_links(true).sort_by(by_path).into_iter();
        FolderWalk { entries, reads_hidden, has_linked: false, ways: HashMap::new(), hidden_count: 0 }
    }

    /// Whether a name is hidden and to be skipped.
    fn passes_over(&self, name: Option<&OsStr>) -> bool {
        !self.reads_hidden && name.is_some_and(is_hidden)
    }

    /// Whether a folder has been visited too often.
    fn is_entered_too_often(&mut self, entry: &DirEntry) -> bool {
        self.has_linked |= entry.path_is_symlink();
        let Some(identity) = self.has_linked.then(|| identity(entry)).flatten() else { return false };
        let ways = self.ways.entry(identity).or_default();
        *ways += 1;
        *ways > MOST_WAYS
    }
}

impl Iterator for FolderWalk {
    type Item = Result<DirEntry, Obstacle>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let entry = match self.entries.next()? {
                Ok(entry) => entry,
                Err(error) if error.depth() > 0 && self.passes_over(error.path().and_then(Path::file_name)) => {
                    self.hidden_count += 1;
                    continue;
                }
                Err(error) => return Some(Err(Obstacle::Error(error))),
            };
            let is_folder = entry.file_type().is_dir();
            if entry.depth() > 0 && self.passes_over(Some(entry.file_name())) {
                self.hidden_count += 1;
                if is_folder {
                    self.entries.skip_current_dir();
                }
                continue;
            }
            if is_folder && self.is_entered_too_often(&entry) {
                // By then, other folders have as many paths.
                self.entries = WalkDir::new(entry.path()).max_depth(0).into_iter();
                self.entries.next();
                return Some(Err(Obstacle::TooManyWays(entry.into_path())));
            }
            return Some(Ok(entry));
        }
    }
}

/// Whether a file or folder with this name is hidden, by the same rule on all systems.
pub(crate) fn is_hidden(name: &OsStr) -> bool {
    name.as_encoded_bytes().starts_with(b".")
}

#[cfg(unix)]
fn identity(entry: &DirEntry) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let metadata = entry.path().metadata().ok()?;
    Some((metadata.dev(), metadata.ino()))
}

#[cfg(not(unix))]
fn identity(entry: &DirEntry) -> Option<Identity> {
    entry.path().canonicalize().ok()
}
