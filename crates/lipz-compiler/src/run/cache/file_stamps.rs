//! Data about files that a run keeps for the next one.

use super::stamps::{CacheFileName, Stamp};

/// The files that a run has stamped or found in the old bank.
#[derive(Default)]
pub(super) struct FileStamps {
    /// The stamps of all files without diagnostics, with the numbers of their inputs.
    pub(super) files: Vec<(u32, CacheFileName, Stamp)>,
    /// Numbers of inputs whose clips are in the old bank.
    pub(super) recalled: Vec<u32>,
    /// The number of those whose files were not read.
    pub(super) unread: usize,
}

impl FileStamps {
    /// Adds the data of another thread.
    pub(super) fn append(&mut self, mut other: FileStamps) {
        self.files.append(&mut other.files);
        self.recalled.append(&mut other.recalled);
        self.unread += other.unread;
    }

    /// Sorts the stamps in the order of the inputs, in which the next run looks them up.
    pub(super) fn sort(&mut self) {
        self.files.sort_unstable_by_key(|(index, ..)| *index);
    }
}
