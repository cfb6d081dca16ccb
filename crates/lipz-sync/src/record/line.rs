//! A line of the record: hashes of the source of visemes, and the times of their words.

use lipz_compiler::WordTimes;

/// The prefix of the original's hashes.
const DUB_OF: &str = "dub-of:";

/// The mark of visemes made from a corrected TextGrid.
const CORRECTED: &str = "from:textgrid ";

/// The prefix of mismatches between recording and text.
const DIFFERS: &str = "differs:";

/// The prefix of word times.
const SAID: &str = "said:";

/// A line of the record.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct RecordLine {
    /// The sources of the visemes.
    pub made: MouthHashes,
    /// The times of the text's words; `None` if it has no words, or an older version wrote the line.
    pub words: Option<WordTimes>,
    /// The original when these visemes were made, if they are those of a dub.
    pub original: Option<OriginalHashes>,
    /// Whether the visemes were made from a corrected TextGrid, so that they count as work by hand.
    pub is_corrected: bool,
    /// The mismatches between recording and text: bytes of the text (empty for speech that is not in it) and times.
    /// Missing words are doubtful.
    pub differences: Option<WordTimes>,
}

impl RecordLine {
    /// Whether `text` was found in the recording: it has words, of which most are certain, and all match.
    pub(crate) fn is_said(&self, text: &str) -> bool {
        let words = self.words.as_ref().map(|words| words.of_text(text)).unwrap_or_default();
        let doubtful = words.iter().filter(|word| word.is_doubtful).count();
        self.differences.is_none() && 2 * doubtful < words.len()
    }
}

/// The hashes of a dub's original.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct OriginalHashes {
    /// The hash of the bytes of its recording; 0 if there was none.
    pub sound: u64,
    /// The hash of its spoken text.
    pub text: u64,
}

/// The hashes of the sources of visemes, and of the visemes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct MouthHashes {
    /// The hash of the bytes of the recording.
    pub sound: u64,
    /// The hash of the spoken text in the Lipz file.
    pub text: u64,
    /// The hash of everything else that affects visemes: pronunciations, rules, frame rate, viseme type, version.
    pub settings: u64,
    /// The hash of the frames, their rate and their type.
    pub mouth: u64,
}

impl RecordLine {
    pub(crate) fn written(&self, file: &str) -> String {
        let MouthHashes { sound, text, settings, mouth } = self.made;
        let differs = self.differences.as_ref().map_or(String::new(), |differs| format!("{DIFFERS}{differs} "));
        let said = self.words.as_ref().map_or(String::new(), |words| format!("{SAID}{words} "));
        let original = OriginalHashes::written(self.original);
        let corrected = if self.is_corrected { CORRECTED } else { "" };
        format!("{sound:016x} {text:016x} {settings:016x} {mouth:016x} {original}{corrected}{differs}{said}{file}")
    }

    pub(crate) fn parse(line: &str) -> Option<(RecordLine, &str)> {
        let mut parts = line.splitn(5, ' ');
        let mut hash = || parts.next().and_then(parse_hash);
        let made = MouthHashes { sound: hash()?, text: hash()?, settings: hash()?, mouth: hash()? };
        let rest = parts.next()?;
        let (original, rest) = OriginalHashes::take(rest)?;
        let (is_corrected, rest) = rest.strip_prefix(CORRECTED).map_or((false, rest), |rest| (true, rest));
        let (differences, rest) = times(rest, DIFFERS)?;
        // Older versions wrote no times.
        let (words, file) = times(rest, SAID)?;
        (!file.is_empty()).then_some((RecordLine { made, words, original, is_corrected, differences }, file))
    }
}

impl OriginalHashes {
    /// Whether the recording is the same. A missing one counts as the same, because a different lint reports it.
    pub(crate) fn is_recorded_as(&self, other: &OriginalHashes) -> bool {
        self.sound == other.sound || self.sound == 0 || other.sound == 0
    }

    /// Returns the form in a line.
    pub(crate) fn written(original: Option<OriginalHashes>) -> String {
        original.map_or(String::new(), |OriginalHashes { sound, text }| format!("{DUB_OF}{sound:016x},{text:016x} "))
    }

    /// Returns the optional hashes at the start of the rest of a line, and the remaining text.
    pub(crate) fn take(rest: &str) -> Option<(Option<OriginalHashes>, &str)> {
        let Some(rest) = rest.strip_prefix(DUB_OF) else { return Some((None, rest)) };
        let (hashes, rest) = rest.split_once(' ')?;
        let (sound, text) = hashes.split_once(',')?;
        Some((Some(OriginalHashes { sound: parse_hash(sound)?, text: parse_hash(text)? }), rest))
    }
}

/// Returns the times after this prefix, if the line has it, and the remaining text.
fn times<'l>(line: &'l str, name: &str) -> Option<(Option<WordTimes>, &'l str)> {
    match line.strip_prefix(name).map(|rest| rest.split_once(' ')) {
        Some(times) => times.and_then(|(times, rest)| Some((Some(times.parse().ok()?), rest))),
        None => Some((None, line)),
    }
}

pub(crate) fn parse_hash(digits: &str) -> Option<u64> {
    if digits.len() == 16 { u64::from_str_radix(digits, 16).ok() } else { None }
}
