//! The times of the words of a text, obtained from its recording.

use lipz_file::text::{DELIMITER, is_white_space, segments, trim};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// A word of a text, and its time.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WordTime {
    /// The bytes of the word in the text.
    pub range: Range<usize>,
    /// The start, in milliseconds from the start of the recording.
    pub start_ms: u32,
    /// The end, in milliseconds from the start of the recording.
    pub end_ms: u32,
    /// Whether it is unclear in the recording.
    pub is_doubtful: bool,
}

/// The times of the words of a text. It recognises its text, even with different blanks around the segments, and has no
/// words for any other text.
///
/// As a string: the checksum of the text, then for each word its bytes and its milliseconds, and `?` if it is doubtful.
///
/// ```
/// use lipz_compiler::{WordTime, WordTimes};
/// let words = [WordTime { range: 1..6, start_ms: 120, end_ms: 480, is_doubtful: true }];
/// let times = WordTimes::new(" Mayor? | Aye.", &words);
/// assert_eq!(times.to_string(), "9e881126:0-5@120-480?");
/// let moved = WordTime { range: 0..5, ..words[0].clone() };
/// assert_eq!(times.of_text("Mayor?|Aye."), [moved]);
/// assert_eq!(times.of_text("Mare?|Aye."), []);
/// ```
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct WordTimes {
    /// In text form to save memory, because there may be one for each of a hundred thousand clips. Validated on
    /// creation.
    words: Box<str>,
    checksum: u32,
}

impl WordTimes {
    /// Creates the times of these words of `text`, in order.
    pub fn new(text: &str, words: &[WordTime]) -> WordTimes {
        let trimmed = TrimmedText::new(text);
        let mut entries = String::new();
        for word in words {
            let Some(range) = trimmed.without_blanks(&word.range) else { continue };
            let WordTime { start_ms, end_ms, is_doubtful, .. } = *word;
            let (comma, doubt) = (if entries.is_empty() { "" } else { "," }, if is_doubtful { "?" } else { "" });
            entries += &format!("{comma}{}-{}@{start_ms}-{end_ms}{doubt}", range.start, range.end);
        }
        WordTimes { words: entries.into(), checksum: trimmed.checksum }
    }

    /// Returns the words with their positions in `text`; none if it is a different text.
    pub fn of_text(&self, text: &str) -> Vec<WordTime> {
        let trimmed = TrimmedText::new(text);
        if trimmed.checksum != self.checksum {
            return Vec::new();
        }
        let place = |word: WordTime| Some(WordTime { range: trimmed.with_blanks(&word.range)?, ..word });
        self.words.split(',').filter_map(word_time).filter_map(place).collect()
    }

    /// Whether there are no words.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Returns the number of words that are unclear in the recording.
    pub fn doubtful_count(&self) -> usize {
        self.words.split(',').filter(|word| word.ends_with('?')).count()
    }
}

impl fmt::Display for WordTimes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:08x}:{}", self.checksum, self.words)
    }
}

/// The string does not contain words and their times.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ParseWordTimesError;

impl fmt::Display for ParseWordTimesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the word times do not have a form such as `9e881126:0-5@120-480,7-10@480-700?`")
    }
}

impl std::error::Error for ParseWordTimesError {}

impl FromStr for WordTimes {
    type Err = ParseWordTimesError;

    fn from_str(text: &str) -> Result<WordTimes, ParseWordTimesError> {
        let (checksum, words) = text.split_once(':').filter(|(sum, _)| sum.len() == 8).ok_or(ParseWordTimesError)?;
        let checksum = u32::from_str_radix(checksum, 16).map_err(|_| ParseWordTimesError)?;
        let is_known = words.is_empty() || words.split(',').all(|word| word_time(word).is_some());
        is_known.then(|| WordTimes { words: words.into(), checksum }).ok_or(ParseWordTimesError)
    }
}

/// Parses `0-5@120-480?`.
fn word_time(entry: &str) -> Option<WordTime> {
    let (entry, is_doubtful) = match entry.strip_suffix('?') {
        Some(entry) => (entry, true),
        None => (entry, false),
    };
    let (bytes, times) = entry.split_once('@')?;
    let ((start, end), (start_ms, end_ms)) = (bytes.split_once('-')?, times.split_once('-')?);
    let range = start.parse().ok()?..end.parse().ok()?;
    let word = WordTime { range, start_ms: start_ms.parse().ok()?, end_ms: end_ms.parse().ok()?, is_doubtful };
    (word.range.start <= word.range.end && word.start_ms <= word.end_ms).then_some(word)
}

