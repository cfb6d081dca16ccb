//! Where a sound does not change: a hum, a hiss, but not speech, whose vowels are longer only when they are sung or shouted.

use crate::features::cepstra::{Frame, Vectors};

/// The change, as [`Frame::change`] measures it, below which a frame is like those around it. In speech it is 20 to 90.
const MOST_CHANGE: f32 = 12.0;
/// So many frames of a sound that does not change are no phone: a quarter of a second.
const LEAST_FRAMES: usize = 25;
/// What is louder is a voice that is held, if this is the loudness of the loud frames.
const MOST_LOUDNESS: f32 = 0.5;

/// By frame: whether it is in a stretch that does not change.
pub(super) fn steady(vectors: Vectors<'_>) -> Vec<bool> {
    let is_calm = |frame: Frame| frame.change() < MOST_CHANGE && frame.loudness < MOST_LOUDNESS;
    let mut steady: Vec<bool> = vectors.map(is_calm).collect();
    for run in steady.chunk_by_mut(|a, b| a == b).filter(|run| run.len() < LEAST_FRAMES) {
        run.fill(false);
    }
    steady
}
