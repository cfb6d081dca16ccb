//! Sets of banks on disk: the index, and the banks next to it.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::bank_file::{BankFile, refused};
use crate::shared::stdio;
use lipz_bank::files::SetIndex;
use lipz_bank::{Bank, Error};
use lipz_diagnostics::{Code, Report};
use lipz_layout::SET_MAGIC;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The index of a set.
pub(crate) struct SetFile {
    path: PathBuf,
    file: BankFile,
}

impl SetFile {
    /// Returns the verified set whose index is at `path`, or `None` if the file is not an index. Reports its problems.
    pub(crate) fn open(path: &Path, reporter: &mut Reporter) -> Result<Option<SetFile>, Abort> {
        if stdio::is_meant(path) || !begins_as_set(path) {
            return Ok(None);
        }
        let set = SetFile { path: path.to_owned(), file: BankFile::read(path, reporter)? };
        set.checked(SetIndex::open(set.file.bytes()).and_then(SetIndex::verify), reporter)?;
        Ok(Some(set))
    }

    /// Whether bytes start with the header of an index.
    pub(crate) fn is_index(bytes: &[u8]) -> bool {
        bytes.starts_with(&SET_MAGIC)
    }

    /// Returns its name in messages.
    pub(crate) fn name(&self) -> &str {
        &self.file.name
    }

    /// Returns the index, which `open` has verified.
    pub(crate) fn index(&self, reporter: &mut Reporter) -> Result<SetIndex<'_>, Abort> {
        self.checked(SetIndex::open(self.file.bytes()), reporter)
    }

    /// Reports damage of the index.
    fn checked<'s>(&self, index: Result<SetIndex<'s>, Error>, reporter: &mut Reporter) -> Result<SetIndex<'s>, Abort> {
        index.map_err(|error| {
            let diagnostic = refused(Code::BankDamaged, error, self.file.bytes());
            reporter.refuse(vec![Report::about(self.file.name.as_str(), diagnostic)])
        })
    }

    /// Returns the bank with this number, unverified. Reports an error if it does not match the index.
    pub(crate) fn bank(&self, number: usize, reporter: &mut Reporter) -> Result<BankFile, Abort> {
        let index = self.index(reporter)?;
        let name = index.bank_at(number).map_or("", |bank| bank.file_name);
        let file = BankFile::of_set(&self.path.with_file_name(name), self.name(), reporter)?;
        // A file that is not a bank is reported when it is verified.
        if let Ok(bank) = Bank::open(file.bytes()) {
            index.check_bank(number, &bank).map_err(|error| SetFile::refuse(&file, error, reporter))?;
        }
        Ok(file)
    }

    /// Verifies the bank with this number, and that each of its clips is where the index implies. Reports errors.
    pub(crate) fn verify_bank(&self, number: usize, file: &BankFile, reporter: &mut Reporter) -> Result<(), Abort> {
        let bank = file.bank(reporter)?;
        let verified = self.index(reporter)?.verify_bank(number, &bank);
        verified.map_err(|error| SetFile::refuse(file, error, reporter))
    }

    /// Returns the index and all banks, unverified.
    pub(crate) fn into_files(self, reporter: &mut Reporter) -> Result<Vec<BankFile>, Abort> {
        let count = self.index(reporter)?.bank_count();
        let banks = (0..count).map(|number| self.bank(number, reporter)).collect::<Result<Vec<_>, _>>()?;
        Ok(std::iter::once(self.file).chain(banks).collect())
    }

    fn refuse(file: &BankFile, error: Error, reporter: &mut Reporter) -> Abort {
        let diagnostic = refused(Code::BankDamaged, error, file.bytes());
        reporter.refuse(vec![Report::about(file.name.as_str(), diagnostic)])
    }
}

fn begins_as_set(path: &Path) -> bool {
    let mut start = [0; SET_MAGIC.len()];
    File::open(path).and_then(|mut file| file.read_exact(&mut start)).is_ok() && start == SET_MAGIC
}
