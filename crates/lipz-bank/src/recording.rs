//! The recording that a clip was made for: its length and the hash of its file.

use crate::file::entries;
use crate::verify::error_at;
use crate::{Bank, Clip, Error, ErrorKind};
use lipz_layout::{NO_RECORDING, RecordingRecord, Tag};

/// Data about the recording of a clip. With it, a program can detect that it is about to play a different recording,
/// such as a retake without updated visemes.
///
/// ```
/// use lipz_bank::Recording;
/// // From the audio engine: the length of the audio that it plays.
/// # let recording = Recording::new(1_500_000, 0x0123_4567_89AB_CDEF);
/// let played_us: u64 = 1_500_021;
/// let is_other = recording.length_us().abs_diff(played_us) > 50_000;
/// assert!(!is_other);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Recording {
    length_us: u64,
    content_hash: u64,
}

impl Recording {
    /// Returns a recording of this length in microseconds, and with this hash of its file.
    pub const fn new(length_us: u64, content_hash: u64) -> Recording {
        Recording { length_us, content_hash }
    }

    /// Returns the length in microseconds, rounded to the nearest. Conversion to another sample rate or format
    /// preserves it, except for some milliseconds of padding.
    pub const fn length_us(self) -> u64 {
        self.length_us
    }

    /// Returns the XXH3-64 of all bytes of the file, which is equal for equal files. `docs/reference/bank-format.md`
    /// specifies it.
    pub const fn content_hash(self) -> u64 {
        self.content_hash
    }
}

impl Clip<'_> {
    /// Returns the recording that the clip was made for; `None` if the bank was packed without recordings, or the clip
    /// had no recording.
    pub fn recording(&self) -> Option<Recording> {
        let records: &[RecordingRecord] = entries(self.bank.file.section(Tag::RECORDINGS));
        let record = records.get(self.slot() as usize)?;
        let recording = Recording::new(record.length_us.get(), record.content_hash.get());
        if recording.length_us == NO_RECORDING { None } else { Some(recording) }
    }
}

/// Checks the section, if the bank has it. Its length is already checked against the number of clips.
pub(crate) fn check(bank: &Bank<'_>) -> Result<(), Error> {
    let records: &[RecordingRecord] = entries(bank.file.section(Tag::RECORDINGS));
    // The reader's times are signed.
    let is_valid = |record: &&RecordingRecord| match record.length_us.get() {
        NO_RECORDING => record.content_hash.get() == 0,
        length_us => length_us <= i64::MAX as u64,
    };
    match records.iter().find(|record| !is_valid(record)) {
        Some(record) => Err(error_at(bank, ErrorKind::Recording, record)),
        None => Ok(()),
    }
}
