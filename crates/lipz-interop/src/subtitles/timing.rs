//! The times of cues: their lines and their order.

use super::Cue;
use crate::source::{self, Line};
use lipz_diagnostics::{Code, Diagnostic, Span};
use lipz_file::text::is_white_space;
use std::ops::Range;

/// The separator between the times of a cue.
pub(super) const ARROW: &str = "-->";

/// Returns the blocks of a SubRip file, which are separated by blank lines. A blank line inside a cue does not end it:
/// blocks without times are added to the cue before them, which is reported once.
pub(super) fn srt_blocks<'t>(text: &'t str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Vec<Line<'t>>> {
    let tries_times =
        |block: &[Line<'_>]| block.iter().take(2).any(|line| line.text.contains('>') && line.text.contains(':'));
    let has_times = |block: &[Line<'_>]| block.iter().take(2).any(|line| line.text.contains(ARROW));
    let mut blocks: Vec<Vec<Line<'t>>> = Vec::new();
    let mut is_told = false;
    for block in blocks_between(text, |line| line.text.chars().all(is_white_space)) {
        // Text above the first times does not belong to a cue.
        match blocks.last_mut().filter(|last| has_times(last)) {
            Some(last) if !has_times(&block) && !tries_times(&block) => {
                if let (Some(line), false) = (block.first(), is_told) {
                    is_told = true;
                    let message = "an empty line splits the subtitle, which continues here";
                    diagnostics.push(
                        line.diagnostic(Code::SubtitleText, message)
                            .note("the rest is read as a part of the subtitle above it; players may not show it")
                            .help("remove the empty line"),
                    );
                }
                last.extend(block);
            }
            _ => blocks.push(block),
        }
    }
    blocks
}

/// Returns the blocks of a WebVTT file, which are separated by empty lines. A line of spaces does not end a cue
/// (automatic captions contain such lines), and is dropped.
pub(super) fn vtt_blocks(text: &str) -> Vec<Vec<Line<'_>>> {
    let mut blocks = blocks_between(text, |line| line.text.is_empty());
    for block in &mut blocks {
        block.retain(|line| !line.text.chars().all(is_white_space));
    }
    blocks.retain(|block| !block.is_empty());
    blocks
}

fn blocks_between<'t>(text: &'t str, is_end: impl Fn(&Line<'t>) -> bool) -> Vec<Vec<Line<'t>>> {
    // The classic Mac OS ends lines with CR alone.
    let lines: Vec<Line<'_>> = match text.contains('\n') {
        true => source::lines(text).collect(),
        false => source::lines_of(text, '\r').collect(),
    };
    lines.split(is_end).filter(|block| !block.is_empty()).map(<[_]>::to_vec).collect()
}

/// The lines of a cue after its times.
pub(super) struct Body<'t>(&'t [Line<'t>]);

impl Body<'_> {
    /// Returns the text of all lines.
    pub(super) fn text(&self) -> String {
        self.0.iter().map(|line| line.text).collect::<Vec<_>>().join("\n")
    }

    /// Returns the position in the file of a part of the text, up to the end of its first line.
    pub(super) fn span(&self, part: Range<usize>) -> Span {
        let mut start = 0;
        for line in self.0 {
            let end = start + line.text.len();
            if part.start < end {
                return Span::new(line.at + part.start - start, line.at + part.end.min(end) - start);
            }
            start = end + 1;
        }
        Span::default()
    }
}

/// Returns the cue of a block: an optional name or number, the times, then the text.
pub(super) fn cue<'t>(block: &'t [Line<'t>], diagnostics: &mut Vec<Diagnostic>) -> Option<(Cue, Body<'t>)> {
    let Some((at, line)) = block.iter().enumerate().take(2).find(|(_, line)| line.text.contains(ARROW)) else {
        let line = block.first()?;
        diagnostics.push(
            line.diagnostic(Code::SubtitleSyntax, "the line does not belong to a cue because it has no times above it")
                .help(
                    "write the times, such as 00:00:01,000 --> 00:00:02,500, then the lines; end the subtitle with \
                    an empty line",
                ),
        );
        return None;
    };
    let (start_ms, end_ms) = times(*line, diagnostics)?;
    let body = Body(block.get(at + 1..).unwrap_or_default());
    Some((Cue { start_ms, end_ms, text: String::new(), span: line.span() }, body))
}

/// Parses the times of a line, `00:00:01,000 --> 00:00:02,500`. The rest of the line concerns positions on the screen.
fn times(line: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<(u64, u64)> {
    let (before, after) = line.text.split_once(ARROW)?;
    let behind = Line { text: after, at: line.at + before.len() + ARROW.len() };
    let first = Line { text: before, at: line.at }.trimmed();
    let second = behind.fields().next().unwrap_or(behind);
    let mut read = |field: Line<'_>| {
        let time = milliseconds(field.text);
        if time.is_none() {
            let diagnostic = field.diagnostic(Code::SubtitleSyntax, "this is not the time of a cue");
            diagnostics.push(diagnostic.help("write hours, minutes, seconds and milliseconds: 00:00:02,500"));
        }
        time
    };
    let (start_ms, end_ms) = (read(first), read(second));
    let (start_ms, end_ms) = (start_ms?, end_ms?);
    if end_ms < start_ms {
        let message = "the subtitle ends before it starts";
        diagnostics.push(line.diagnostic(Code::SubtitleSyntax, message).help("swap the times, or correct them"));
        return None;
    }
    Some((start_ms, end_ms))
}

