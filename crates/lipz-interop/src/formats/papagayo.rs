//! What both formats of Papagayo have in common: voices of words of phonemes, on frames counted from 0.

use crate::{Shape, Text, Time, Timed, Track};
use lipz_file::rate::Rate;
use lipz_file::text::trim;

/// Tables of the phoneme sets that Papagayo ships.
pub(super) const MAPS: &[&str] = &["papagayo", "fleming-dobbs", "cmu", "rhubarb", "rhubarb-toonboom"];
/// The name of the resting mouth in every set.
const REST: &str = "rest";

/// A voice on its way to a track.
pub(super) struct Voice {
    pub(super) track: Track,
    rate: Rate,
    /// The frame behind the last word: the mouth rests from there to the next one.
    word_end: Option<u64>,
}

impl Voice {
    /// A voice with a text whose line breaks are `|`.
    pub(super) fn new(name: String, text: &str, rate: Rate) -> Voice {
        // A break at the end of the text divides nothing.
        let text = trim(text).trim_end_matches('|').to_owned();
        let texts = if text.is_empty() { Vec::new() } else { vec![Text { locale: None, text }] };
        let track = Track { name: Some(name), rate: Some(rate), texts, ..Track::default() };
        Voice { track, rate, word_end: None }
    }

    pub(super) fn word(&mut self, text: &str, start: u64) {
        self.track.words.push(Timed { start: Time::of_frame(start, self.rate), text: text.to_owned() });
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

    /// Rests between the last word and a frame, if there is anything between them.
    fn rest_until(&mut self, frame: u64, span: Option<lipz_diagnostics::Span>) {
        if let Some(end) = self.word_end.take().filter(|end| *end < frame) {
            self.track.shapes.push(Shape { start: Time::of_frame(end, self.rate), symbol: REST.to_owned(), span });
        }
    }
}
