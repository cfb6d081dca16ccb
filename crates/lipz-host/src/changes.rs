//! What a refresh has changed.

use std::path::{Path, PathBuf};

/// The files that a [refresh](crate::Dialogue::refresh) has taken in.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Changes {
    files: Vec<PathBuf>,
}

impl Changes {
    pub(crate) fn new(files: Vec<PathBuf>) -> Changes {
        Changes { files }
    }

    /// Whether all files are as before. Then all handles still count.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// The files that are new or have changed, and banks that a set no longer names.
    pub fn files(&self) -> impl ExactSizeIterator<Item = &Path> {
        self.files.iter().map(PathBuf::as_path)
    }
}
