//! The bands: time ruler, mouth shapes and segments of as many frames as fit into a line.

use super::ruler::ruler;
use lipz_bank::Clip;
use std::fmt::Write;
use std::ops::Range;

/// Blanks before the bands.
const MARGIN: usize = 2;

/// All frames of the clip.
pub(super) fn bands(out: &mut String, clip: &Clip<'_, '_>, width: usize) {
    let columns = width.saturating_sub(MARGIN).max(1);
    let frame_count = clip.frame_count() as usize;
    for first in (0..frame_count).step_by(columns) {
        let frames = first..(first + columns).min(frame_count);
        let mouths = clip.frames().get(frames.clone()).unwrap_or_default();
        let mouths = mouths.iter().map(|&code| code as char).collect();
        for row in [ruler(clip.fps(), &frames, columns), mouths, segments(clip, &frames)] {
            let _ = writeln!(out, "{:MARGIN$}{}", "", row.trim_end());
        }
        out.push('\n');
    }
}

/// A bar per segment with its number: `|0-------|1----`.
fn segments(clip: &Clip<'_, '_>, frames: &Range<usize>) -> String {
    let mut row = vec!['-'; frames.len()];
    let first = u32::try_from(frames.start).ok().and_then(|frame| clip.segment_of_frame(frame));
    let from_first = (first.map_or(0, |segment| segment.index())..).map_while(|index| clip.segment(index));
    for segment in from_first.take_while(|segment| (segment.start_frame() as usize) < frames.end) {
        let (start, end) = (segment.start_frame() as usize, segment.end_frame() as usize);
        let label = format!("|{}", segment.index());
        for (column, character) in (start..end).zip(label.chars()) {
            if let Some(cell) = column.checked_sub(frames.start).and_then(|column| row.get_mut(column)) {
                *cell = character;
            }
        }
    }
    row.into_iter().collect()
}
