//! Sets of banks on disk: the index, and the banks beside it one at a time.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::bank_file::{BankFile, refused};
use crate::shared::stdio;
use lipz_bank::{Bank, BankSetError, SetIndex};
use lipz_diagnostics::{Code, Report};
use lipz_layout::SET_MAGIC;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

const LINK_AGAIN: &str = "copy all files of the set again, or link it again: lipz link";

/// The index of a set.
pub(crate) struct SetFile {
    path: PathBuf,
    file: BankFile,
}

impl SetFile {
    /// The set whose index is the file at `path`, verified; `None` if that is something else. Reports what is wrong with it.
    pub(crate) fn open(path: &Path, reporter: &mut Reporter) -> Result<Option<SetFile>, Abort> {
        if stdio::is_meant(path) || !begins_as_set(path) {
            return Ok(None);
        }
        let file = BankFile::read(path, reporter)?;
        if let Err(error) = SetIndex::open(file.bytes()).and_then(SetIndex::verify) {
            let diagnostic = refused(Code::BankDamaged, error, file.bytes());
            return Err(reporter.refuse(vec![Report::about(file.name.as_str(), diagnostic)]));
        }
        Ok(Some(SetFile { path: path.to_owned(), file }))
    }

    /// How messages name it.
    pub(crate) fn name(&self) -> &str {
        &self.file.name
    }

    /// The index. Reports damage, which `open` would have found.
    pub(crate) fn index(&self, reporter: &mut Reporter) -> Result<SetIndex<'_>, Abort> {
        SetIndex::open(self.file.bytes()).and_then(SetIndex::verify).map_err(|error| {
            let diagnostic = refused(Code::BankDamaged, error, self.file.bytes());
            reporter.refuse(vec![Report::about(self.file.name.as_str(), diagnostic)])
        })
    }

    /// The bank with this number, read and not yet verified. Reports that it is not the one that the index names.
    pub(crate) fn bank(&self, number: usize, reporter: &mut Reporter) -> Result<BankFile, Abort> {
        let Some(entry) = self.index(reporter)?.bank_at(number) else {
            return Err(self.refuse(BankSetError::Count, reporter));
        };
        let file = BankFile::read(&self.path.with_file_name(entry.file_name), reporter)?;
        match Bank::open(file.bytes()) {
            Ok(bank) if bank.checksum() != entry.checksum => {
                Err(self.refuse(BankSetError::OtherBank { bank: number }, reporter))
            }
            // Whoever opens it says what is wrong with a file that is no bank.
            _ => Ok(file),
        }
    }

    /// Reports that the banks are not those of the set.
    pub(crate) fn refuse(&self, error: BankSetError, reporter: &mut Reporter) -> Abort {
        let report = Report::failure(self.name(), Code::BankDamaged, error.to_string(), LINK_AGAIN);
        reporter.refuse(vec![report])
    }
}

fn begins_as_set(path: &Path) -> bool {
    let mut start = [0; SET_MAGIC.len()];
    File::open(path).and_then(|mut file| file.read_exact(&mut start)).is_ok() && start == SET_MAGIC
}
