//! Limits of texts: the size of a screen, and the reading speed of players.

use super::texts::{SHOWN, more};
use super::trigger::{Check, CheckedText, Run, Trigger};
use crate::clip::ClipData;
use crate::project::{Options, TextLimits};
use lipz_bank::Fps;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::{JsonString, text};
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// The checks of texts against the limits for screens and reading speed.
pub(super) const CHECKS: &[Check] = &[Check { trigger: Trigger::Options(has_limits), run: Run::Text(of_text) }];

fn has_limits(options: &Options) -> bool {
    options.text_limits != TextLimits::default() || !options.locale_limits.is_empty()
}

fn of_text(text: &CheckedText<'_>, diagnostics: &mut Vec<Diagnostic>) {
    if has_limits(text.options) && text.is_divided {
        let times = Times::new(text.clip);
        let limits = text.options.get_text_limits_of(text.locale);
        check(text.string, text.displays.iter(), times.as_ref(), &limits, diagnostics);
    }
}

/// The times for which the segments of a clip are shown.
struct Times<'c> {
    /// Start frames of all segments.
    starts: &'c [u32],
    frame_count: u32,
    fps: Fps,
}

impl<'c> Times<'c> {
    /// Returns the times of a clip, or `None` if it does not have visemes or a frame rate.
    fn new(clip: &'c ClipData) -> Option<Times<'c>> {
        let fps = clip.fps.filter(|_| clip.has_visemes)?;
        Some(Times { starts: &clip.starts, frame_count: clip.frames.len() as u32, fps })
    }

    /// Returns the length of a segment in seconds.
    fn seconds(&self, segment: usize) -> Option<f64> {
        let start = self.starts.get(segment)?;
        let end = self.starts.get(segment + 1).copied().unwrap_or(self.frame_count);
        Some(f64::from(end.saturating_sub(*start)) / self.fps.to_f64())
    }
}

/// The help for a text with too many characters for its segment.
const TOO_FAST: &str = "shorten the text, or move the `|` so that the segment lasts longer";

/// The help for a segment that is too short for any text.
const TOO_BRIEF: &str = "move the `|` so that the segment lasts longer, or join it with the segment next to it";

/// Checks the display texts of one element, segment by segment.
fn check<'t>(
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
            Diagnostic::at(Code::TooManyLines, span, message).help("shorten it, or split the segment with `|`")
        }));
        let seconds = times.and_then(|times| times.seconds(segment));
        let brief = |seconds| {
            let fast = too_fast(display, seconds, limits).map(|message| (message, TOO_FAST));
            fast.or_else(|| too_brief(display, seconds, limits).map(|message| (message, TOO_BRIEF)))
        };
        fast.extend(
            seconds.and_then(brief).map(|(message, help)| Diagnostic::at(Code::ReadsTooFast, span, message).help(help)),
        );
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
    (columns > limit as usize).then(|| format!("a line of this text has {columns} columns, but the limit is {limit}"))
}

fn too_many_lines(display: &str, limits: &TextLimits) -> Option<String> {
    let limit = limits.lines?;
    let lines = display.lines().count();
    (lines > limit as usize).then(|| format!("this text has {lines} lines, but the limit is {limit}"))
}

/// Only characters with a width count, because combining marks belong to their base characters.
fn too_fast(display: &str, seconds: f64, limits: &TextLimits) -> Option<String> {
    let limit = limits.characters_per_second?;
    let characters = display.chars().filter(|character| character.width().is_some_and(|width| width > 0)).count();
    if characters == 0 {
        return None;
    }
    if seconds == 0.0 {
        return Some("this text is in a segment without frames, so it is shown for no time".to_owned());
    }
    let speed = characters as f64 / seconds;
    (speed > limit).then(|| {
        format!("{characters} characters in {seconds:.2} s are {speed:.1} per second, but the limit is {limit}")
    })
}

fn too_brief(display: &str, seconds: f64, limits: &TextLimits) -> Option<String> {
    let limit = limits.shortest_seconds.filter(|limit| seconds < *limit && !display.is_empty())?;
    Some(format!("this text is shown for {seconds:.2} s, but the minimum is {limit} s"))
}
