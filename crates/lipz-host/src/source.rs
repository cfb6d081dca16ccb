//! The sources of a dialogue's files.

use crate::FileBytes;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file of a dialogue: a path, or bytes with a name, such as a file in an engine's archive.
///
/// Paths convert to sources automatically. Bytes belong to one version: [`Dialogue::refresh`](crate::Dialogue::refresh)
/// does not change them.
///
/// ```
/// use lipz_host::Source;
/// let from_disk = Source::from("dialogue.lipzbank");
/// let from_archive = Source::bytes("dialogue.lipzbank", vec![0; 16]);
/// ```
#[derive(Clone, Debug)]
pub struct Source {
    path: PathBuf,
    bytes: Option<Arc<FileBytes>>,
}

impl Source {
    /// Returns a source of bytes with the name of their file. The index of a set finds its banks by their names: pass
    /// them as separate sources, anywhere in the list.
    pub fn bytes(name: impl Into<PathBuf>, bytes: impl Into<FileBytes>) -> Source {
        Source { path: name.into(), bytes: Some(Arc::new(bytes.into())) }
    }

    /// Returns the path or the name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the bytes, unless the source is a path.
    pub(crate) fn contents(&self) -> Option<&Arc<FileBytes>> {
        self.bytes.as_ref()
    }
}

macro_rules! from_paths {
    ($($path:ty),+) => {
        $(impl From<$path> for Source {
            fn from(path: $path) -> Source {
                Source { path: PathBuf::from(path), bytes: None }
            }
        })+
    };
}

from_paths!(&str, String, &String, &Path, PathBuf);

impl From<&PathBuf> for Source {
    fn from(path: &PathBuf) -> Source {
        Source::from(path.as_path())
    }
}
