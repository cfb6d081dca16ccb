//! The results of the previous run.

use super::changed_inputs::PreviousInputs;
use super::file;
use super::old_bank::OldBank;
use super::stamps::{MAGIC, Stamps};
use lipz_diagnostics::Report;
use std::path::Path;
use std::sync::Arc;

/// The results of the previous run: stamps, and the bank that they belong to. A clone shares both.
#[derive(Clone)]
pub(super) struct PreviousRun {
    pub(super) stamps: Arc<Stamps>,
    pub(super) bank: OldBank,
    /// Data about its inputs, if it ran in this process.
    pub(super) known: Option<Arc<PreviousInputs>>,
}

impl PreviousRun {
    /// Reads the file `cache` and the bank at `path`; `None` if they cannot be used, for whatever reason.
    ///
    /// # Errors
    /// If `cache` is a file of a different kind.
    pub(super) fn read(cache: &Path, path: &Path) -> Result<Option<PreviousRun>, Report> {
        let Some(stamps) = file::read(cache, MAGIC)? else { return Ok(None) };
        let bank = OldBank::open(path, stamps.bank_checksum);
        Ok(bank.map(|bank| PreviousRun { stamps: stamps.into(), bank, known: None }))
    }
}
