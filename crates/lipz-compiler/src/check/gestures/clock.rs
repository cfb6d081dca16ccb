//! The times of the words in a text.

use super::words::{SpokenWord, Words};
use crate::check::share::share_of_segment;
use crate::clip::ClipData;
use crate::project::WordTime;
use lipz_bank::{Fps, Micros};

/// The code for rest.
pub(super) const REST: u8 = b'-';

/// Converts words to frames of their clip. It uses the recognised times of the words if there are any, and else their
/// share of the segment by letters.
pub(super) struct Clock<'c> {
    clip: &'c ClipData,
    fps: Fps,
    times: Vec<WordTime>,
    letters: &'c [usize],
    /// For each frame, the first frame of the rest that it belongs to, or itself.
    rest_starts: Vec<u32>,
}

impl<'c> Clock<'c> {
    pub(super) fn new(clip: &'c ClipData, fps: Fps, times: Vec<WordTime>, words: &'c Words<'_>) -> Clock<'c> {
        let mut first = None;
        let rest_starts = clip.frames.iter().zip(0..).map(|(code, frame)| {
            first = if *code == REST { first.or(Some(frame)) } else { None };
            first.unwrap_or(frame)
        });
        Clock { clip, fps, times, letters: &words.letters, rest_starts: rest_starts.collect() }
    }

    /// Returns the frame that follows this number of a word's letters.
    pub(super) fn start(&self, word: &SpokenWord<'_>, letters: usize) -> u32 {
        let byte = word.start + word.text.char_indices().nth(letters).map_or(0, |(byte, _)| byte);
        match self.heard(byte) {
            Some(time) => self.frame_of(word.segment, time.start_ms),
            None => self.share(word.segment, word.letters_before + letters),
        }
    }

    /// Returns the frame in which a word ends. If the mouth rests after the word, it is the first frame of the rest.
    pub(super) fn end(&self, word: &SpokenWord<'_>) -> u32 {
        let last = word.text.chars().next_back().map_or(0, char::len_utf8);
        if let Some(time) = self.heard(word.end() - last) {
            return self.frame_of(word.segment, time.end_ms);
        }
        let letters = word.text.chars().filter(|c| c.is_alphanumeric()).count();
        let end = self.share(word.segment, word.letters_before + letters);
        let start = self.segment_start(word.segment);
        let before = end.checked_sub(1).and_then(|before| self.rest_starts.get(before as usize));
        before.filter(|rest| **rest + 1 < end && **rest > start).copied().unwrap_or(end)
    }

    /// Returns the time of the word at this byte of the text.
    fn heard(&self, byte: usize) -> Option<&WordTime> {
        let place = self.times.partition_point(|time| time.range.end <= byte);
        self.times.get(place).filter(|time| time.range.start <= byte)
    }

    fn frame_of(&self, segment: usize, ms: u32) -> u32 {
        let frame = self.fps.frame_at(Micros(i64::from(ms) * 1000)).unwrap_or(0);
        let (start, end) = (self.segment_start(segment), self.segment_start(segment + 1));
        frame.clamp(start, end)
    }

    fn share(&self, segment: usize, letters: usize) -> u32 {
        let whole = self.letters.get(segment).copied().unwrap_or(0);
        share_of_segment(self.segment_start(segment)..self.segment_start(segment + 1), letters, whole)
    }

    fn segment_start(&self, segment: usize) -> u32 {
        self.clip.segment_start(segment)
    }
}
