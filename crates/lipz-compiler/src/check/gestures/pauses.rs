//! What a face does while its mouth rests for long: somebody listens.

use super::Gesture;
use super::clock::REST;
use super::shapes::Kind;
use crate::clip::ClipData;
use lipz_bank::{Fps, Micros};

/// Milliseconds from the start of a pause to the first gesture, and from its last one to the end at least.
const MARGIN_MS: i64 = 900;
/// Milliseconds from one gesture to the next.
const EVERY_MS: i64 = 3000;
/// What is done, in turn, with its strength.
const TURNS: [(Kind, i32); 3] = [(Kind::Brows, 400), (Kind::Nod, 1500), (Kind::Shrug, 300)];

/// Adds brows, small nods and shrugs in the pauses of a clip.
pub(super) fn of_listening(clip: &ClipData, fps: Fps, to: &mut Vec<Gesture<'_>>) {
    let frames = |ms: i64| fps.frame_at(Micros(ms * 1000)).unwrap_or(u32::MAX).max(1);
    let (margin, every) = (frames(MARGIN_MS), frames(EVERY_MS));
    let mut turns = TURNS.iter().cycle();
    let mut start = 0;
    for pause in clip.frames.split(|code| *code != REST) {
        let end = start + pause.len() as u32;
        let last = end.saturating_sub(margin);
        for frame in (start.saturating_add(margin)..=last).step_by(every as usize) {
            if let Some((kind, strength)) = turns.next() {
                to.push(Gesture::new(*kind, frame, *strength));
            }
        }
        start = end + 1;
    }
}
