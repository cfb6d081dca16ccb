//! The changes made by a refresh.

use std::path::{Path, PathBuf};

/// The changed files of a [refresh](crate::Dialogue::refresh).
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Changes {
    files: Vec<PathBuf>,
}

impl Changes {
    pub(crate) fn new(files: Vec<PathBuf>) -> Changes {
        Changes { files }
    }

    /// Whether no file has changed. If so, all handles are still valid.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Returns the files that are new or have changed, and banks that a set no longer names.
    pub fn files(&self) -> impl ExactSizeIterator<Item = &Path> {
        self.files.iter().map(PathBuf::as_path)
    }
}
