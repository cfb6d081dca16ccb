//! The outcome of a job.

use super::review_list::ReviewList;
use crate::record::{RecordLine, RecordedText};
use lipz_compiler::WordTimes;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The outcome of a job.
pub(crate) enum JobOutcome {
    /// The visemes are up to date.
    Unchanged(ReviewList),
    /// The visemes were made or edited by hand, and stay. If the record lacks times of words, they were found again.
    Kept(KeepReason, Option<NewWordTimes>),
    /// The file gets new visemes.
    New(Box<NewMouth>),
    /// There are errors.
    Refused,
}

/// The reason why visemes stay.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub enum KeepReason {
    /// They were edited by hand after lip sync.
    Changed,
    /// They are not in the record, because they were made by hand or by a different tool.
    ByHand,
    /// They were made from a corrected TextGrid, and this run has no TextGrids.
    Corrected,
}

/// The times of the words in a recording, for the record.
#[derive(Clone, Debug)]
pub(crate) struct NewWordTimes {
    /// The hash of the bytes of the recording.
    pub(crate) sound: u64,
    pub(crate) words: WordTimes,
}

/// A file to be written.
pub(crate) struct NewMouth {
    /// The old content of the file; `None` if it does not exist.
    pub(crate) before: Option<Vec<u8>>,
    pub(crate) after: String,
    pub(crate) line: RecordLine,
    /// The texts of the recording, if they differ from that of the visemes.
    pub(crate) outdated: Vec<RecordedText>,
    pub(crate) listed: ReviewList,
    /// The missing TextGrid, with its path.
    pub(crate) grid: Option<(PathBuf, String)>,
    /// Whether visemes were made from this recording before, with a different text.
    pub(crate) has_new_text: bool,
}
