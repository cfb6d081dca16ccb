//! Where a program gets the files of a dialogue from.

use crate::FileBytes;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file of a dialogue: the path of one, or bytes with a name, such as an engine's archive has them.
///
/// Paths become sources by themselves. Bytes are those of one version: [`Dialogue::refresh`](crate::Dialogue::refresh) leaves
/// them alone.
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
    /// Bytes with the name of the file that they are of. The index of a set finds its banks by their names: give these as
    /// sources of their own, anywhere in the list.
    pub fn bytes(name: impl Into<PathBuf>, bytes: impl Into<FileBytes>) -> Source {
        Source { path: name.into(), bytes: Some(Arc::new(bytes.into())) }
    }

    /// The path or the name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The bytes, unless the source is a path.
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