/// A text, and its content without the blanks around its segments, which formatting moves.
struct TrimmedText {
    places: Vec<SegmentPlace>,
    checksum: u32,
}

/// A segment: its start in the text and in the trimmed text, and its length, all without blanks.
struct SegmentPlace {
    start: usize,
    trimmed_start: usize,
    length: usize,
}

impl TrimmedText {
    fn new(text: &str) -> TrimmedText {
        let (mut places, mut trimmed) = (Vec::new(), String::with_capacity(text.len()));
        for range in segments(text) {
            if !places.is_empty() {
                trimmed.push(DELIMITER);
            }
            let segment = &text[range.clone()];
            let start = range.start + segment.len() - segment.trim_start_matches(is_white_space).len();
            let segment = trim(segment);
            places.push(SegmentPlace { start, trimmed_start: trimmed.len(), length: segment.len() });
            trimmed.push_str(segment);
        }
        // Half of the bits are sufficient to distinguish the texts of a clip.
        TrimmedText { places, checksum: lipz_layout::checksum(trimmed.as_bytes()) as u32 }
    }

    fn without_blanks(&self, range: &Range<usize>) -> Option<Range<usize>> {
        self.moved(range, |place| place.start, |place| place.trimmed_start)
    }

    fn with_blanks(&self, range: &Range<usize>) -> Option<Range<usize>> {
        self.moved(range, |place| place.trimmed_start, |place| place.start)
    }

    /// Converts a range of one of the two texts to the other; `None` if it is not within a segment.
    fn moved(
        &self,
        range: &Range<usize>,
        from: impl Fn(&SegmentPlace) -> usize,
        to: impl Fn(&SegmentPlace) -> usize,
    ) -> Option<Range<usize>> {
        let place = self.places.get(self.places.partition_point(|place| from(place) <= range.start).checked_sub(1)?)?;
        let is_within = range.end <= from(place) + place.length;
        is_within.then(|| range.start - from(place) + to(place)..range.end - from(place) + to(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(range: Range<usize>, start_ms: u32) -> WordTime {
        WordTime { range, start_ms, end_ms: start_ms + 100, is_doubtful: start_ms > 500 }
    }

    #[test]
    fn words_are_found_again_whatever_formatting_does() {
        let text = "Wer {leise} da?|  Müller |\tund 東京 ";
        let place = |word: &str| text.find(word).map_or(0..0, |at| at..at + word.len());
        let words: Vec<WordTime> = ["Wer", "da?", "Müller", "und", "東京"]
            .into_iter()
            .zip((0..).step_by(200))
            .map(|(w, ms)| word(place(w), ms))
            .collect();
        let times = WordTimes::new(text, &words);
        assert_eq!(times.of_text(text), words);
        assert_eq!(times.doubtful_count(), 2);
        let formatted = "Wer {leise} da?  |Müller  |und 東京";
        let found: Vec<&str> = times.of_text(formatted).iter().map(|word| &formatted[word.range.clone()]).collect();
        assert_eq!(found, ["Wer", "da?", "Müller", "und", "東京"]);
        assert_eq!(times.of_text("Wer {leise} da?|Müller|und Tokio"), []);
        assert_eq!(times.of_text("Wer {leise} da?|Müller und|東京"), [], "another segment");
        assert_eq!(times.to_string().parse(), Ok(times));
        let none = WordTimes::new("", &[]);
        assert_eq!((none.of_text(""), none.to_string().parse()), (vec![], Ok(none)));
    }

    #[test]
    fn what_is_no_times_is_refused() {
        for bad in [
            "",
            ":",
            "9e881126",
            "9e881126:x",
            "8cb16ea:0-5@1-2",
            "9e881126:0-5@1-2,",
            "9e881126:5-0@1-2",
            "9e881126:0-5@2-1",
        ] {
            assert_eq!(bad.parse::<WordTimes>(), Err(ParseWordTimesError), "{bad}");
        }
        // Positions outside the text are ignored.
        let far = WordTimes {
            words: "0-99@1-2,3-4@5-6,18446744073709551615-18446744073709551615@1-2".into(),
            ..WordTimes::new("abc", &[])
        };
        assert_eq!(far.of_text("abc"), []);
    }
}
