//! The times of cues: their lines and their order.

use super::Cue;
use crate::source::Line;
use lipz_diagnostics::{Code, Diagnostic};

/// The separator between the times of a cue.
pub(super) const ARROW: &str = "-->";

/// Returns the cue with the times of a line, `00:00:01,000 --> 00:00:02,500`, without its text. The rest of the line
/// concerns positions on the screen.
pub(super) fn cue(line: Line<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Cue> {
    let (first, second) = time_fields(line)?;
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
    Some(Cue { start_ms, end_ms, text: String::new(), span: line.span() })
}

/// Whether a line has the form of two times. A line of text may contain an arrow, too.
pub(super) fn has_times(line: Line<'_>) -> bool {
    time_fields(line)
        .is_some_and(|(first, second)| [first, second].iter().all(|time| milliseconds(time.text).is_some()))
}

/// Returns the two times of a line, which an arrow separates.
fn time_fields(line: Line<'_>) -> Option<(Line<'_>, Line<'_>)> {
    let (before, after) = line.text.split_once(ARROW)?;
    let behind = Line { text: after, at: line.at + before.len() + ARROW.len() };
    let second = behind.fields().next().unwrap_or(behind);
    Some((Line { text: before, at: line.at }.trimmed(), without_settings(second)))
}

/// Returns a time without the settings that may follow it without a space, as in `00:02.500align:start`.
fn without_settings(field: Line<'_>) -> Line<'_> {
    let end = field.text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(field.text.len());
    let time = field.text.get(..end).unwrap_or_default();
    let is_whole = time.rsplit_once(['.', ',']).is_some_and(|(_, fraction)| fraction.len() == 3);
    if is_whole { Line { text: time, at: field.at } } else { field }
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
    fn lines_with_times() {
        let has_times = |text| has_times(Line { text, at: 0 });
        for text in ["00:01,0 --> 00:02", "00:00:01.000-->00:00:02.000 align:end", "00:01.000 --> 00:02.000align:end"] {
            assert!(has_times(text), "{text}");
        }
        for text in ["a --> b", "00:01.000 -->", "00:01.000 --> 00:02x", "00:01.000 -> 00:02.000", "x 00:01 --> 00:02"]
        {
            assert!(!has_times(text), "{text}");
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
