//! The spoken words of a text, and the characters around them.

use lipz_file::text;
use std::ops::Range;

/// A spoken word.
pub(super) struct SpokenWord<'t> {
    pub(super) text: &'t str,
    pub(super) segment: usize,
    /// Its offset in the text, in bytes.
    pub(super) start: usize,
    /// The characters before it, from the previous word or meta.
    before: &'t str,
    /// The characters after it, up to the next word or meta.
    behind: &'t str,
    /// Whether a word follows before the next meta.
    goes_on: bool,
}

/// The words of a text.
pub(super) struct Words<'t> {
    pub(super) words: Vec<SpokenWord<'t>>,
}

impl<'t> Words<'t> {
    /// Returns the words of a text. Braces enclose meta, unless they are literal.
    pub(super) fn of(whole: &'t str, literal_braces: bool) -> Words<'t> {
        let mut words = Words { words: Vec::new() };
        for (number, segment) in text::segments(whole).enumerate() {
            let metas = if literal_braces { Vec::new() } else { text::meta_ranges(&whole[segment.clone()]) };
            let mut at = segment.start;
            for meta in metas {
                words.piece(whole, number, at..segment.start + meta.start);
                at = segment.start + meta.end;
            }
            words.piece(whole, number, at..segment.end);
        }
        words
    }

    /// Adds the words in a displayed range of a segment.
    fn piece(&mut self, whole: &'t str, segment: usize, range: Range<usize>) {
        let first = self.words.len();
        let mut end = range.start;
        let mut rest = &whole[range.clone()];
        while let Some(at) = rest.find(is_of_word) {
            let length = rest[at..].find(|c| !is_of_word(c)).unwrap_or(rest.len() - at);
            let text = &rest[at..at + length];
            let start = range.end - rest.len() + at;
            let before = &whole[end..start];
            (end, rest) = (start + length, &rest[at + length..]);
            if text.contains(char::is_alphanumeric) {
                let (behind, goes_on) = ("", false);
                self.words.push(SpokenWord { text, segment, start, before, behind, goes_on });
            }
        }
        let starts: Vec<usize> = self.words[first..].iter().map(|word| word.start).collect();
        for (number, word) in self.words[first..].iter_mut().enumerate() {
            let next = starts.get(number + 1).copied();
            word.behind = &whole[word.end()..next.unwrap_or(range.end)];
            word.goes_on = next.is_some();
        }
    }
}

impl SpokenWord<'_> {
    /// Returns the offset of its end in the text, in bytes.
    pub(super) fn end(&self) -> usize {
        self.start + self.text.len()
    }

    /// Returns the word in the form of the lists.
    pub(super) fn lower_case(&self) -> String {
        self.text.trim_matches(is_apostrophe).to_lowercase().replace('’', "'")
    }

    /// Whether only white space separates it from the next word.
    pub(super) fn leads_on(&self) -> bool {
        self.goes_on && self.behind.chars().all(char::is_whitespace)
    }

    /// Whether the word is emphasised by asterisks or underscores, as in `I *told* you`.
    pub(super) fn is_marked(&self) -> bool {
        self.before.ends_with(['*', '_'])
    }

    /// Whether it is written in capitals.
    pub(super) fn is_in_capitals(&self) -> bool {
        self.text.chars().filter(|c| c.is_uppercase()).count() > 1 && !self.has_small_letters()
    }

    /// Whether it has lower-case letters.
    pub(super) fn has_small_letters(&self) -> bool {
        self.text.chars().any(char::is_lowercase)
    }

    /// Whether it ends a sentence, and one of these marks follows.
    pub(super) fn is_before(&self, marks: &[char]) -> bool {
        self.ends_sentence() && self.behind.contains(marks)
    }

    /// Whether one of these marks follows.
    pub(super) fn is_followed_by(&self, marks: &[char]) -> bool {
        self.behind.contains(marks)
    }

