//! The rows of events, shown at the frames where they happen.

use super::palette::{Palette, StyledRow};
use super::texts::fitting;
use lipz_bank::{Clip, Segment};
use lipz_diagnostics::escape;
use std::iter::Peekable;
use std::ops::Range;
use unicode_width::UnicodeWidthStr;

/// Points to the frame of an event whose label follows.
const FROM_HERE: char = '▸';
/// Points to the frame of an event whose label comes before it, because there is no room after it.
const UP_TO_HERE: char = '◂';
/// The most rows for events that are close to each other. A bank may have thousands at one frame.
const MOST_ROWS: usize = 4;

/// The events of a clip, in the order of their segments.
pub(super) struct Events<S: Iterator> {
    /// The remaining segments.
    left: Peekable<S>,
    frame_count: usize,
    columns: usize,
    palette: Palette,
}

/// Creates the events of this clip, for bands of this number of columns.
pub(super) fn events<'a>(
    clip: &Clip<'a>,
    columns: usize,
    palette: Palette,
) -> Events<impl Iterator<Item = Segment<'a>> + use<'a>> {
    Events { left: clip.segments().peekable(), frame_count: clip.frame_count() as usize, columns, palette }
}

impl<'a, S: Iterator<Item = Segment<'a>>> Events<S> {
    /// Returns the events in these frames; in the last band, including those at the end.
    pub(super) fn rows(&mut self, frames: &Range<usize>) -> Vec<StyledRow> {
        let end = if frames.end == self.frame_count { usize::MAX } else { frames.end };
        let mut rows: Vec<StyledRow> = Vec::new();
        let mut hidden = 0_usize;
        while let Some(segment) = self.left.next_if(|segment| (segment.start_frame() as usize) < end) {
            let Some(label) = label(&segment) else { continue };
            let column = (segment.start_frame() as usize).saturating_sub(frames.start).min(self.columns - 1);
            let (start, label) = placed(&label, column, self.columns);
            let free = rows.iter().position(|row| row.columns() < start);
            let row = free.unwrap_or(rows.len());
            if row == rows.len() && row < MOST_ROWS {
                rows.push(StyledRow::default());
            }
            match rows.get_mut(row) {
                Some(row) => row.put(start, &label, self.palette.event),
                None => hidden += 1,
            }
        }
        if hidden > 0 {
            let mut row = StyledRow::default();
            row.put(0, &format!("and {hidden} more below"), self.palette.event);
            rows.push(row);
        }
        rows
    }
}

/// Returns the event of a segment on one line; `None` if it has none.
fn label(segment: &Segment<'_>) -> Option<String> {
    let written = segment.event().filter(|text| !text.is_empty())?;
    let typed: Vec<String> = segment.events().map(|event| event.to_string()).collect();
    let label = if typed.is_empty() { written.to_owned() } else { typed.join(", ") };
    Some(escape::text(&label).into_owned())
}

/// Returns the label with the mark of its frame, and its start: after the mark or, without enough room, before it. Text
/// that still does not fit is left out.
fn placed(label: &str, column: usize, columns: usize) -> (usize, String) {
    let behind = columns - column - 1;
    let room = behind.max(column);
    let label = match label.width() <= room {
        true => label.to_owned(),
        false => format!("{}…", label.get(..fitting(label, room.saturating_sub(1))).unwrap_or_default()),
    };
    match label.width() <= behind {
        true => (column, format!("{FROM_HERE}{label}")),
        false => (column - label.width().min(column), format!("{label}{UP_TO_HERE}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_placed_where_there_is_room() {
        assert_eq!(placed("waves", 0, 20), (0, "▸waves".into()));
        assert_eq!(placed("waves", 14, 20), (14, "▸waves".into()));
        assert_eq!(placed("waves", 15, 20), (10, "waves◂".into()));
        assert_eq!(placed("waves", 4, 7), (0, "wav…◂".into()));
        assert_eq!(placed("waves", 0, 1), (0, "…◂".into()), "one column is too narrow for any");
    }
}
