//! Limits of texts: how much a screen holds, and how fast a player reads.

use super::texts::{SHOWN, more};
use crate::TextLimits;
use crate::clip::ClipData;
use lipz_bank::Fps;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::{JsonString, text};
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// The time that the segments of a clip are shown.
pub(super) struct Times<'c> {
    /// Start frames of all segments.
    starts: &'c [u32],
    frame_count: u32,
    fps: Fps,
}

impl<'c> Times<'c> {
    /// The times of a clip; `None` if it has no mouth shapes or no frame rate.
    pub(super) fn new(clip: &'c ClipData) -> Option<Times<'c>> {
        let fps = clip.fps.filter(|_| clip.has_visemes)?;
        Some(Times { starts: &clip.starts, frame_count: clip.frames.len() as u32, fps })
    }

    /// Seconds that a segment lasts.
    fn seconds(&self, segment: usize) -> Option<f64> {
        let start = self.starts.get(segment)?;
        let end = self.starts.get(segment + 1).copied().unwrap_or(self.frame_count);
        Some(f64::from(end.saturating_sub(*start)) / self.fps.to_f64())
    }
}

/// Checks the display texts of one element, segment by segment.
pub(super) fn check<'t>(
    string: &JsonString<'_>,
    displays: impl Iterator<Item = &'t str>,
    times: Option<&Times<'_>>,
    limits: &TextLimits,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut found: [Vec<Diagnostic>; 3] = Default::default();
    let [wide, tall, fast] = &mut found;
    for (segment, (range, display)) in text::segments(&string.text).zip(displays).enumerate() {
        let shown = text::trim(&string.text[range.clone()]);
        let start = range.start + (shown.as_ptr() as usize - string.text[range].as_ptr() as usize);
        let span = string.span_of(start..start + shown.len());
        wide.extend(
            too_wide(display, limits).map(|message| {
                Diagnostic::at(Code::TextTooWide, span, message).help("shorten it, or break it with \\n")
            }),
        );
        tall.extend(too_many_lines(display, limits).map(|message| {
            Diagnostic::at(Code::TooManyLines, span, message).help("shorten it, or divide the segment with `|`")
        }));
        let seconds = times.and_then(|times| times.seconds(segment));
        fast.extend(seconds.and_then(|seconds| too_fast(display, seconds, limits)).map(|message| {
            Diagnostic::at(Code::ReadsTooFast, span, message)
                .help("shorten the text, or move the `|` so that the segment lasts longer")
        }));
    }
    for diagnostics_of_kind in found {
        let count = diagnostics_of_kind.len();
        let shown = diagnostics_of_kind.into_iter().take(SHOWN).enumerate();
        diagnostics.extend(shown.map(|(index, diagnostic)| more(diagnostic, index, count)));
    }
}

fn too_wide(display: &str, limits: &TextLimits) -> Option<String> {
    let limit = limits.line_columns?;
    let columns = display.lines().map(UnicodeWidthStr::width).max()?;
    (columns > limit as usize).then(|| format!("a line of this text has {columns} columns, the limit is {limit}"))
}

fn too_many_lines(display: &str, limits: &TextLimits) -> Option<String> {
    let limit = limits.lines?;
    let lines = display.lines().count();
    (lines > limit as usize).then(|| format!("this text has {lines} lines, the limit is {limit}"))
}

/// Characters are those that take room: combining marks belong to what they stand on.
fn too_fast(display: &str, seconds: f64, limits: &TextLimits) -> Option<String> {
    let limit = limits.characters_per_second?;
    let characters = display.chars().filter(|character| character.width().is_some_and(|width| width > 0)).count();
    if characters == 0 {
        return None;
    }
    if seconds == 0.0 {
        return Some("this text is in a segment without frames: nobody has time to read it".to_owned());
    }
    let speed = characters as f64 / seconds;
    (speed > limit)
        .then(|| format!("{characters} characters in {seconds:.2} s are {speed:.1} a second, the limit is {limit}"))
}
