//! Bank files on disk: mapping them, and what to say when they are not banks.

use crate::{Outcome, render};
use lipz::{Code, Diagnostic};
use lipz_bank::Bank;
use lipz_compiler::Report;
use memmap2::Mmap;
use std::fs::File;
use std::path::Path;

/// A bank file, mapped into memory.
pub(crate) struct BankFile {
    path: String,
    map: Mmap,
}

impl BankFile {
    /// Maps the file at `path`; reports why it cannot be.
    pub(crate) fn map(path: &Path) -> Result<BankFile, Outcome> {
        let shown = path.to_string_lossy().into_owned();
        match map(path) {
            Ok(map) => Ok(BankFile { path: shown, map }),
            Err(error) => {
                let finding = Diagnostic::new(Code::BankRefused, format!("`{shown}` cannot be read: {error}"));
                render::findings(&[Report::about(shown, finding)]);
                Err(Outcome::Failed)
            }
        }
    }

    /// The bank in the file, verified; reports what is wrong with it.
    pub(crate) fn verified(&self) -> Result<Bank<'_>, Outcome> {
        let opened = Bank::open(&self.map).map_err(|error| (Code::BankRefused, error));
        let verified = opened.and_then(|bank| bank.verify().map_err(|error| (Code::BankDamaged, error)));
        verified.map_err(|(code, error)| {
            let finding = Diagnostic::new(code, error.kind().message())
                .note(format!(
                    "bank error {}, at byte {} of {}",
                    error.kind() as u8,
                    error.offset_bytes(),
                    self.map.len()
                ))
                .help("pack the bank again, or copy it again in binary mode");
            render::findings(&[Report::about(self.path.clone(), finding)]);
            Outcome::Findings
        })
    }

    /// How messages name the file.
    pub(crate) fn path(&self) -> &str {
        &self.path
    }
}

fn map(path: &Path) -> std::io::Result<Mmap> {
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(std::io::Error::other("it is a folder"));
    }
    // SAFETY: the map is only read. Banks are replaced by renaming, never changed in place; should
    // someone else truncate the file while it is read, this process may be stopped by a signal.
    #[expect(unsafe_code, reason = "mapping a file is unsafe by its nature")]
    unsafe {
        Mmap::map(&file)
    }
}
