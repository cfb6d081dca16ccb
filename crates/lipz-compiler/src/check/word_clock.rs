//! The times of the words in a text: in the recording, or else estimated as a share of the spoken frames.

use crate::clip::ClipData;
use crate::project::{WordTime, WordTimes};
use lipz_bank::Micros;
use lipz_file::text;
use std::ops::Range;

/// The code for rest.
pub(super) const REST: u8 = b'-';

/// Converts words of a text to frames of its clip.
pub(super) struct WordClock<'c> {
    clip: &'c ClipData,
    /// The words whose times are known, in order.
    times: Vec<WordTime>,
    /// The bytes of each segment.
    segments: Vec<Range<usize>>,
    /// The position of each letter and digit that is displayed.
    letters: Vec<usize>,
    /// The frames in which the mouth does not rest.
    spoken: Vec<u32>,
}

impl<'c> WordClock<'c> {
    /// Creates the clock of a text. Braces enclose meta, unless they are literal.
    pub(super) fn new(
        clip: &'c ClipData,
        text: &str,
        literal_braces: bool,
        times: Option<&WordTimes>,
    ) -> WordClock<'c> {
        let times = times.map(|times| times.of_text(text)).unwrap_or_default();
        let segments: Vec<Range<usize>> = text::segments(text).collect();
        let mut letters = Vec::new();
        let mut add = |part: Range<usize>| {
            let found = text[part.clone()].char_indices().filter(|(_, c)| c.is_alphanumeric());
            letters.extend(found.map(|(at, _)| part.start + at));
        };
        for segment in &segments {
            let metas = if literal_braces { Vec::new() } else { text::meta_ranges(&text[segment.clone()]) };
            let mut at = segment.start;
            for meta in metas {
                add(at..segment.start + meta.start);
                at = segment.start + meta.end;
            }
            add(at..segment.end);
        }
        let spoken = clip.frames.iter().zip(0..).filter(|(code, _)| **code != REST).map(|(_, frame)| frame);
        WordClock { clip, times, segments, letters, spoken: spoken.collect() }
    }

    /// Returns the word that contains a byte of the text, if its time is known.
    pub(super) fn word_at(&self, byte: usize) -> Option<&WordTime> {
        let place = self.times.partition_point(|time| time.range.end <= byte);
        self.times.get(place).filter(|time| time.range.start <= byte)
    }

    /// Returns the first displayed letter or digit from a byte on, in the same segment.
    pub(super) fn next_letter(&self, segment: usize, byte: usize) -> Option<usize> {
        let letter = self.letters.get(self.letters_before(byte))?;
        self.segments.get(segment).is_some_and(|range| range.contains(letter)).then_some(*letter)
    }

    /// Returns the frame at a time of the recording, within a segment.
    pub(super) fn frame_at(&self, segment: usize, ms: u32) -> u32 {
        let frame = self.clip.fps.and_then(|fps| fps.frame_at(Micros(i64::from(ms) * 1000))).unwrap_or(0);
        let frames = self.frames(segment);
        frame.clamp(frames.start, frames.end)
    }

    /// Returns the frame of a byte that is in no word with a known time: its share, by letters and digits, of the spoken
    /// frames of its segment, between the words whose times are known.
    pub(super) fn share(&self, segment: usize, byte: usize) -> u32 {
        let mut frames = self.frames(segment);
        let Some(mut bytes) = self.segments.get(segment).cloned() else { return frames.start };
        let next = self.times.partition_point(|time| time.range.end <= byte);
        let before = next.checked_sub(1).and_then(|before| self.times.get(before));
        let (segment_bytes, has_rate) = (bytes.clone(), self.clip.fps.is_some());
        let is_inside = |word: &&WordTime| has_rate && segment_bytes.contains(&word.range.start);
        if let Some(word) = before.filter(is_inside) {
            bytes.start = word.range.end;
            frames.start = self.frame_at(segment, word.end_ms);
        }
        if let Some(word) = self.times.get(next).filter(is_inside).filter(|word| word.range.start >= byte) {
            bytes.end = word.range.start;
            frames.end = self.frame_at(segment, word.start_ms).max(frames.start);
        }
        let [start, at, end] = [bytes.start, byte, bytes.end].map(|byte| self.letters_before(byte) as u64);
        let spoken = |frame: u32| self.spoken.partition_point(|spoken| *spoken < frame);
        let spoken = &self.spoken[spoken(frames.start)..spoken(frames.end)];
        let count = if spoken.is_empty() { u64::from(frames.end - frames.start) } else { spoken.len() as u64 };
        let (before, whole) = (at.saturating_sub(start), end.saturating_sub(start).max(1));
        let index = ((2 * count * before + whole) / (2 * whole)).min(count);
        match spoken.last() {
            None => frames.start + index as u32,
            Some(last) => spoken.get(index as usize).copied().unwrap_or(last + 1),
        }
    }

    /// Returns the frames of a segment.
    pub(super) fn frames(&self, segment: usize) -> Range<u32> {
        let start = self.clip.segment_start(segment);
        start..self.clip.segment_start(segment + 1).max(start)
    }

    /// Returns the number of letters and digits before a byte.
    fn letters_before(&self, byte: usize) -> usize {
        self.letters.partition_point(|letter| *letter < byte)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_bank::Fps;

    fn clip(frames: &str, starts: &[u32]) -> ClipData {
        let fps = Fps::new(10, 1);
        ClipData { frames: frames.bytes().collect(), starts: starts.to_vec(), fps, ..ClipData::default() }
    }

    #[test]
    fn words_are_not_in_rests() {
        let text = "ab{x} cd|{y}ef gh";
        let clip = clip("----MAEO--MAEO----|----".replace('|', "").as_str(), &[0, 18]);
        let clock = WordClock::new(&clip, text, false, None);
        let share =
            |word: &str| clock.share(usize::from(text.find('|') < text.find(word)), text.find(word).unwrap_or(0));
        assert_eq!((share("ab"), share("b{"), share("cd"), share("d|")), (4, 6, 10, 12));
        assert_eq!(clock.share(0, 8), 14, "behind the last word");
        // A segment of rest has nothing better.
        assert_eq!((share("ef"), share("gh")), (18, 20));
        assert_eq!(
            (clock.next_letter(0, 2), clock.next_letter(0, 8), clock.next_letter(1, 9)),
            (Some(6), None, Some(12))
        );
    }

    #[test]
    fn words_without_times_are_between_those_with_times() {
        let text = "one two three four";
        let word = |range, start_ms, end_ms| WordTime { range, start_ms, end_ms, is_doubtful: false };
        let times = WordTimes::new(text, &[word(0..3, 0, 500), word(14..18, 1500, 2000)]);
        let clip = clip("MAEOM--MAEOMAEO-----", &[0]);
        let clock = WordClock::new(&clip, text, false, Some(&times));
        assert_eq!(clock.word_at(1).map(|word| word.end_ms), Some(500));
        // Eight letters in the eight spoken frames from 7 to 14.
        assert_eq!((clock.share(0, 4), clock.share(0, 8)), (7, 10));
    }
}
