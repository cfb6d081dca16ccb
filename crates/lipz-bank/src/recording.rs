//! The recording that a clip was made for: how long it is, and what is in its file.

use crate::Clip;
use crate::file::entries;
use lipz_layout::{NO_RECORDING, RecordingRecord, Tag};

/// What a bank says about the recording of a clip, so that a program can tell that the sound it is about to play is
/// a different one, such as a retake for which the visemes were not made again.
///
/// ```
/// use lipz_bank::Recording;
/// // From the audio engine: the length of what it plays.
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
    /// A recording of this length in microseconds, and with this hash of its file.
    pub const fn new(length_us: u64, content_hash: u64) -> Recording {
        Recording { length_us, content_hash }
    }

    /// Its length in microseconds, rounded to the nearest. Conversion to another sample rate or format keeps it, but
    /// for some milliseconds of padding.
    pub const fn length_us(self) -> u64 {
        self.length_us
    }

    /// XXH3-64 of all bytes of its file: equal for equal files. `docs/reference/bank-format.md` says how to compute it.
    pub const fn content_hash(self) -> u64 {
        self.content_hash
    }
}

impl Clip<'_> {
    /// The recording that the clip was made for; `None` if the bank was packed without recordings, or the clip had
    /// none.
    pub fn recording(&self) -> Option<Recording> {
        let records: &[RecordingRecord] = entries(self.bank.file.section(Tag::RECORDINGS));
        let record = records.get(self.slot() as usize)?;
        let recording = Recording::new(record.length_us.get(), record.content_hash.get());
        if recording.length_us == NO_RECORDING { None } else { Some(recording) }
    }
}
