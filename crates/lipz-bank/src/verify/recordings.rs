//! Recordings, one record per slot.

use super::error_at;
use crate::file::entries;
use crate::{Bank, Error, ErrorKind};
use lipz_layout::{NO_RECORDING, RecordingRecord, Tag};

/// Checks the section, if the bank has it: its length is that of the clips already.
pub(super) fn recordings(bank: &Bank<'_>) -> Result<(), Error> {
    let records: &[RecordingRecord] = entries(bank.file.section(Tag::RECORDINGS));
    // Times of the reader are signed.
    let is_valid = |record: &&RecordingRecord| match record.length_us.get() {
        NO_RECORDING => record.content_hash.get() == 0,
        length_us => length_us <= i64::MAX as u64,
    };
    match records.iter().find(|record| !is_valid(record)) {
        Some(record) => Err(error_at(bank, ErrorKind::Recording, record)),
        None => Ok(()),
    }
}
