//! The starts of a clip's segments in a new lip-sync track.

use super::{MergeOptions, Mouth, Parts, codes_of};
use crate::frames::ShapeRun;
use crate::import::REST;
use crate::segments::{PartStart, Speech, guessed};
use crate::subtitles::bounds;
use crate::{Time, TimedText};
use lipz_diagnostics::Diagnostic;
use lipz_file::Document;
use lipz_file::rate::Rate;
use lipz_file::text::{display, segments};

/// The number of words of a track that are searched for the next word of a text. A few may be inserted or misheard.
const WORDS_AHEAD: usize = 8;

/// Returns the first frames of all segments except the first, ascending. Reports guesses.
pub(super) fn starts(
    parts: &Parts<'_>,
    clip: &Document<'_>,
    mouth: &Mouth,
    options: &MergeOptions<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<usize> {
    let wanted = parts.count - 1;
    let old = OldMouth::from_document(clip, wanted, options.default_rate.unwrap_or(mouth.rate));
    let frames = mouth.codes.len();
    let in_frames = |times: &[Time]| {
        let mut done = 0;
        let frame = |time: &Time| {
            done = usize::try_from(time.nearest_frame(mouth.rate)).unwrap_or(frames).clamp(done, frames);
            done
        };
        times.iter().map(frame).collect()
    };
    if wanted == 0 || frames == 0 {
        return vec![0; wanted]; // there is only one place
    }
    if let Some(known) = mouth.segment_starts.as_ref().filter(|starts| starts.len() == wanted) {
        return in_frames(known);
    }
    if let Some(old) = old.as_ref().filter(|old| old.codes == mouth.codes && is_same(old.rate, mouth.rate)) {
        return old.starts.clone();
    }
    if mouth.phrases.len() == parts.count {
        return in_frames(&mouth.phrases.iter().skip(1).map(|phrase| phrase.start).collect::<Vec<_>>());
    }
    let by_words = parts.spoken.map(|text| word_starts(text, &mouth.words)).unwrap_or_default();
    if !by_words.is_empty() && by_words.iter().all(Option::is_some) {
        return in_frames(&by_words.into_iter().flatten().collect::<Vec<_>>());
    }
    let speech = speech(&mouth.codes, mouth.rate);
    let end = Time::of_frame(frames as u64, mouth.rate);
    let (places, note) = match (&old, parts.spoken) {
        (Some(old), _) => {
            (old.places(&speech, end, options.min_pause), "guessed from their position in the previous visemes")
        }
        (None, text) => {
            let letters = |range| {
                display(text.unwrap_or_default().get(range).unwrap_or_default())
                    .text
                    .chars()
                    .filter(|c| c.is_alphanumeric())
                    .count()
            };
            let lengths: Vec<usize> = segments(text.unwrap_or_default()).map(letters).collect();
            (speech.starts(&lengths, options.min_pause), "guessed with the same time for each letter")
        }
    };
    let known = by_words.into_iter().chain(std::iter::repeat(None));
    let places: Vec<PartStart> = places
        .into_iter()
        .zip(known)
        .map(|(place, known)| known.map_or(place, |time| PartStart { time, is_guess: false }))
        .collect();
    diagnostics.extend(guessed(&places, note));
    in_frames(&places.iter().map(|place| place.time).collect::<Vec<_>>())
}

/// The current lip-sync track of a clip, divided like the clip.
struct OldMouth {
    codes: String,
    rate: Rate,
    /// The first frames of all segments except the first.
    starts: Vec<usize>,
}

impl OldMouth {
    /// Returns the lip-sync track of a clip, if it has one with `wanted` delimiters.
    fn from_document(clip: &Document<'_>, wanted: usize, default_rate: Rate) -> Option<OldMouth> {
        let visemes = clip.string("visemes")?;
        let codes: String = codes_of(visemes).collect();
        let bounds = bounds(visemes);
        let starts = bounds.get(1..bounds.len() - 1)?.iter().map(|&frame| usize::try_from(frame).unwrap_or(usize::MAX));
        let starts: Vec<usize> = starts.collect();
        let rate = crate::export::rate(clip).unwrap_or(default_rate);
        (starts.len() == wanted && !codes.is_empty()).then_some(OldMouth { codes, rate, starts })
    }

    /// Returns the starts of the segments in a new track, which speaks like `speech` and ends at `end`.
    fn places(&self, speech: &Speech, end: Time, min_pause: Time) -> Vec<PartStart> {
        let time = |frame: usize| Time::of_frame(frame as u64, self.rate);
        let old_end = time(self.codes.len());
        let old_speech = self::speech(&self.codes, self.rate);
        let a_frame_more = |end: Time| Time::of_frame(end.nearest_frame(self.rate) + 1, self.rate);
        let is_as_long = old_end <= a_frame_more(end) && end <= a_frame_more(old_end);
        if is_as_long || old_speech.is_silent() || speech.is_silent() {
            // The times are the only information.
            let is_guess = |start: Time| !is_as_long && (start > end || !old_speech.is_silent());
            let places = self.starts.iter().map(|&start| time(start));
            return places.map(|start| PartStart { time: start.min(end), is_guess: is_guess(start) }).collect();
        }
        let shares: Vec<f64> = self.starts.iter().map(|&start| old_speech.share(time(start))).collect();
        let places = speech.at_shares(&shares, min_pause);
        if places.iter().all(|place| !place.is_guess) || !self.starts.iter().all(|&start| self.is_in_pause(start)) {
            return places;
        }
        // All segments began after a pause, and the new track has the same number of pauses.
        let pauses: Vec<Time> = speech.long_pauses(min_pause).map(|pause| pause.end).collect();
        match pauses.len() == places.len() {
            true => pauses.into_iter().map(|time| PartStart { time, is_guess: false }).collect(),
            false => places,
        }
    }

    /// Whether the mouth rests next to the first frame of a segment, and speaks before and after it.
    fn is_in_pause(&self, start: usize) -> bool {
        let (before, after) = self.codes.split_at(start.min(self.codes.len()));
        let speaks = |codes: &str| codes.bytes().any(|code| code != REST);
        (before.as_bytes().last() == Some(&REST) || after.as_bytes().first() == Some(&REST))
            && speaks(before)
            && speaks(after)
    }
}

fn is_same(one: Rate, other: Rate) -> bool {
    (one.numerator, one.denominator) == (other.numerator, other.denominator)
}

/// Returns the speech of a lip-sync track. Any rest interrupts it, however short.
pub(super) fn speech(codes: &str, rate: Rate) -> Speech {
    let mut frame = 0;
    let run = |codes: &[u8]| {
        let start = frame;
        frame += codes.len() as u64;
        let code = codes.first().copied().unwrap_or_default();
        ShapeRun { code, start: Time::of_frame(start, rate), end: Time::of_frame(frame, rate) }
    };
    let runs: Vec<ShapeRun> = codes.as_bytes().chunk_by(|a, b| a == b).map(run).collect();
    Speech::from_runs(&runs, Time::ZERO)
}

/// Returns the starts of all segments except the first, as far as the first word of the segment was found in `heard`.
fn word_starts(text: &str, heard: &[TimedText]) -> Vec<Option<Time>> {
    let heard: Vec<(String, Time)> =
        heard.iter().flat_map(|timed| words(&timed.text).into_iter().map(|word| (word, timed.start))).collect();
    let of_segments: Vec<Vec<String>> =
        segments(text).map(|range| words(&display(text.get(range).unwrap_or_default()).text)).collect();
    let is_as_many = of_segments.iter().map(Vec::len).sum::<usize>() == heard.len();
    let mut next = 0;
    let mut starts = Vec::with_capacity(of_segments.len());
    for words in &of_segments {
        let mut start = None;
        for (index, word) in words.iter().enumerate() {
            let ahead = || heard.iter().skip(next);
            // With the same number of words, they correspond one to one, however they are spelled.
            let found =
                if is_as_many { Some(0) } else { ahead().take(WORDS_AHEAD).position(|(heard, _)| heard == word) };
            let Some(found) = found else { continue };
            if index == 0 {
                start = heard.get(next + found).map(|(_, time)| *time);
            }
            next += found + 1;
        }
        starts.push(start);
    }
    starts.drain(..1);
    starts
}

/// Returns the words of a text in lower case, without punctuation.
fn words(text: &str) -> Vec<String> {
    let word = |word: &str| word.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    text.split_whitespace().map(word).filter(|word: &String| !word.is_empty()).collect()
}
