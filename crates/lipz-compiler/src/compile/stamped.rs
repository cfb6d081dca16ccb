//! What a run leaves of its files for the next one.

use crate::cache::{Name, Stamp};

/// What a run has stamped and found in the old bank.
#[derive(Default)]
pub(crate) struct FileStamps {
    /// The stamps of all files without diagnostics, with the numbers of their inputs.
    pub(crate) files: Vec<(u32, Name, Stamp)>,
    /// Numbers of inputs whose clips are in the old bank.
    pub(crate) recalled: Vec<u32>,
    /// Of these, those whose files were not read.
    pub(crate) unread: usize,
    /// Files that a lint counts.
    pub(crate) marked: usize,
}

impl FileStamps {
    /// Adds what another thread has.
    pub(crate) fn append(&mut self, mut other: FileStamps) {
        self.files.append(&mut other.files);
        self.recalled.append(&mut other.recalled);
        self.unread += other.unread;
        self.marked += other.marked;
    }

    /// Puts the stamps into the order of the inputs, in which the next run looks for them.
    pub(crate) fn sort(&mut self) {
        self.files.sort_unstable_by_key(|(index, ..)| *index);
    }
}