/// Parses `HH:MM:SS,mmm`. WebVTT uses a dot, and hours are optional there; files in the wild mix both forms.
fn milliseconds(text: &str) -> Option<u64> {
    // Some tools omit milliseconds that are 0.
    let (clock, fraction) = text.split_once([',', '.']).unwrap_or((text, "0"));
    let number = |digits: &str| digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok()).flatten();
    let ms = format!("{fraction:0<3}");
    if fraction.is_empty() || ms.len() > 3 {
        return None;
    }
    let parts: Vec<u64> = clock.split(':').map(number).collect::<Option<_>>()?;
    let (hours, minutes, seconds) = match *parts.as_slice() {
        [hours, minutes, seconds] => (hours, minutes, seconds),
        [minutes, seconds] => (0, minutes, seconds),
        _ => return None,
    };
    if minutes > 59 || seconds > 59 {
        return None;
    }
    hours.checked_mul(3_600_000)?.checked_add(minutes * 60_000 + seconds * 1000 + number(&ms)?)
}

/// Returns a time such as `00:00:02,500`, with the separator of the format.
pub(super) fn timestamp(ms: u64, separator: char) -> String {
    let (seconds, ms) = (ms / 1000, ms % 1000);
    format!("{:02}:{:02}:{:02}{separator}{ms:03}", seconds / 3600, seconds / 60 % 60, seconds % 60)
}

/// Sorts cues by time. Reports cues that are out of order or overlap.
pub(super) fn sort(cues: &mut [Cue], diagnostics: &mut Vec<Diagnostic>) {
    let backwards = cues.windows(2).find_map(|pair| match pair {
        [before, after] if after.start_ms < before.start_ms => Some(after.span),
        _ => None,
    });
    if let Some(span) = backwards {
        let message = "the subtitle starts before the one above it";
        let diagnostic = Diagnostic::at(Code::SubtitleTimes, span, message).note("subtitles are sorted by time");
        diagnostics.push(diagnostic.help("check the file here; it may have been edited or joined from two"));
    }
    cues.sort_by_key(|cue| cue.start_ms);
    let overlap = cues.windows(2).find_map(|pair| match pair {
        [before, after] if after.start_ms < before.end_ms => Some((before.span, after.span)),
        _ => None,
    });
    if let Some((before, after)) = overlap {
        let diagnostic = Diagnostic::at(Code::SubtitleTimes, after, "the subtitle overlaps another subtitle")
            .also(before, "the other subtitle")
            .note("a segment has one text, so each subtitle starts at the end of the one before it");
        diagnostics.push(diagnostic.help("merge the two, or let the first one end earlier"));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn times_of_both_formats() {
        for (text, ms) in [
            ("00:00:00,000", 0),
            ("01:02:03,456", 3_723_456),
            ("100:00:00.001", 360_000_001),
            ("02:03.4", 123_400),
            ("59:59.999", 3_599_999),
            ("00:00:02", 2000),
        ] {
            assert_eq!(milliseconds(text), Some(ms), "{text}");
            assert_eq!(milliseconds(&timestamp(ms, '.')), Some(ms));
        }
        for text in ["", "1", "00:00:60,000", "00:60:00,000", "00:00:01,", "00:00:01,0000", "-1:00,000"] {
            assert_eq!(milliseconds(text), None, "{text}");
        }
        assert_eq!(milliseconds("9999999999999999999:00:00.000"), None);
    }

    #[test]
    fn parts_of_a_text_are_found_in_the_file() {
        let file = "1\r\n00:00:01,000 --> 00:00:02,000\r\nGute\r\nfrüh <b\r\n>!\r\n";
        let blocks = srt_blocks(file, &mut Vec::new());
        let (_, body) = cue(&blocks[0], &mut Vec::new()).unwrap();
        let text = body.text();
        for (part, in_file) in [("Gute", "Gute"), ("üh", "üh"), ("<b\n>", "<b"), ("!", "!")] {
            let at = text.find(part).unwrap();
            assert_eq!(&file[body.span(at..at + part.len()).range()], in_file);
        }
    }

    #[test]
    fn cues_come_in_order() {
        let cue = |start_ms, end_ms| Cue { start_ms, end_ms, ..Cue::default() };
        let sorted = |mut cues: Vec<Cue>| {
            let mut diagnostics = Vec::new();
            sort(&mut cues, &mut diagnostics);
            (cues.iter().map(|cue| cue.start_ms).collect::<Vec<_>>(), diagnostics.len())
        };
        assert_eq!(sorted(vec![cue(0, 5), cue(5, 9)]), (vec![0, 5], 0));
        assert_eq!(sorted(vec![cue(5, 9), cue(0, 5)]), (vec![0, 5], 1));
        assert_eq!(sorted(vec![cue(0, 6), cue(5, 9)]), (vec![0, 5], 1));
    }
}
