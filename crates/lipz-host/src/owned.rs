//! A bank together with its bytes.

use crate::{Error, FileBytes, Hold};
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
    /// Opens the bank at `path`, without verifying it.
    ///
    /// ```no_run
    /// use lipz_host::{Hold, OwnedBank};
    ///
    /// # fn main() -> Result<(), lipz_host::Error> {
    /// let owned = OwnedBank::open("dialogue.lipzbank", Hold::Mapped)?.verify()?;
    /// println!("{} clips", owned.bank().clip_count());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// When the file cannot be opened, or [`Bank::open`] refuses it.
    pub fn open(path: impl AsRef<Path>, hold: Hold) -> Result<OwnedBank, Error> {
        OwnedBank::of(FileBytes::open(path, hold)?)
    }

    /// Opens the bank that these bytes are, without verifying it.
    ///
    /// # Errors
    /// When [`Bank::open`] refuses it.
    pub fn of(bytes: FileBytes) -> Result<OwnedBank, Error> {
        bytes.expect_queries();
        Ok(OwnedBank(Cell::try_new(bytes, |bytes| Bank::open(bytes))?))
    }

    /// Verifies the bank: reads all of the file.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify(self) -> Result<OwnedBank, Error> {
        let bytes = self.0.into_owner();
        bytes.expect_all();
        let verified = Cell::try_new(bytes, |bytes| Bank::open(bytes)?.verify())?;
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

/// What the bank has and how its bytes are held.
impl fmt::Debug for OwnedBank {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("OwnedBank").field(self.bank()).field(self.bytes()).finish()
    }
}
