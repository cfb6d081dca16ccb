//! A line of the record: what a mouth was made from, as hashes, and when its words are said.

use lipz_compiler::WordTimes;

/// What a line says before the hashes of the original.
const DUB_OF: &str = "dub-of:";

/// What a line says if the mouth was made from a TextGrid that somebody has corrected.
const CORRECTED: &str = "from:textgrid ";

/// What a line says before the places where recording and text do not say the same.
const DIFFERS: &str = "differs:";

/// What a line says before the times of words.
const SAID: &str = "said:";

/// A line of the record.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Line {
    /// What the mouth was made from.
    pub made: Made,
    /// When the words of its text are said; `None` if it has no words, or an older version made it.
    pub words: Option<WordTimes>,
    /// What the original was when this mouth was made, if it is that of a dub.
    pub original: Option<OriginalThen>,
    /// Whether the mouth was made from a TextGrid that somebody has corrected: it is work by hand.
    pub is_corrected: bool,
    /// Where recording and text do not say the same: bytes of the text (none, if it is not in the text) and times, and what is
    /// not said is doubtful.
    pub differences: Option<WordTimes>,
}

/// What the original of a dub was: hashes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct OriginalThen {
    /// All bytes of its recording; 0 if there was none.
    pub sound: u64,
    /// The text that is spoken in it.
    pub text: u64,
}

/// What a mouth was made from, and what it was: hashes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Made {
    /// All bytes of the recording.
    pub sound: u64,
    /// The text that is spoken, as it stands in the Lipz file.
    pub text: u64,
    /// Everything else that decides: pronunciations, rules, frame rate, viseme type, version.
    pub settings: u64,
    /// The frames, their rate and their type.
    pub mouth: u64,
}

impl Line {
    pub(crate) fn written(&self, file: &str) -> String {
        let Made { sound, text, settings, mouth } = self.made;
        let differs = self.differences.as_ref().map_or(String::new(), |differs| format!("{DIFFERS}{differs} "));
        let said = self.words.as_ref().map_or(String::new(), |words| format!("{SAID}{words} "));
        let original = OriginalThen::written(self.original);
        let corrected = if self.is_corrected { CORRECTED } else { "" };
        format!("{sound:016x} {text:016x} {settings:016x} {mouth:016x} {original}{corrected}{differs}{said}{file}")
    }

    pub(crate) fn parse(line: &str) -> Option<(Line, &str)> {
        let mut parts = line.splitn(5, ' ');
        let mut hash = || parts.next().and_then(parse_hash);
        let made = Made { sound: hash()?, text: hash()?, settings: hash()?, mouth: hash()? };
        let rest = parts.next()?;
        let (original, rest) = OriginalThen::take(rest)?;
        let (is_corrected, rest) = rest.strip_prefix(CORRECTED).map_or((false, rest), |rest| (true, rest));
        let (differences, rest) = times(rest, DIFFERS)?;
        // Older versions wrote no times.
        let (words, file) = times(rest, SAID)?;
        (!file.is_empty()).then_some((Line { made, words, original, is_corrected, differences }, file))
    }
}

impl OriginalThen {
    /// Whether its recording is the same. One that is not there, or was not, tells nothing: another lint misses it.
    pub(crate) fn is_recorded_as(&self, other: &OriginalThen) -> bool {
        self.sound == other.sound || self.sound == 0 || other.sound == 0
    }

    /// As it stands in a line.
    pub(crate) fn written(original: Option<OriginalThen>) -> String {
        original.map_or(String::new(), |OriginalThen { sound, text }| format!("{DUB_OF}{sound:016x},{text:016x} "))
    }

    /// The one with which the rest of a line may begin, and what follows it.
    pub(crate) fn take(rest: &str) -> Option<(Option<OriginalThen>, &str)> {
        let Some(rest) = rest.strip_prefix(DUB_OF) else { return Some((None, rest)) };
        let (hashes, rest) = rest.split_once(' ')?;
        let (sound, text) = hashes.split_once(',')?;
        Some((Some(OriginalThen { sound: parse_hash(sound)?, text: parse_hash(text)? }), rest))
    }
}

/// The times that a line has behind such a name, and what follows them.
fn times<'l>(line: &'l str, name: &str) -> Option<(Option<WordTimes>, &'l str)> {
    match line.strip_prefix(name).map(|rest| rest.split_once(' ')) {
        Some(times) => times.and_then(|(times, rest)| Some((Some(times.parse().ok()?), rest))),
        None => Some((None, line)),
    }
}

pub(crate) fn parse_hash(digits: &str) -> Option<u64> {
    if digits.len() == 16 { u64::from_str_radix(digits, 16).ok() } else { None }
}
