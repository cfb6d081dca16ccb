//! The common parts of both Papagayo formats: voices of words of phonemes, on frames counted from 0, and phoneme sets.

use crate::{ImportOptions, Map, Shape, Text, Time, TimedText, Track, find_map};
use lipz_diagnostics::escape;
use lipz_file::rate::Rate;
use lipz_file::text::trim;

/// The tables of the phoneme sets that come with Papagayo.
pub(super) const MAPS: &[&str] = &["papagayo", "fleming-dobbs", "cmu", "rhubarb", "rhubarb-toonboom"];
/// The name of rest in every set.
const REST: &str = "rest";

/// The phoneme sets of Papagayo-NG with their tables, the default one first.
const SETS: [(&str, &[&str]); 4] = [
    ("preston_blair", &["papagayo"]),
    ("fleming_dobbs", &["fleming-dobbs"]),
    ("cmu_39", &["cmu"]),
    ("rhubarb", &["rhubarb", "rhubarb-toonboom"]),
];

/// Returns the tracks of a project with the table of its phoneme set. Without a set, the table is the first one that has
/// all phonemes. Rest has the symbol of the table.
pub(super) fn with_table(mut tracks: Vec<Track>, set: Option<&str>, options: &ImportOptions<'_>) -> Vec<Track> {
    let set = set.map(|set| set.trim().to_ascii_lowercase().replace(['-', ' '], "_"));
    let of_set = set.as_deref().and_then(|set| SETS.iter().find(|(name, _)| *name == set)).map(|(_, maps)| *maps);
    let has = |map: &Map, shape: &Shape| shape.symbol == REST || map.code(&shape.symbol).is_some();
    let has_all = |map: &Map| tracks.iter().flat_map(|track| &track.shapes).all(|shape| has(map, shape));
    let maps = || of_set.unwrap_or(MAPS).iter().filter_map(|name| Some((*name, find_map(name)?)));
    let of_type = || maps().filter(|(_, map)| options.viseme_type.is_none_or(|wanted| wanted == map.viseme_type));
    let chosen = of_type().find(|(_, map)| has_all(map)).or_else(|| of_type().next()).or_else(|| maps().next());
    let Some((name, map)) = chosen else { return tracks };
    let map = options.map.unwrap_or(map);
    let rest = map.code(REST).is_none().then(|| map.symbol(b'-')).flatten();
    for track in &mut tracks {
        track.map = Some(name);
        if let Some(rest) = rest {
            track
                .shapes
                .iter_mut()
                .filter(|shape| shape.symbol == REST)
                .for_each(|shape| rest.clone_into(&mut shape.symbol));
        }
        if let Some(unknown) = set.as_deref().filter(|_| of_set.is_none()) {
            let unknown = escape::quoted(unknown);
            track
                .remarks
                .push(format!("lipz does not have a table for the phoneme set {unknown}, so it uses `{name}`"));
        }
    }
    tracks
}

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
