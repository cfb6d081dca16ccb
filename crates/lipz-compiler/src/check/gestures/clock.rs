//! The times of the words in a text.

use super::words::SpokenWord;
use crate::check::word_clock::{REST, WordClock};

/// Converts words to frames of their clip, including the rest that may follow them.
pub(super) struct Clock<'c> {
    words: WordClock<'c>,
    /// For each frame, the first frame of the rest that it belongs to, or itself.
    rest_starts: Vec<u32>,
}

impl<'c> Clock<'c> {
    pub(super) fn new(words: WordClock<'c>, frames: &[u8]) -> Clock<'c> {
        let mut first = None;
        let rest_starts = frames.iter().zip(0..).map(|(code, frame)| {
            first = if *code == REST { first.or(Some(frame)) } else { None };
            first.unwrap_or(frame)
        });
        Clock { words, rest_starts: rest_starts.collect() }
    }

    /// Returns the frame that follows this number of a word's letters.
    pub(super) fn start(&self, word: &SpokenWord<'_>, letters: usize) -> u32 {
        let byte = word.start + word.text.char_indices().nth(letters).map_or(0, |(byte, _)| byte);
        match self.words.word_at(byte) {
            Some(time) => self.words.frame_at(word.segment, time.start_ms),
            None => self.words.share(word.segment, byte),
        }
    }

    /// Returns the frame in which a word ends. If the mouth rests after the word, it is the first frame of the rest.
    pub(super) fn end(&self, word: &SpokenWord<'_>) -> u32 {
        let last = word.text.chars().next_back().map_or(0, char::len_utf8);
        if let Some(time) = self.words.word_at(word.end() - last) {
            return self.words.frame_at(word.segment, time.end_ms);
        }
        let end = self.words.share(word.segment, word.end());
        let start = self.words.frames(word.segment).start;
        let before = end.checked_sub(1).and_then(|before| self.rest_starts.get(before as usize));
        before.filter(|rest| **rest + 1 < end && **rest > start).copied().unwrap_or(end)
    }
}
