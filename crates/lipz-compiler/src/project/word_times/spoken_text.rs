//! A text without everything that is not spoken, to which the times of words refer.

use lipz_file::text::{meta_ranges, segments};
use std::ops::Range;

/// A text without meta, delimiters and white space, and the source of its bytes.
pub(super) struct SpokenText {
    pub(super) spoken: String,
    /// For each stretch of the text: its start in `spoken`, and in the text. Words do not continue from one stretch to
    /// the next, except in scripts without spaces.
    stretches: Vec<(usize, usize)>,
}

impl SpokenText {
    pub(super) fn new(text: &str) -> SpokenText {
        let mut spoken = SpokenText { spoken: String::with_capacity(text.len()), stretches: Vec::new() };
        for segment in segments(text) {
            let mut at = segment.start;
            for meta in meta_ranges(&text[segment.clone()]) {
                spoken.add(text, at..segment.start + meta.start);
                at = segment.start + meta.end;
            }
            spoken.add(text, at..segment.end);
        }
        spoken
    }

    /// Adds a displayed part of the text.
    fn add(&mut self, text: &str, part: Range<usize>) {
        let mut is_new = true;
        for (at, c) in text[part.clone()].char_indices() {
            if c.is_whitespace() {
                is_new = true;
                continue;
            }
            if is_new {
                self.stretches.push((self.spoken.len(), part.start + at));
            }
            is_new = false;
            self.spoken.push(c);
        }
    }

    /// Returns the checksum of the spoken text. Half of the bits are sufficient to distinguish the texts of a clip.
    pub(super) fn checksum(&self) -> u32 {
        lipz_layout::checksum(self.spoken.as_bytes()) as u32
    }

    /// Converts a range of the text to one of the spoken text.
    pub(super) fn without_gaps(&self, range: &Range<usize>) -> Range<usize> {
        let start = self.place(range.start);
        start..self.place(range.end).max(start)
    }

    /// Converts a position in the text: the number of spoken bytes before it.
    fn place(&self, at: usize) -> usize {
        let index = self.stretches.partition_point(|(_, start)| *start <= at);
        let Some((spoken, start)) = index.checked_sub(1).and_then(|index| self.stretches.get(index)) else { return 0 };
        (spoken + (at - start)).min(self.end_of(index - 1))
    }

    /// Converts a range of the spoken text to one of the text, including gaps inside, but not at its ends. Returns
    /// `None` if the spoken text does not have the range.
    pub(super) fn with_gaps(&self, range: &Range<usize>) -> Option<Range<usize>> {
        self.spoken.get(range.clone())?;
        let last = self.stretches.last().copied().unwrap_or_default();
        let before = |at: usize| {
            let index = self.stretches.partition_point(|(start, _)| *start < at);
            let (spoken, start) = self.stretches.get(index.checked_sub(1)?)?;
            Some(start + (at - spoken))
        };
        let start = match self.stretches.partition_point(|(start, _)| *start <= range.start) {
            _ if range.start == self.spoken.len() => last.1 + (range.start - last.0),
            index => self.stretches.get(index.checked_sub(1)?).map(|(spoken, at)| at + (range.start - spoken))?,
        };
        let end = if range.is_empty() { start } else { before(range.end)? };
        Some(start..end)
    }

    /// Returns where the stretch with this index ends in the spoken text.
    fn end_of(&self, index: usize) -> usize {
        self.stretches.get(index + 1).map_or(self.spoken.len(), |(start, _)| *start)
    }

    /// Returns all positions in the spoken text where a word can start or end, in order.
    pub(super) fn boundaries(&self) -> Vec<usize> {
        let mut starts = self.stretches.iter().map(|(start, _)| *start).peekable();
        let mut found = Vec::new();
        let mut before: Option<char> = None;
        for (at, c) in self.spoken.char_indices() {
            let is_start = starts.next_if_eq(&at).is_some();
            let is_inside = before.is_some_and(|before| is_of_spaced_word(before) && is_of_spaced_word(c));
            if is_start || !is_inside {
                found.push(at);
            }
            before = Some(c);
        }
        found.push(self.spoken.len());
        found
    }
}

/// Whether the character belongs to a word in a script with spaces between words.
fn is_of_spaced_word(c: char) -> bool {
    let is_unspaced = matches!(c, '\u{e00}'..='\u{eff}' | '\u{1000}'..='\u{109f}' | '\u{1780}'..='\u{17ff}'
        | '\u{3040}'..='\u{30ff}' | '\u{31f0}'..='\u{31ff}' | '\u{3400}'..='\u{9fff}' | '\u{f900}'..='\u{faff}'
        | '\u{ff66}'..='\u{ff9f}' | '\u{20000}'..='\u{3ffff}');
    c.is_alphanumeric() && !is_unspaced
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_lead_to_the_spoken_text_and_back() {
        let text = " {x}He{m}llo |{y} you! 東京{z}";
        let spoken = SpokenText::new(text);
        assert_eq!(spoken.spoken, "Helloyou!東京");
        for word in ["He{m}llo", "you!", "you", "東京", "京", "llo"] {
            let start = text.find(word).expect("the word");
            let range = start..start + word.len();
            assert_eq!(spoken.with_gaps(&spoken.without_gaps(&range)), Some(range), "{word}");
        }
        assert_eq!(spoken.with_gaps(&(5..5)), text.find("you").map(|at| at..at), "the next word");
        let end = spoken.spoken.len();
        assert_eq!(spoken.with_gaps(&(end..end)), text.find("{z}").map(|at| at..at));
        assert_eq!((spoken.with_gaps(&(end..end + 1)), spoken.with_gaps(&(10..11))), (None, None));
        assert_eq!(spoken.boundaries(), [0, 2, 5, 8, 9, 12, 15]);
        assert_eq!(SpokenText::new("").with_gaps(&(0..0)), Some(0..0));
    }
}
