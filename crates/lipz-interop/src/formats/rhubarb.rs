//! The common parts of Rhubarb's formats: times in hundredths of a second, and shapes without gaps.

use crate::{Time, Track};

pub(super) const MAPS: &[&str] = &["rhubarb", "rhubarb-toonboom"];
/// The shape of silence.
pub(super) const REST: &str = "X";
/// The steps per second of Rhubarb's time grid.
const STEPS: u32 = 100;

/// Returns a time in seconds with two decimals.
pub(super) fn seconds(time: Time) -> String {
    let steps = time.in_units(STEPS);
    format!("{}.{:02}", steps / u64::from(STEPS), steps % u64::from(STEPS))
}

/// Returns the end of the recording.
pub(super) fn end(track: &Track) -> Time {
    track.end.unwrap_or(Time::ZERO)
}

/// Returns the starts and shapes, at least one, because Rhubarb never writes an empty list.
pub(super) fn rows(track: &Track) -> Vec<(String, &str)> {
    let mut rows: Vec<_> = track.shapes.iter().map(|shape| (seconds(shape.start), shape.symbol.as_str())).collect();
    if rows.is_empty() {
        rows.push((seconds(Time::ZERO), REST));
    }
    rows
}

/// Returns the starts, ends and shapes.
pub(super) fn spans(track: &Track) -> Vec<(String, String, &str)> {
    let rows = rows(track);
    let ends = rows.iter().skip(1).map(|(start, _)| start.clone()).chain([seconds(end(track))]);
    ends.zip(&rows).map(|(end, (start, symbol))| (start.clone(), end, *symbol)).collect()
}

/// A shape with start and end, as in JSON and XML.
pub(super) struct Cue {
    pub(super) start: Time,
    pub(super) end: Time,
    pub(super) symbol: String,
    pub(super) span: lipz_diagnostics::Span,
}

/// Returns a track from shapes with ends. The mouth rests between them.
pub(super) fn track(cues: Vec<Cue>, duration: Option<Time>) -> Track {
    let mut track = Track::default();
    let mut ended: Option<Time> = None;
    for cue in cues {
        if let Some(gap) = ended.filter(|ended| is_gap(*ended, cue.start)) {
            track.shapes.push(crate::Shape::at(cue.span, gap, REST));
        }
        track.shapes.push(crate::Shape::at(cue.span, cue.start, cue.symbol));
        ended = Some(cue.end.max(cue.start));
    }
    if let Some(gap) = ended.filter(|ended| duration.is_some_and(|duration| is_gap(*ended, duration)))
        && let Some(last) = track.shapes.last().and_then(|shape| shape.span)
    {
        track.shapes.push(crate::Shape::at(last, gap, REST));
    }
    track.end = duration.max(ended);
    track
}

/// Whether there is time between two times. A rounding error does not count: programs may write 28.849999999999998 for
/// 28.85.
fn is_gap(end: Time, start: Time) -> bool {
    const MICROSECONDS: u32 = 1_000_000;
    end < start && start.in_units(MICROSECONDS) - end.in_units(MICROSECONDS) > 1
}
