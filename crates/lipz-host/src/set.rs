//! A set of banks, together with the bytes of its index and of all of its banks.

use crate::{FileBytes, LayersOpenError, OpenError};
use lipz_bank::{Bank, BankSet, SetIndex};
use self_cell::self_cell;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The set, whose banks are in the cell below.
type Set<'data> = BankSet<'data, 'data>;

/// Index and banks, whose bytes are in the files.
struct Opened<'data> {
    index: SetIndex<'data>,
    banks: Vec<Bank<'data>>,
}

self_cell!(
    struct Banks {
        owner: Files,
        #[covariant]
        dependent: Opened,
    }
);

self_cell!(
    struct Cell {
        owner: Banks,
        #[covariant]
        dependent: Set,
    }
);

/// The files of a set.
struct Files {
    path: PathBuf,
    index: FileBytes,
    banks: Vec<(PathBuf, FileBytes)>,
}

/// A set of banks (`dialogue.lipzset`) together with the bytes of all of them: it can be kept, sent to other threads and shared in
/// an [`Arc`](std::sync::Arc).
///
/// A program that wants only some of the banks in memory opens the index as [`SetIndex`], and the bank of a clip as
/// [`OwnedBank`](crate::OwnedBank).
///
/// ```no_run
/// use lipz_bank::ClipId;
/// use lipz_host::OwnedSet;
///
/// # fn main() -> Result<(), lipz_host::LayersOpenError> {
/// let owned = OwnedSet::open("dialogue.lipzset")?.verify()?;
/// let clip = owned.set().clip(ClipId::from_key("act1/mara-good-evening"));
/// # let _ = clip;
/// # Ok(())
/// # }
/// ```
pub struct OwnedSet(Cell);

impl OwnedSet {
    /// Reads the index at `path` and the banks beside it into memory, and opens them. The index is verified, which takes no time
    /// to speak of; the banks are not.
    ///
    /// # Errors
    /// When one of the files cannot be read, is refused, or is not the one that the index names.
    pub fn open(path: impl AsRef<Path>) -> Result<OwnedSet, LayersOpenError> {
        OwnedSet::of_newest(path.as_ref(), |path| FileBytes::read(path))
    }

    /// Maps the banks that the index at `path` names, and opens them. The index itself is read.
    ///
    /// # Safety
    /// As for [`FileBytes::map`]: nobody changes or truncates a bank as long as this set exists. `lipz link` gives new banks new
    /// names, and removes the old ones when the new index is there.
    ///
    /// # Errors
    /// As [`open`](OwnedSet::open).
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped(path: impl AsRef<Path>) -> Result<OwnedSet, LayersOpenError> {
        // SAFETY: the same contract.
        OwnedSet::of_newest(path.as_ref(), |path| unsafe { FileBytes::map(path) })
    }

    /// Opens the set, once more if a bank is gone because a new set took its place meanwhile.
    fn of_newest(path: &Path, read: impl Fn(&Path) -> io::Result<FileBytes>) -> Result<OwnedSet, LayersOpenError> {
        let first = OwnedSet::read(path, &read);
        match first {
            Err(error) if error.path() != path && is_missing(&error) => OwnedSet::read(path, &read),
            first => first,
        }
    }

    fn read(path: &Path, read: &impl Fn(&Path) -> io::Result<FileBytes>) -> Result<OwnedSet, LayersOpenError> {
        let index = FileBytes::read(path).map_err(|error| LayersOpenError::new(path, error.into()))?;
        let refused = |error: lipz_bank::Error| LayersOpenError::new(path, error.into());
        let names = SetIndex::open(&index).and_then(SetIndex::verify).map_err(refused)?;
        let names: Vec<PathBuf> = names.banks().map(|bank| path.with_file_name(bank.file_name)).collect();
        let bank = |path: PathBuf| match read(&path) {
            Ok(bytes) => Ok((path, bytes)),
            Err(error) => Err(LayersOpenError::new(&path, error.into())),
        };
        let banks = names.into_iter().map(bank).collect::<Result<Vec<_>, _>>()?;
        banks.iter().for_each(|(_, bytes)| bytes.expect_queries());
        OwnedSet::of(Files { path: path.to_owned(), index, banks }, |bytes| Bank::open(bytes))
    }

    /// The set of these files, whose banks `open` opens.
    fn of(
        files: Files,
        open: impl for<'data> Fn(&'data [u8]) -> Result<Bank<'data>, lipz_bank::Error>,
    ) -> Result<OwnedSet, LayersOpenError> {
        let refused = |path: &Path, error: lipz_bank::Error| LayersOpenError::new(path, error.into());
        let path = files.path.clone();
        let opened = Banks::try_new(files, |files| {
            let index = SetIndex::open(&files.index).and_then(SetIndex::verify);
            let index = index.map_err(|error| refused(&files.path, error))?;
            let banks = files.banks.iter().map(|(path, bytes)| open(bytes).map_err(|error| refused(path, error)));
            Ok(Opened { index, banks: banks.collect::<Result<_, LayersOpenError>>()? })
        })?;
        let cell = Cell::try_new(opened, |opened| {
            let Opened { index, banks } = opened.borrow_dependent();
            BankSet::with_index(banks, index)
        });
        cell.map(OwnedSet).map_err(|error| LayersOpenError::new(&path, error.into()))
    }

    /// Verifies all banks, and that each clip is in the bank where it is looked for: reads all files.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify(self) -> Result<OwnedSet, LayersOpenError> {
        let files = self.0.into_owner().into_owner();
        files.banks.iter().for_each(|(_, bytes)| bytes.expect_all());
        let verified = OwnedSet::of(files, |bytes| Bank::open(bytes)?.verify_with(crate::owned::utf8))?;
        verified.set().verify().map_err(|error| LayersOpenError::new(&verified.files().path, error.into()))?;
        verified.files().banks.iter().for_each(|(_, bytes)| bytes.expect_queries());
        Ok(verified)
    }

    /// The set.
    pub fn set(&self) -> &BankSet<'_, '_> {
        self.0.borrow_dependent()
    }

    /// The index.
    pub fn index(&self) -> &SetIndex<'_> {
        &self.0.borrow_owner().borrow_dependent().index
    }

    fn files(&self) -> &Files {
        self.0.borrow_owner().borrow_owner()
    }
}

fn is_missing(error: &LayersOpenError) -> bool {
    matches!(error.error(), OpenError::File(error) if error.kind() == io::ErrorKind::NotFound)
}

/// The banks.
impl fmt::Debug for OwnedSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("OwnedSet").field(self.index()).field(self.set()).finish()
    }
}
