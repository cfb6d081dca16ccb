//! Detection of steady sounds: a hum or a hiss, but not speech, whose vowels are longer only if sung or shouted.

use crate::features::cepstra::{Frame, Vectors};

/// A frame with less change than this, as [`Frame::change`] measures it, resembles its neighbours. In speech, the
/// change is 20 to 90.
const MOST_CHANGE: f32 = 12.0;
/// So many steady frames cannot be a phone: a quarter of a second.
const LEAST_FRAMES: usize = 25;
/// A steady sound that is louder than this, where 1 is the loudness of the loud frames, is a sustained voice.
const MOST_LOUDNESS: f32 = 0.5;

/// Returns, by frame, whether it is in a steady stretch.
pub(super) fn steady(vectors: Vectors<'_>) -> Vec<bool> {
    let is_calm = |frame: Frame| frame.change() < MOST_CHANGE && frame.loudness < MOST_LOUDNESS;
    let mut steady: Vec<bool> = vectors.map(is_calm).collect();
    for run in steady.chunk_by_mut(|a, b| a == b).filter(|run| run.len() < LEAST_FRAMES) {
        run.fill(false);
    }
    steady
}
