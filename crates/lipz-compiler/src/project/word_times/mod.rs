//! The times of the words of a text, obtained from its recording.

mod carry;
mod spoken_text;

use spoken_text::SpokenText;
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

/// The times of the words of a text. They are found again by the spoken text: meta, `|` and white space may change. If
/// words have changed as well, the remaining ones keep their times.
///
/// As a string: the checksum of the spoken text, then for each word its bytes there, its hash and its milliseconds, and
/// `?` if it is doubtful.
///
/// ```
/// use lipz_compiler::{WordTime, WordTimes};
/// let words = [WordTime { range: 1..6, start_ms: 120, end_ms: 480, is_doubtful: true }];
/// let times = WordTimes::new(" Mayor? | Aye.", &words);
/// assert_eq!(times.to_string(), "de7f152d:0-5#b413@120-480?");
/// let moved = WordTime { range: 9..14, ..words[0].clone() };
/// assert_eq!(times.of_text("{anger 2}Mayor?|Aye."), [moved.clone()]);
/// assert_eq!(times.of_text("Well, an|mayor!"), [moved]);
/// assert_eq!(times.of_text("Mare?|Aye."), []);
/// ```
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct WordTimes {
    /// In text form to save memory, because there may be one for each of a hundred thousand clips. Validated on
    /// creation.
    words: Box<str>,
    checksum: u32,
}

/// A word as it is stored: its range is that in the spoken text.
struct StoredWord {
    time: WordTime,
    /// `None` if an older version wrote it.
    hash: Option<u16>,
}

impl WordTimes {
    /// Creates the times of these words of `text`, in order.
    pub fn new(text: &str, words: &[WordTime]) -> WordTimes {
        let spoken = SpokenText::new(text);
        let mut entries = String::new();
        for word in words {
            let range = spoken.without_gaps(&word.range);
            let Some(said) = spoken.spoken.get(range.clone()) else { continue };
            let WordTime { start_ms, end_ms, is_doubtful, .. } = *word;
            let (comma, doubt) = (if entries.is_empty() { "" } else { "," }, if is_doubtful { "?" } else { "" });
            let hash = carry::hash(said);
            entries += &format!("{comma}{}-{}#{hash:04x}@{start_ms}-{end_ms}{doubt}", range.start, range.end);
        }
        WordTimes { words: entries.into(), checksum: spoken.checksum() }
    }

    /// Returns the words with their positions in `text`, in order. If it is a different text, only those that it still
    /// has are returned.
    pub fn of_text(&self, text: &str) -> Vec<WordTime> {
        let spoken = SpokenText::new(text);
        let words: Vec<StoredWord> = self.words.split(',').filter_map(stored_word).collect();
        let starts = match spoken.checksum() == self.checksum {
            true => words.iter().map(|word| Some(word.time.range.start)).collect(),
            false => carry::starts_in(&words, &spoken),
        };
        let place = |(word, start): (StoredWord, Option<usize>)| {
            let end = start?.checked_add(word.time.range.len())?;
            Some(WordTime { range: spoken.with_gaps(&(start?..end))?, ..word.time })
        };
        words.into_iter().zip(starts).filter_map(place).collect()
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
        f.write_str("the word times do not have a form such as `de7f152d:0-5#b413@120-480,6-9#03ac@480-700?`")
    }
}

impl std::error::Error for ParseWordTimesError {}

impl FromStr for WordTimes {
    type Err = ParseWordTimesError;

    fn from_str(text: &str) -> Result<WordTimes, ParseWordTimesError> {
        let (checksum, words) = text.split_once(':').filter(|(sum, _)| sum.len() == 8).ok_or(ParseWordTimesError)?;
        let checksum = u32::from_str_radix(checksum, 16).map_err(|_| ParseWordTimesError)?;
        let is_known = words.is_empty() || words.split(',').all(|word| stored_word(word).is_some());
        is_known.then(|| WordTimes { words: words.into(), checksum }).ok_or(ParseWordTimesError)
    }
}

