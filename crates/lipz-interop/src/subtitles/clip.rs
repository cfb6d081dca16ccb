//! Conversion of a clip to cues: a segment with a text is shown from its first frame to the start of the next one.

use super::Cue;
use crate::Time;
use crate::export::{rate, refusal};
use crate::text_element::text_in;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, display, is_white_space, segments};
use lipz_file::{Document, Value};

/// A project's options for subtitles.
#[derive(Clone, Copy, Debug, Default)]
pub struct SubtitleOptions<'a> {
    /// The frame rate of files without `fps`.
    pub default_rate: Option<Rate>,
    /// The locale of `text` without a locale.
    pub default_locale: Option<&'a str>,
    /// When cues are made, the default speaker for texts without `{speaker: …}`.
    pub speaker: Option<&'a str>,
}

/// Returns the cues of a clip in a locale, with times to the millisecond, rounded to the nearest. Segments without a
/// text have no cue; diagnostics report texts without a time. Returns `None` if the clip has no text in the locale, or
/// a diagnostic is an error.
///
/// ```
/// use lipz_interop::subtitles::{SubtitleOptions, cues};
/// let parsed = lipz_file::parse(br#"{ "fps": 24, "visemes": "--MA|EO--", "text_en-us": "|Hello." }"#);
/// let document = parsed.document.ok_or("a valid file")?;
/// let cues = cues(&document, "en-us", &SubtitleOptions::default(), &mut Vec::new()).ok_or("a text")?;
/// assert_eq!((cues[0].start_ms, cues[0].end_ms, cues[0].text.as_str()), (167, 333, "Hello."));
/// # Ok::<(), &str>(())
/// ```
pub fn cues(
    document: &Document<'_>,
    locale: &str,
    options: &SubtitleOptions<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<Cue>> {
    let element = text_in(document, locale, options.default_locale)?;
    let Value::String(string) = &element.value else { return None };
    let Some(rate) = rate(document).or(options.default_rate) else {
        diagnostics.push(
            refusal("the clip has no frame rate").help("add \"fps\" to the file, or set `default-fps` in lipz.toml"),
        );
        return None;
    };
    let Some(bounds) = document.string("visemes").map(bounds) else {
        diagnostics.push(refusal("the clip has no mouth shapes, so its segments have no times"));
        return None;
    };
    let mut cues = Vec::new();
    for (range, frames) in segments(&string.text).zip(bounds.windows(2)) {
        let text = string.text.get(range.clone()).unwrap_or_default();
        if display(text).text.is_empty() {
            continue;
        }
        let &[start, end] = frames else { continue };
        let span = string.span_of(range);
        if start == end {
            let diagnostic =
                Diagnostic::at(Code::SubtitleLoss, span, "the segment has no frames, so it does not become a cue");
            diagnostics.push(diagnostic.help("give it frames, or move its text to a segment with frames"));
            continue;
        }
        let ms = |frame| Time::of_frame(frame, rate).in_units(1000);
        let text = match options.speaker {
            Some(name) if !text.contains("{speaker:") => format!("{{speaker: {name}}} {text}"),
            _ => text.to_owned(),
        };
        cues.push(Cue { start_ms: ms(start), end_ms: ms(end), text, span });
    }
    Some(cues)
}

/// Returns the first frames of the segments, and the number of all frames.
pub(crate) fn bounds(visemes: &str) -> Vec<u64> {
    let mut frame = 0;
    let mut bounds = vec![0];
    for code in visemes.chars().filter(|code| !is_white_space(*code)) {
        match code {
            DELIMITER => bounds.push(frame),
            _ => frame += 1,
        }
    }
    bounds.push(frame);
    bounds
}
