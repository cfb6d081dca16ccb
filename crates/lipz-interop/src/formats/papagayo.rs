//! The common parts of both Papagayo formats: voices of words of phonemes, on frames counted from 0.

use crate::{Shape, Text, Time, TimedText, Track};
use lipz_file::rate::Rate;
use lipz_file::text::trim;

/// The tables of the phoneme sets that come with Papagayo.
pub(super) const MAPS: &[&str] = &["papagayo", "fleming-dobbs", "cmu", "rhubarb", "rhubarb-toonboom"];
/// The name of rest in every set.
const REST: &str = "rest";

/// A voice that is being converted to a track.
pub(super) struct PapagayoVoice {
    pub(super) track: Track,
    rate: Rate,
    /// The frame after the last word, from which the mouth rests until the next word.
    word_end: Option<u64>,
}

impl PapagayoVoice {
    /// Returns a voice with a text whose line breaks are `|`.
    pub(super) fn new(name: String, text: &str, rate: Rate) -> PapagayoVoice {
        // Breaks at the end of the text are dropped.
        let text = trim(text).trim_end_matches('|').to_owned();
        let texts = if text.is_empty() { Vec::new() } else { vec![Text { locale: None, text }] };
        let track = Track { name: Some(name), rate: Some(rate), texts, ..Track::default() };
        PapagayoVoice { track, rate, word_end: None }
    }

    pub(super) fn word(&mut self, text: &str, start: u64) {
        self.track.words.push(TimedText { start: Time::of_frame(start, self.rate), text: text.to_owned() });
    }

    /// Adds a phoneme that starts on a frame.
    pub(super) fn phoneme(&mut self, frame: u64, shape: impl FnOnce(Time) -> Shape) {
        let shape = shape(Time::of_frame(frame, self.rate));
        self.rest_until(frame, shape.span);
        self.track.shapes.push(shape);
    }

    /// Ends a word with its last frame.
    pub(super) fn end_word(&mut self, frame: u64) {
        self.word_end = Some(frame.saturating_add(1));
    }

    /// Ends the voice with the recording.
    pub(super) fn end(&mut self, frames: u64) {
        let last = self.track.shapes.last().and_then(|shape| shape.span);
        self.rest_until(frames, last);
        self.track.end = Some(Time::of_frame(frames, self.rate));
    }

    /// Adds a rest between the last word and a frame, if there is a gap.
    fn rest_until(&mut self, frame: u64, span: Option<lipz_diagnostics::Span>) {
        if let Some(end) = self.word_end.take().filter(|end| *end < frame) {
            self.track.shapes.push(Shape { start: Time::of_frame(end, self.rate), symbol: REST.to_owned(), span });
        }
    }
}
