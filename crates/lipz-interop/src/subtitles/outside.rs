//! Cues outside their clip: times that count from the start of a programme, and cues that never show.

use super::{Cue, timing};
use crate::Time;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::Rate;
use std::borrow::Cow;

const HOUR_MS: u64 = 3_600_000;

/// Returns the cues of a clip with times from its start. The times of broadcasters start at a full hour, usually
/// 01:00:00 or 10:00:00. If no cue shows within `frames`, which are unknown for a new clip, they count from that hour.
///
/// Returns `None`, and reports the first one, if cues start after the last frame.
pub(super) fn in_clip<'c>(
    cues: &'c [Cue],
    frames: Option<u64>,
    rate: Rate,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Cow<'c, [Cue]>> {
    let is_outside =
        |cue: &&Cue| frames.is_some_and(|frames| Time::new(cue.start_ms, 1000).nearest_frame(rate) >= frames);
    let mut cues = Cow::Borrowed(cues);
    let start = cues.iter().map(|cue| cue.start_ms).min().unwrap_or(0) / HOUR_MS * HOUR_MS;
    if start > 0 && frames.is_none_or(|_| cues.iter().all(|cue| is_outside(&cue))) {
        if let Some(first) = cues.first() {
            let message =
                format!("the times count from {}, not from the start of the clip", timing::timestamp(start, '.'));
            diagnostics.push(
                Diagnostic::at(Code::SubtitleTimes, first.span, message)
                    .note("this time is subtracted from all times; programmes often start at a full hour")
                    .help("subtract this time from all times in the file"),
            );
        }
        for cue in cues.to_mut() {
            cue.start_ms -= start;
            cue.end_ms -= start;
        }
    }
    let mut outside = cues.iter().filter(is_outside);
    let Some(first) = outside.next() else { return Some(cues) };
    let end = Time::of_frame(frames.unwrap_or(0), rate);
    let message = format!("the subtitle starts at {}, but the clip ends at {end}", Time::new(first.start_ms, 1000));
    let mut diagnostic = Diagnostic::at(Code::SubtitleOutside, first.span, message);
    let more = outside.count();
    if more > 0 {
        diagnostic = diagnostic.note(format!("and {more} more"));
    }
    diagnostics.push(diagnostic.help("correct the times, or check whether the subtitles belong to this clip"));
    None
}
