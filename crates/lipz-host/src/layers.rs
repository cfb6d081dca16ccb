//! A bank and the layers over it, together with their bytes.

use crate::owned::utf8;
use crate::{FileBytes, OpenError};
use lipz_bank::{Bank, Layers, LayersError};
use self_cell::self_cell;
use std::path::{Path, PathBuf};
use std::{error, fmt};

/// The most banks of a stack that this crate opens.
pub const MAX_LAYERS: usize = 16;

/// A stack of at most [`MAX_LAYERS`] banks.
type Stack<'data> = Layers<'data, MAX_LAYERS>;

self_cell!(
    struct Cell {
        owner: Vec<FileBytes>,
        #[covariant]
        dependent: Stack,
    }
);

/// A bank and the layers over it, together with their bytes: it can be kept, sent to other threads and shared in an
/// [`Arc`](std::sync::Arc).
///
/// ```no_run
/// use lipz_host::{LayersOpenError, OwnedLayers};
///
/// # fn main() -> Result<(), LayersOpenError> {
/// let owned = OwnedLayers::open(["dialogue.lipzbank", "patch-1.1.lipzbank"])?;
/// println!("{} clips", owned.layers().clips().count());
/// # Ok(())
/// # }
/// ```
pub struct OwnedLayers(Cell);

impl OwnedLayers {
    /// Reads the banks at `paths` into memory, the base first, and verifies them.
    ///
    /// # Errors
    /// When one of the files cannot be read, is no bank or a damaged one, or does not fit those before it.
    pub fn open<P: AsRef<Path>>(paths: impl IntoIterator<Item = P>) -> Result<OwnedLayers, LayersOpenError> {
        let paths: Vec<PathBuf> = paths.into_iter().map(|path| path.as_ref().to_owned()).collect();
        let read = |path: &PathBuf| FileBytes::read(path).map_err(|error| LayersOpenError::new(path, error.into()));
        let files = paths.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        OwnedLayers::from_bytes(files).map_err(|error| {
            let path = paths.get(error.layer()).or(paths.last()).cloned().unwrap_or_default();
            LayersOpenError::new(&path, error.error().into())
        })
    }

    /// Verifies the banks that these bytes are, the base first.
    ///
    /// # Errors
    /// When one of them is damaged or does not fit those before it.
    pub fn from_bytes(files: Vec<FileBytes>) -> Result<OwnedLayers, LayersError> {
        let cell = Cell::try_new(files, |files| {
            Layers::from_slice(&files.iter().enumerate().map(verified).collect::<Result<Vec<_>, _>>()?)
        })?;
        Ok(OwnedLayers(cell))
    }

    /// The stack.
    pub fn layers(&self) -> &Layers<'_, MAX_LAYERS> {
        self.0.borrow_dependent()
    }
}

/// The bank in a file, verified.
fn verified((layer, bytes): (usize, &FileBytes)) -> Result<Bank<'_>, LayersError> {
    let bank = Bank::open(bytes).and_then(|bank| bank.verify_with(utf8));
    bank.map_err(|error| LayersError::new(layer, error))
}

/// The banks.
impl fmt::Debug for OwnedLayers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("OwnedLayers").field(self.layers()).finish()
    }
}

/// Why files are not used as a stack, or as a set.
#[derive(Debug)]
pub struct LayersOpenError {
    path: PathBuf,
    error: OpenError,
}

impl LayersOpenError {
    pub(crate) fn new(path: &Path, error: OpenError) -> LayersOpenError {
        LayersOpenError { path: path.to_owned(), error }
    }

    /// The file that is not used.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is wrong with it.
    pub fn error(&self) -> &OpenError {
        &self.error
    }
}

impl fmt::Display for LayersOpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.error)
    }
}

impl error::Error for LayersOpenError {}
