//! A bank and the layers over it, together with their bytes.

use crate::owned::utf8;
use crate::{FileBytes, OpenError};
use lipz_bank::{Bank, Error, LayeredLocale, Layers, LayersError, TextBank};
use self_cell::self_cell;
use std::path::{Path, PathBuf};
use std::{error, fmt};

/// The most banks of a stack that this crate opens.
pub const MAX_LAYERS: usize = 16;

/// A stack of at most [`MAX_LAYERS`] banks.
struct Stack<'data> {
    layers: Layers<'data, MAX_LAYERS>,
    texts: Vec<TextBank<'data>>,
    /// The checksums of the files of text banks: one may be beside several banks.
    text_checksums: Vec<u64>,
}

/// The bytes of the banks, and of the text banks beside them.
struct Files {
    banks: Vec<FileBytes>,
    texts: Vec<FileBytes>,
}

self_cell!(
    struct Cell {
        owner: Files,
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
        OwnedLayers::open_with_texts(paths, std::iter::empty())
    }

    /// The same, with the text banks at `texts`: each is verified beside every bank whose clips it is about. A patch of mouths
    /// is one, too, but its texts are those of the bank below it.
    ///
    /// # Errors
    /// As [`open`](OwnedLayers::open), and when a text bank cannot be read, is damaged, or is about the clips of none of the banks.
    pub fn open_with_texts<P: AsRef<Path>>(
        paths: impl IntoIterator<Item = P>,
        texts: impl IntoIterator<Item = P>,
    ) -> Result<OwnedLayers, LayersOpenError> {
        let owned = |path: P| path.as_ref().to_owned();
        let (paths, texts): (Vec<PathBuf>, Vec<PathBuf>) =
            (paths.into_iter().map(owned).collect(), texts.into_iter().map(owned).collect());
        let read = |path: &PathBuf| FileBytes::read(path).map_err(|error| LayersOpenError::new(path, error.into()));
        let files = Files {
            banks: paths.iter().map(read).collect::<Result<Vec<_>, _>>()?,
            texts: texts.iter().map(read).collect::<Result<Vec<_>, _>>()?,
        };
        let cell = Cell::try_new(files, |files| {
            let layers = stack(&files.banks).map_err(|error| {
                let path = paths.get(error.layer()).or(paths.last()).cloned().unwrap_or_default();
                LayersOpenError::new(&path, error.error().into())
            })?;
            let (mut found, mut text_checksums) = (Vec::new(), Vec::new());
            for (bytes, path) in files.texts.iter().zip(&texts) {
                let beside = text_banks(&layers, bytes);
                let beside = beside.map_err(|error| LayersOpenError::new(path, error.into()))?;
                text_checksums.extend(beside.first().map(TextBank::checksum));
                found.extend(beside);
            }
            Ok(Stack { layers, texts: found, text_checksums })
        })?;
        Ok(OwnedLayers(cell))
    }

    /// Verifies the banks that these bytes are, the base first.
    ///
    /// # Errors
    /// When one of them is damaged or does not fit those before it.
    pub fn from_bytes(files: Vec<FileBytes>) -> Result<OwnedLayers, LayersError> {
        let files = Files { banks: files, texts: Vec::new() };
        let cell = Cell::try_new(files, |files| {
            Ok(Stack { layers: stack(&files.banks)?, texts: Vec::new(), text_checksums: Vec::new() })
        })?;
        Ok(OwnedLayers(cell))
    }

    /// The stack.
    pub fn layers(&self) -> &Layers<'_, MAX_LAYERS> {
        &self.0.borrow_dependent().layers
    }

    /// The text banks beside its banks.
    pub fn texts(&self) -> &[TextBank<'_>] {
        &self.0.borrow_dependent().texts
    }

    /// The checksums of the files of text banks, in their order.
    pub(crate) fn text_checksums(&self) -> &[u64] {
        &self.0.borrow_dependent().text_checksums
    }

    /// The locale with this tag, in the banks and in the text banks: [`Layers::locale_in`].
    pub fn locale(&self, tag: &str) -> Option<LayeredLocale<'_, MAX_LAYERS>> {
        self.layers().locale_in(tag, self.texts())
    }
}

/// The stack of these banks, verified.
fn stack(files: &[FileBytes]) -> Result<Layers<'_, MAX_LAYERS>, LayersError> {
    Layers::from_slice(&files.iter().enumerate().map(verified).collect::<Result<Vec<_>, _>>()?)
}

/// The text bank in a file, verified beside each bank whose clips it is about.
fn text_banks<'data>(layers: &Layers<'data, MAX_LAYERS>, bytes: &'data [u8]) -> Result<Vec<TextBank<'data>>, Error> {
    let banks = (0..layers.layer_count()).filter_map(|layer| layers.bank(layer));
    let mut fitting: Vec<_> = banks.filter(|bank| bank.open_texts(bytes).is_ok()).collect();
    if fitting.is_empty() {
        fitting.extend(layers.bank(0)); // which says why
    }
    fitting.into_iter().map(|bank| bank.open_texts(bytes)?.verify_with(bank, utf8)).collect()
}

/// The bank in a file, verified.
fn verified((layer, bytes): (usize, &FileBytes)) -> Result<Bank<'_>, LayersError> {
    let bank = Bank::open(bytes).and_then(|bank| bank.verify_with(utf8));
    bank.map_err(|error| LayersError::new(layer, error))
}

/// The banks.
impl fmt::Debug for OwnedLayers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnedLayers").field("layers", self.layers()).field("texts", &self.texts()).finish()
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
