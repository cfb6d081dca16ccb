//! Folders with all that is in them: links are followed, hidden files and folders are not looked at.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, IntoIter, WalkDir};

/// So often one folder is entered, by as many ways through links. Few links between folders make more ways than
/// anybody waits for: two in each of twenty folders, a million.
const MOST_WAYS: usize = 100;

/// All files and folders in a folder, in the order of their paths.
pub(crate) struct Walk {
    entries: IntoIter,
    reads_hidden: bool,
    /// Whether a link has led to a folder: without one, each folder is entered once.
    has_linked: bool,
    ways: HashMap<Identity, usize>,
    /// Hidden files and folders that were passed over.
    pub(crate) hidden_count: usize,
}

/// What a walk cannot go through.
#[derive(Debug)]
pub(crate) enum Obstacle {
    /// The file system refuses it.
    Error(walkdir::Error),
    /// Too many ways lead to this folder. The walk ends there.
    TooManyWays(PathBuf),
}

/// A folder by whichever path.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

impl Walk {
    /// `folder` itself may be hidden: it is named.
    pub(crate) fn new(folder: &Path, reads_hidden: bool) -> Walk {
        let by_path = |a: &DirEntry, b: &DirEntry| a.path().as_os_str().cmp(b.path().as_os_str());
        let entries = WalkDir::new(folder).follow_links(true).sort_by(by_path).into_iter();
        Walk { entries, reads_hidden, has_linked: false, ways: HashMap::new(), hidden_count: 0 }
    }

    /// Whether a name is that of something hidden which is not to be read.
    fn passes_over(&self, name: Option<&OsStr>) -> bool {
        !self.reads_hidden && name.is_some_and(is_hidden)
    }

    /// Whether a folder is entered once too often.
    fn is_entered_too_often(&mut self, entry: &DirEntry) -> bool {
        self.has_linked |= entry.path_is_symlink();
        let Some(identity) = self.has_linked.then(|| identity(entry)).flatten() else { return false };
        let ways = self.ways.entry(identity).or_default();
        *ways += 1;
        *ways > MOST_WAYS
    }
}

impl Iterator for Walk {
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
                // Other folders have as many ways by then.
                self.entries = WalkDir::new(entry.path()).max_depth(0).into_iter();
                self.entries.next();
                return Some(Err(Obstacle::TooManyWays(entry.into_path())));
            }
            return Some(Ok(entry));
        }
    }
}

/// Whether a file or folder with this name is hidden: on all systems alike.
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