    /// Whether a mark after it ends a sentence.
    pub(super) fn ends_sentence(&self) -> bool {
        let Some(at) = self.behind.find(is_end) else { return false };
        let rest = self.behind[at..].trim_start_matches(|c| is_end(c) || is_closing(c));
        // `3.5` and `lipz.toml` do not end. Scripts without spaces have marks of their own.
        !self.goes_on || rest.starts_with(char::is_whitespace) || !self.behind[at..].starts_with(['.', '!', '?'])
    }
}

/// Whether a character is a mark at the end of sentences, in any script.
fn is_end(c: char) -> bool {
    matches!(
        c,
        '.' | '!'
            | '?'
            | '…'
            | '。'
            | '！'
            | '？'
            | '．'
            | '؟'
            | '۔'
            | '।'
            | '॥'
            | '።'
            | '፧'
            | '։'
            | '՞'
            | '၊'
            | '။'
            | '។'
            | '៕'
    )
}

/// Whether a character is allowed between the end of a sentence and the next one.
fn is_closing(c: char) -> bool {
    matches!(c, '"' | '\'' | ')' | ']' | '*' | '_' | '”' | '’' | '»' | '«' | '」' | '』' | '）')
}

fn is_apostrophe(c: char) -> bool {
    matches!(c, '\'' | '’' | '-')
}

/// Whether a character belongs to a word. This includes letters with their marks, and all characters except white space
/// and punctuation marks, so that vowel signs of Indian scripts do not split words.
fn is_of_word(c: char) -> bool {
    let is_mark = match c {
        '\'' | '’' | '-' => false,
        _ if c.is_ascii() => !c.is_ascii_alphanumeric(),
        '«' | '»' | '¡' | '¿' | '·' | '،' | '؛' | '՝' | '՜' | '፣' | '፤' | '፥' => true,
        '\u{2010}'..='\u{2027}' | '\u{2030}'..='\u{205e}' | '\u{3000}'..='\u{303f}' | '\u{ff00}'..='\u{ff0f}' => true,
        '：' | '；' | '［' | '］' | '｛' | '｝' | '～' | '・' => true,
        _ => false,
    };
    !(is_mark || c.is_whitespace() || c.is_control() || is_end(c))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(usize, &str)> {
        Words::of(text, false).words.iter().map(|word| (word.segment, word.text)).collect()
    }

    /// Returns the last words of all sentences.
    fn ends(text: &str) -> Vec<&str> {
        Words::of(text, false).words.iter().filter(|word| word.ends_sentence()).map(|word| word.text).collect()
    }

    #[test]
    fn words_of_several_scripts() {
        assert_eq!(
            words("Don’t {quietly} go -- *there*, x-ray!"),
            [(0, "Don’t"), (0, "go"), (0, "there"), (0, "x-ray")]
        );
        assert_eq!(words("बिल्कुल नहीं।|はい、そうです。"), [(0, "बिल्कुल"), (0, "नहीं"), (1, "はい"), (1, "そうです")]);
        assert_eq!(words(" |{meta}|..."), []);
    }

    #[test]
    fn ends_of_sentences() {
        assert_eq!(ends("It is 3.5 of lipz.toml. \"Really?\" Yes"), ["toml", "Really"]);
        assert_eq!(ends("Wait... {calm} no!|对。好"), ["Wait", "no", "对"]);
        assert_eq!(ends("No, he, she"), [""; 0]);
    }

    /// Returns the words for which `is` is true.
    fn filtered<'t>(words: &[SpokenWord<'t>], is: impl Fn(&SpokenWord<'t>) -> bool) -> Vec<&'t str> {
        words.iter().filter(|word| is(word)).map(|word| word.text).collect()
    }

    #[test]
    fn stress() {
        let all = Words::of("I *told* you NOT to, I said!", false).words;
        assert_eq!(filtered(&all, SpokenWord::is_marked), ["told"]);
        assert_eq!(filtered(&all, SpokenWord::is_in_capitals), ["NOT"]);
        assert_eq!(filtered(&all, |word| word.is_before(&['!'])), ["said"]);
        assert_eq!(filtered(&all, SpokenWord::leads_on), ["you", "NOT", "I"]);
    }
}
