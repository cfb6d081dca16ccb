//! The position of a word in its segment if only the letters are known.

use std::ops::Range;

/// Returns the frame after this many letters of a segment with these frames.
pub(super) fn share_of_segment(frames: Range<u32>, letters_before: usize, letters: usize) -> u32 {
    let count = u64::from(frames.end.saturating_sub(frames.start));
    let (before, whole) = (letters_before as u64, letters.max(1) as u64);
    frames.start + ((2 * count * before + whole) / (2 * whole)) as u32
}
