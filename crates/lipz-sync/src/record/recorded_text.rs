//! The text for which each recording was made, whatever its visemes were made from since.

use crate::record::{OriginalHashes, RecordLine, parse_hash};

/// The prefix of the hashes of a recording and its text.
const SPOKEN: &str = "spoken:";

/// The text for which a recording was made: it was approved, or the first visemes were made from it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct RecordedText {
    /// The hash of the bytes of the recording.
    pub sound: u64,
    /// The hash of its text.
    pub text: u64,
    /// The original at that time, if it is the recording of a dub.
    pub original: Option<OriginalHashes>,
}

impl RecordedText {
    /// Whether the text, and for a dub the original, are unchanged, so that the recording is up to date.
    pub(crate) fn is_still(&self, now: &RecordedText) -> bool {
        self.text == now.text && self.is_of_original(now)
    }

    /// Whether the original is unchanged, as far as it is known.
    fn is_of_original(&self, now: &RecordedText) -> bool {
        match (self.original, now.original) {
            (Some(then), Some(now)) => then.is_recorded_as(&now) && then.text == now.text,
            _ => true,
        }
    }

    /// Returns the current form, if the recording has `text` and its original has `of_original`.
    pub(crate) fn renewed(self, text: Option<&str>, of_original: Option<&str>) -> RecordedText {
        let original = self.original.map(|original| original.renewed(of_original));
        RecordedText { text: crate::record::hashes::renewed(self.text, text), original, ..self }
    }

    pub(crate) fn written(&self, file: &str) -> String {
        let RecordedText { sound, text, original } = self;
        format!("{SPOKEN}{sound:016x},{text:016x} {}{file}", OriginalHashes::written(*original))
    }

    pub(crate) fn parse(line: &str) -> Option<(RecordedText, &str)> {
        let (hashes, rest) = line.strip_prefix(SPOKEN)?.split_once(' ')?;
        let (sound, text) = hashes.split_once(',')?;
        let (original, file) = OriginalHashes::take(rest)?;
        let spoken = RecordedText { sound: parse_hash(sound)?, text: parse_hash(text)?, original };
        (!file.is_empty()).then_some((spoken, file))
    }
}

/// The text of the recording from which visemes were made, if nothing else is known.
impl From<&RecordLine> for RecordedText {
    fn from(line: &RecordLine) -> RecordedText {
        RecordedText { sound: line.made.sound, text: line.made.text, original: line.original }
    }
}
