//! A bank together with its bytes.

use crate::{FileBytes, OpenError};
use lipz_bank::Bank;
use self_cell::self_cell;
use std::fmt;
use std::path::Path;

self_cell!(
    struct Cell {
        owner: FileBytes,
        #[covariant]
        dependent: Bank,
    }
);

/// A bank together with its bytes, which can be kept, sent to other threads and shared in an
/// [`Arc`](std::sync::Arc).
pub struct OwnedBank(Cell);

impl OwnedBank {
    /// Reads the bank at `path` into memory and opens it, without verifying it.
    ///
    /// ```no_run
    /// use lipz_host::OwnedBank;
    ///
    /// # fn main() -> Result<(), lipz_host::OpenError> {
    /// let owned = OwnedBank::open("dialogue.lipzbank")?.verify()?;
    /// println!("{} clips", owned.bank().clip_count());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// When the file cannot be read, or [`Bank::open`] refuses it.
    pub fn open(path: impl AsRef<Path>) -> Result<OwnedBank, OpenError> {
        OwnedBank::from_bytes(FileBytes::read(path)?)
    }

    /// Maps the bank at `path` and opens it, without verifying it.
    ///
    /// # Safety
    /// As for [`FileBytes::map`]: nobody changes or truncates the file as long as this bank exists.
    ///
    /// # Errors
    /// When the file cannot be mapped, or [`Bank::open`] refuses it.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped(path: impl AsRef<Path>) -> Result<OwnedBank, OpenError> {
        // SAFETY: the same contract.
        OwnedBank::from_bytes(unsafe { FileBytes::map(path) }?)
    }

    /// Opens the bank that these bytes are, without verifying it.
    ///
    /// # Errors
    /// When [`Bank::open`] refuses it.
    pub fn from_bytes(bytes: FileBytes) -> Result<OwnedBank, OpenError> {
        bytes.expect_queries();
        Ok(OwnedBank(Cell::try_new(bytes, |bytes| Bank::open(bytes))?))
    }

    /// Verifies the bank: reads all of the file. With the feature `simdutf8` that takes half of the time.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify(self) -> Result<OwnedBank, OpenError> {
        let bytes = self.0.into_owner();
        bytes.expect_all();
        let verified = Cell::try_new(bytes, |bytes| Bank::open(bytes)?.verify_with(utf8))?;
        verified.borrow_owner().expect_queries();
        Ok(OwnedBank(verified))
    }

    /// The bank.
    pub fn bank(&self) -> &Bank<'_> {
        self.0.borrow_dependent()
    }

    /// The bytes of the bank.
    pub fn bytes(&self) -> &FileBytes {
        self.0.borrow_owner()
    }
}

/// The check of strings.
pub(crate) fn utf8(bytes: &[u8]) -> Option<&str> {
    #[cfg(feature = "simdutf8")]
    return simdutf8::basic::from_utf8(bytes).ok();
    #[cfg(not(feature = "simdutf8"))]
    return std::str::from_utf8(bytes).ok();
}

/// What the bank has and where its bytes are.
impl fmt::Debug for OwnedBank {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("OwnedBank").field(self.bank()).field(self.bytes()).finish()
    }
}
