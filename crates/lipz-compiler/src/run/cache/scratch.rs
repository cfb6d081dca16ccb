//! Buffers of a thread that examines one file after the other.

use super::stamps::CacheFileName;
use crate::files::FileMeta;
use crate::files::FileReader;
use std::path::Path;

/// State that is kept from one file to the next.
#[derive(Default)]
pub(super) struct Scratch {
    /// A buffer for a path and a key.
    buffer: Vec<u8>,
    /// The number of the stamp that the next file probably has in the cache; `None` before the first one.
    next_stamp: Option<usize>,
}

impl Scratch {
    /// Returns the metadata of the file at `path`, using the folder in which `reader` will open it.
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

    /// Returns the name of the file at `path`, whose clip has this key.
    pub(super) fn name(&mut self, path: &Path, key: &str) -> CacheFileName {
        CacheFileName::new(path.as_os_str().as_encoded_bytes(), key, &mut self.buffer)
    }

    /// Returns the number of the stamp that a file probably has, for the caller to advance; for the first file,
    /// `index`.
    pub(super) fn next_stamp(&mut self, index: usize) -> &mut usize {
        self.next_stamp.get_or_insert(index)
    }
}
