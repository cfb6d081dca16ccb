//! The bands: time ruler, openness of the mouth, visemes, segments, texts and events of as many frames as fit into a
//! line.

use super::events::events;
use super::palette::{Palette, StyledRow};
use super::ruler::ruler;
use super::texts::TextLines;
use lipz_bank::{Clip, Locale, Segment, Viseme};
use std::ops::Range;

/// The number of blanks before the bands.
const MARGIN: usize = 2;

/// From a closed mouth during speech to one that is wide open.
const HEIGHTS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// The increase in [`openness`](Viseme::openness) for one step, in ten-thousandths.
const STEP_TEN_THOUSANDTHS: u16 = 10_000 / HEIGHTS.len() as u16;

/// Adds all frames of the clip, with its texts in this locale.
pub(super) fn bands(out: &mut String, clip: &Clip<'_>, locale: Option<Locale>, width: usize, palette: Palette) {
    let columns = width.saturating_sub(MARGIN).max(1);
    let frame_count = clip.frame_count() as usize;
    let mut texts = TextLines::new(locale, palette);
    let mut events = events(clip, columns, palette);
    for first in (0..frame_count).step_by(columns) {
        let frames = first..(first + columns).min(frame_count);
        let mut rows = vec![StyledRow::default(), heights(clip, &frames, palette), StyledRow::default()];
        rows[0].put(0, &ruler(clip.fps(), &frames, columns), palette.ruler);
        let mouths = clip.frames().get(frames.clone()).unwrap_or_default();
        rows[2].put(0, &mouths.iter().map(|&code| code as char).collect::<String>(), anstyle::Style::new());
        let mut bars = StyledRow::default();
        let mut shown = StyledRow::default();
        for segment in segments(clip, &frames) {
            let part = overlap(&segment, &frames);
            let bar: String = part.clone().map(|frame| bar_at(&segment, frame)).collect();
            bars.put(part.start - frames.start, &bar, palette.segment(segment.index()));
            texts.put(&mut shown, &segment, &part, frames.start);
        }
        rows.extend([bars, shown]);
        rows.extend(events.rows(&frames));
        rows.iter().for_each(|row| out.push_str(&row.line(MARGIN)));
        out.push('\n');
    }
}

/// Returns the openness of the mouth in each frame: blank at rest. Empty if the clip has no visemes.
fn heights(clip: &Clip<'_>, frames: &Range<usize>, palette: Palette) -> StyledRow {
    let mut row = StyledRow::default();
    let Some(viseme_type) = clip.viseme_type() else { return row };
    let codes = clip.frames().get(frames.clone()).unwrap_or_default();
    let height = |&code: &u8| match Viseme::from_code(code) {
        Viseme::REST => ' ',
        viseme => {
            let steps = viseme.openness(viseme_type).ten_thousandths() / STEP_TEN_THOUSANDTHS;
            HEIGHTS[usize::from(steps).min(HEIGHTS.len() - 1)]
        }
    };
    let heights: String = codes.iter().map(height).collect();
    row.put(0, heights.trim_end(), palette.height);
    row
}

/// Returns the segments that contain some of these frames.
fn segments<'b>(clip: &Clip<'b>, frames: &Range<usize>) -> impl Iterator<Item = Segment<'b>> {
    let first = u32::try_from(frames.start).ok().and_then(|frame| clip.segment_of_frame(frame));
    let (clip, end) = (*clip, frames.end);
    let from_first = (first.map_or(0, |segment| segment.index())..).map_while(move |index| clip.segment(index));
    from_first
        .take_while(move |segment| (segment.start_frame() as usize) < end)
        .filter(|segment| segment.start_frame() < segment.end_frame())
}

/// Returns the frames that are in the segment.
fn overlap(segment: &Segment<'_>, frames: &Range<usize>) -> Range<usize> {
    let (start, end) = (segment.start_frame() as usize, segment.end_frame() as usize);
    start.max(frames.start)..end.min(frames.end)
}

/// Returns the character of a segment's bar at a frame: `|1--`.
fn bar_at(segment: &Segment<'_>, frame: usize) -> char {
    let at = frame - segment.start_frame() as usize;
    // A `|`, and at most five digits.
    if at > 5 { '-' } else { format!("|{}", segment.index()).chars().nth(at).unwrap_or('-') }
}
