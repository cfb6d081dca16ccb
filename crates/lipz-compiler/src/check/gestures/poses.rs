//! The times when a head turns to another pose: at each word, and at each pause.

use super::clock::Clock;
use super::words::Words;
use crate::check::word_clock::REST;
use crate::clip::{ClipData, Key};
use lipz_bank::curve::CurveValue;
use lipz_bank::{Fps, Micros};
use std::collections::BTreeMap;

/// The minimum length of a pause in milliseconds. A shorter rest is between two phones.
const PAUSE_MS: i64 = 200;
/// The usual length of a word in milliseconds, at 150 words per minute.
const WORD_MS: i64 = 400;
/// The strength of each pose.
const WHOLE: CurveValue = CurveValue::from_thousandths(1000);

/// Returns the keys of the curve `pose`, or an empty list without words.
pub(super) fn of_words(words: &Words<'_>, clip: &ClipData, clock: &Clock<'_>, fps: Fps) -> Vec<Key> {
    if words.words.is_empty() {
        return Vec::new();
    }
    let frames = |ms: i64| fps.frame_at(Micros(ms * 1000)).unwrap_or(u32::MAX).max(1);
    let end = clip.frames.len() as u32;
    let pauses = pauses(&clip.frames, frames(PAUSE_MS));
    // Whether the character speaks from a frame on.
    let mut turns: BTreeMap<u32, bool> = pauses.keys().map(|start| (*start, false)).collect();
    for word in &words.words {
        let start = clock.start(word, 0);
        // If visemes were edited by hand, the time of a word may be in a pause, but the word cannot.
        let pause = pauses.range(..=start).next_back().filter(|(_, end)| start < **end);
        turns.insert(pause.map_or(start, |(_, end)| *end), true);
    }
    turns.retain(|start, speaks| *start < end && (*speaks || pauses.get(start) != Some(&end)));
    let ends: Vec<u32> = turns.keys().copied().skip(1).chain([end]).collect();
    let of_turn = |((start, speaks), end): ((u32, bool), u32)| {
        // In scripts without spaces, one word can stand for several. If it lasts longer than two usual words, it counts
        // as that many.
        let usual = (end - start) / frames(WORD_MS);
        let parts = if speaks && usual > 2 { usual } else { 1 };
        (0..parts).map(move |part| start + (u64::from(end - start) * u64::from(part) / u64::from(parts)) as u32)
    };
    turns.into_iter().zip(ends).flat_map(of_turn).map(|frame| (frame, WHOLE)).collect()
}

/// Returns the rests of at least `least` frames, except the one before the first phone: from the first frame to the
/// end, which is excluded.
fn pauses(frames: &[u8], least: u32) -> BTreeMap<u32, u32> {
    let mut start = 0;
    let mut found = BTreeMap::new();
    for rest in frames.split(|code| *code != REST) {
        let end = start + rest.len() as u32;
        if start > 0 && end - start >= least {
            found.insert(start, end);
        }
        start = end + 1;
    }
    found
}