/// Parses `0-5#b413@120-480?`.
fn stored_word(entry: &str) -> Option<StoredWord> {
    let (entry, is_doubtful) = match entry.strip_suffix('?') {
        Some(entry) => (entry, true),
        None => (entry, false),
    };
    let (word, times) = entry.split_once('@')?;
    let (bytes, hash) = match word.split_once('#') {
        Some((bytes, hash)) => (bytes, Some(u16::from_str_radix(hash, 16).ok().filter(|_| hash.len() == 4)?)),
        None => (word, None),
    };
    let ((start, end), (start_ms, end_ms)) = (bytes.split_once('-')?, times.split_once('-')?);
    let range = start.parse().ok()?..end.parse().ok()?;
    let time = WordTime { range, start_ms: start_ms.parse().ok()?, end_ms: end_ms.parse().ok()?, is_doubtful };
    (time.range.start <= time.range.end && time.start_ms <= time.end_ms).then_some(StoredWord { time, hash })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(range: Range<usize>, start_ms: u32) -> WordTime {
        WordTime { range, start_ms, end_ms: start_ms + 100, is_doubtful: start_ms > 500 }
    }

    /// The times of all words of a text, 200 ms apart.
    fn times(text: &str, words: &[&str]) -> (WordTimes, Vec<WordTime>) {
        let mut at = 0;
        let place = |(found, ms): (&&str, u32)| {
            let start = at + text[at..].find(found).expect("the word");
            at = start + found.len();
            word(start..at, ms)
        };
        let words: Vec<WordTime> = words.iter().zip((0..).step_by(200)).map(place).collect();
        (WordTimes::new(text, &words), words)
    }

    /// The words that a text still has, with their times.
    fn found<'t>(times: &WordTimes, text: &'t str) -> Vec<(&'t str, u32)> {
        times.of_text(text).into_iter().map(|word| (&text[word.range], word.start_ms)).collect()
    }

    #[test]
    fn words_are_found_again_whatever_is_not_spoken() {
        let text = "Wer {leise} da?|  Müller |\tund 東京 ";
        let (times, words) = times(text, &["Wer", "da", "Müller", "und", "東京"]);
        assert_eq!(times.of_text(text), words);
        assert_eq!(times.doubtful_count(), 2);
        let all = [("Wer", 0), ("da", 200), ("Müller", 400), ("und", 600), ("東京", 800)];
        for same in [
            "Wer {leise} da?  |Müller  |und 東京",
            "Wer da?|Müller und|東京",
            "{anger 6}Wer da?{} {joy 1} Müller |und\u{a0}東京",
            // Also with another sign, or louder.
            "Wer da!|Müller – und *東京*",
            "WER, da: „Müller“ und 東京",
        ] {
            let same: Vec<(String, u32)> = found(&times, same).into_iter().map(|(w, ms)| (w.to_owned(), ms)).collect();
            let same: Vec<(&str, u32)> = same.iter().map(|(w, ms)| (if w == "WER" { "Wer" } else { w }, *ms)).collect();
            assert_eq!(same, all);
        }
        assert_eq!(found(&times, "Wer da? Müller und 東{sad}京").last(), Some(&("東{sad}京", 800)));
        assert_eq!(times.to_string().parse(), Ok(times));
        let none = WordTimes::new("", &[]);
        assert_eq!((none.of_text(""), none.to_string().parse()), (vec![], Ok(none)));
    }

    #[test]
    fn words_keep_their_times_when_others_change() {
        let text = "No, no. I told you to leave, and you told me no.";
        let spoken = ["No", "no", "I", "told", "you", "to", "leave", "and", "you", "told", "me", "no"];
        let (times, _) = times(text, &spoken);
        // A word more, a word less, and another word.
        let changed = "No, no. I really told you {anger 6} to go, you told me no.";
        let expected = [
            ("No", 0),
            ("no", 200),
            ("I", 400),
            ("told", 600),
            ("you", 800),
            ("to", 1000),
            ("you", 1600),
            ("told", 1800),
            ("me", 2000),
            ("no", 2200),
        ];
        assert_eq!(found(&times, changed), expected);
        assert_eq!(found(&times, "me told to"), [("me", 2000)], "in another order");
        assert_eq!(found(&times, "Nothing is left of them."), [("leave", 0); 0], "parts of words are no words");
        assert_eq!(found(&times, ""), []);
    }

    #[test]
    fn scripts_without_spaces_keep_their_times() {
        let (times, _) = times("今日は東京へ行く。", &["今日", "は", "東京", "へ", "行く"]);
        let expected = [("今日", 0), ("は", 200), ("東京", 400), ("へ", 600)];
        assert_eq!(found(&times, "今日は{joy 2}また東京へ帰る。"), expected);
    }

    /// Ten thousand words, many of them equal, in time that grows with their number.
    #[test]
    fn long_texts_are_compared_word_by_word() {
        let words: Vec<String> = (0..10_000).map(|number| format!("word{}", number % 977 * (number % 7))).collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let (times, all) = times(&words.join(" "), &words);
        let changed = words.join(" ").replacen("word", "{joy 1} start word", 1) + " end";
        assert_eq!(times.of_text(&changed).len(), all.len());
    }

    #[test]
    fn what_is_no_times_is_refused() {
        for bad in [
            "",
            ":",
            "9e881126",
            "9e881126:x",
            "8cb16ea:0-5@1-2",
            "9e881126:0-5#abc@1-2",
            "9e881126:0-5#wxyz@1-2",
            "9e881126:0-5@1-2,",
            "9e881126:5-0@1-2",
            "9e881126:0-5@2-1",
        ] {
            assert_eq!(bad.parse::<WordTimes>(), Err(ParseWordTimesError), "{bad}");
        }
        // An older version did not store hashes, and its checksums were those of a different text.
        let old: WordTimes = "9e881126:0-5@120-480".parse().expect("an older record");
        assert_eq!((old.is_empty(), old.of_text("Mayor?|Aye.")), (false, vec![]));
        // Positions outside the text are ignored.
        let far = WordTimes {
            words: "0-99@1-2,3-4@5-6,18446744073709551615-18446744073709551615@1-2".into(),
            ..WordTimes::new("abc", &[])
        };
        assert_eq!(far.of_text("abc"), []);
    }
}
