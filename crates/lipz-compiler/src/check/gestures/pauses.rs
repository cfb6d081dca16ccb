//! The gestures of a listening face while its mouth rests for long.

use super::gesture::Gesture;
use super::shapes::GestureKind;
use crate::check::word_clock::REST;
use crate::clip::ClipData;
use lipz_bank::{Fps, Micros};

/// The minimum time in milliseconds from the start of a pause to the first gesture, and from the last gesture to the
/// end.
const MARGIN_MS: i64 = 900;
/// The interval between gestures in milliseconds.
const EVERY_MS: i64 = 3000;
/// The sequence of gestures with their strengths.
const TURNS: [(GestureKind, i32); 3] = [(GestureKind::Brows, 400), (GestureKind::Nod, 1500), (GestureKind::Shrug, 300)];

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
