//! What a thread needs to look at one file after the other.

use super::file_meta::FileMeta;
use super::stamps::Name;
use crate::compile::FileReader;
use std::path::Path;

/// What is kept from one file to the next.
#[derive(Default)]
pub(crate) struct Look {
    /// Room for a path and a key.
    buffer: Vec<u8>,
    /// Number of the stamp that the next file probably has in the cache; `None` before the first one.
    next_stamp: Option<usize>,
}

impl Look {
    /// How the file at `path` looks from outside, in the folder in which `reader` will find it.
    #[cfg(target_os = "linux")]
    pub(super) fn meta(path: &Path, reader: &mut FileReader) -> Option<FileMeta> {
        use rustix::fs::{AtFlags, statat};
        let Some((folder, name)) = reader.folder.of(path) else { return FileMeta::new(&path.metadata().ok()?) };
        FileMeta::of_stat(&rustix::io::retry_on_intr(|| statat(folder, name, AtFlags::empty())).ok()?)
    }

    #[cfg(not(target_os = "linux"))]
    pub(super) fn meta(path: &Path, _reader: &mut FileReader) -> Option<FileMeta> {
        FileMeta::new(&path.metadata().ok()?)
    }

    /// The name of the file at `path`, whose clip has this key.
    pub(super) fn name(&mut self, path: &Path, key: &str) -> Name {
        Name::new(path.as_os_str().as_encoded_bytes(), key, &mut self.buffer)
    }

    /// Number of the stamp that a file probably has, which is to be counted on; that of the first file is `index`.
    pub(super) fn next_stamp(&mut self, index: usize) -> &mut usize {
        self.next_stamp.get_or_insert(index)
    }
}
