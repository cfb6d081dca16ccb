//! One clip as a timeline for a terminal.

use lipz_bank::{Clip, Fps, Locale, Segment};
use std::fmt::Write;
use unicode_width::UnicodeWidthStr;

/// Blanks before the timeline.
const MARGIN: usize = 2;

/// The clip: bands of time ruler, mouth shapes and segments, as wide as the terminal, then the
/// segments with events and texts.
pub(crate) fn timeline(clip: &Clip<'_, '_>, locales: &[Locale<'_>], width: usize) -> String {
    let mut out = heading(clip);
    let columns = width.saturating_sub(MARGIN).max(20);
    let frame_count = clip.frame_count() as usize;
    for first in (0..frame_count).step_by(columns) {
        let frames = first..(first + columns).min(frame_count);
        let rows = [ruler(clip.fps(), &frames), mouths(clip, &frames), segments(clip, &frames)];
        for row in rows {
            let _ = writeln!(out, "{:MARGIN$}{}", "", row.trim_end());
        }
        out.push('\n');
    }
    let tag_width = locales.iter().map(|locale| locale.tag().width()).max().unwrap_or(0).max("event".len());
    for segment in clip.segments() {
        details(&mut out, &segment, locales, tag_width);
    }
    out
}

fn heading(clip: &Clip<'_, '_>) -> String {
    let fps = clip.fps().map_or("unspecified frame rate".into(), |fps| format!("{} fps", rounded(fps)));
    let viseme_type = clip.viseme_type().map_or("unspecified viseme type", lipz_bank::VisemeType::name);
    let frames = match clip.duration_us() {
        _ if !clip.has_visemes() => "no mouth shapes".into(),
        Some(us) => format!("{} frames, {:.3} s", clip.frame_count(), us as f64 / 1e6),
        None => format!("{} frames", clip.frame_count()),
    };
    format!("{}\n  {fps}, {viseme_type}, {frames}, id {}\n\n", clip.key(), clip.id())
}

/// The rate with at most three decimals.
fn rounded(fps: Fps) -> String {
    let text = format!("{:.3}", fps.to_f64());
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Seconds above the frames at which they begin; frame numbers where there is no frame rate.
fn ruler(fps: Option<Fps>, frames: &std::ops::Range<usize>) -> String {
    let mut row = String::new();
    let mut tick = |column: usize, label: &str| {
        if row.len() <= column {
            let _ = write!(row, "{:1$}{label} ", "", column - row.len());
        }
    };
    match fps {
        None => (frames.start..frames.end).filter(|frame| frame % 10 == 0).for_each(|frame| {
            tick(frame - frames.start, &format!("'{frame}"));
        }),
        Some(fps) => {
            // Tenths of a second at most, fewer where frames are too many to label each.
            let tenths_apart = if fps.to_f64() >= 100.0 {
                1
            } else if fps.to_f64() >= 15.0 {
                5
            } else {
                10
            };
            let frame_of = |tenths: u64| {
                let frame = (tenths * u64::from(fps.numerator())).div_ceil(10 * u64::from(fps.denominator()));
                usize::try_from(frame).unwrap_or(usize::MAX)
            };
            let mut tenths = 0_u64;
            while frame_of(tenths) < frames.end {
                if let Some(column) = frame_of(tenths).checked_sub(frames.start) {
                    tick(column, &format!("'{}.{}s", tenths / 10, tenths % 10));
                }
                tenths += tenths_apart;
            }
        }
    }
    row
}

fn mouths(clip: &Clip<'_, '_>, frames: &std::ops::Range<usize>) -> String {
    clip.frames().get(frames.clone()).unwrap_or_default().iter().map(|&code| code as char).collect()
}

/// A bar per segment with its number: `|0-------|1----`.
fn segments(clip: &Clip<'_, '_>, frames: &std::ops::Range<usize>) -> String {
    let mut row = vec!['-'; frames.len()];
    for segment in clip.segments() {
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

fn details(out: &mut String, segment: &Segment<'_, '_>, locales: &[Locale<'_>], tag_width: usize) {
    let _ = write!(out, "segment {}", segment.index());
    let frames = (segment.start_frame(), segment.end_frame());
    match (segment.start_us(), segment.end_us()) {
        _ if !segment.clip().has_visemes() => out.push('\n'),
        (Some(start), Some(end)) if frames.0 < frames.1 => {
            let (start, end) = (start as f64 / 1e6, end as f64 / 1e6);
            let _ = writeln!(out, "  {start:.3} s to {end:.3} s  frames {} to {}", frames.0, frames.1 - 1);
        }
        _ if frames.0 < frames.1 => {
            let _ = writeln!(out, "  frames {} to {}", frames.0, frames.1 - 1);
        }
        _ => out.push_str("  no frames\n"),
    }
    if let Some(event) = segment.event().filter(|event| !event.is_empty()) {
        let _ = writeln!(out, "  {:<tag_width$}  {}", "event", visible(event));
    }
    for locale in locales {
        if let Some(text) = segment.text(*locale) {
            let fallback = if text.is_fallback() { "  (fallback)" } else { "" };
            let _ = writeln!(out, "  {:<tag_width$}  {}{fallback}", locale.tag(), visible(text.as_str()));
        }
    }
}

/// The text with control characters made visible: a bank must not steer the terminal.
fn visible(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).collect()
}
