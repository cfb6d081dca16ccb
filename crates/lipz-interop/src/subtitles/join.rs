//! Conversion of cues to a clip: sets the texts of its segments, and creates segments if there are none.

use super::clip::bounds;
use super::outside::in_clip;
use super::{Cue, SubtitleOptions};
use crate::export::rate;
use crate::import::{REST, element, fps};
use crate::text_element::text_in;
use crate::{DEFAULT_RATE, Time};
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::locale::text_name;
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, display, is_white_space, meta, segments, trim};
use lipz_file::{Document, Value};
use std::cmp::Reverse;

/// Returns a clip made of subtitles alone. The mouth rests, each cue becomes a segment, and segments without text fill
/// the gaps.
///
/// ```
/// use lipz_interop::subtitles::{Cue, clip};
/// let cue = Cue { start_ms: 125, end_ms: 250, text: "Hello.".into(), ..Cue::default() };
/// let rate = lipz_file::rate::parse("24").ok_or("a rate")?;
/// let document = clip(&[cue], "en-us", rate, &mut Vec::new());
/// assert_eq!(document.string("visemes"), Some("---|---"));
/// assert_eq!(document.string("text_en-us"), Some("|Hello."));
/// # Ok::<(), &str>(())
/// ```
pub fn clip(cues: &[Cue], locale: &str, rate: Rate, diagnostics: &mut Vec<Diagnostic>) -> Document<'static> {
    let cues = &*in_clip(cues, None, rate, diagnostics).unwrap_or_default();
    let end_ms = cues.iter().map(|cue| cue.end_ms).max().unwrap_or(0);
    let frames = usize::try_from(Time::new(end_ms, 1000).nearest_frame(rate)).unwrap_or(usize::MAX);
    if let Some(last) = cues.iter().max_by_key(|cue| cue.end_ms).filter(|_| frames > MAX_FRAMES) {
        let message = format!("the clip would have {frames} frames, more than {MAX_FRAMES}");
        let diagnostic = Diagnostic::at(Code::SubtitleOutside, last.span, message);
        diagnostics.push(diagnostic.help("correct the time, which is more than a day"));
    }
    let codes = vec![REST; frames.min(MAX_FRAMES)];
    let division = divide(cues, codes.len() as u64, rate, diagnostics);
    Document {
        elements: vec![
            element("visemes", division.visemes(&codes)),
            element(&format!("text_{locale}"), division.text()),
            fps(rate),
        ],
    }
}

/// The most frames of a clip. More than a day at 24 frames per second can only be a mistake.
const MAX_FRAMES: usize = 1 << 22;

/// Replaces the texts of a clip in a locale with those of `cues`.
///
/// A clip without segments gets those of the cues. Otherwise it keeps its segments, and a cue becomes the text of the
/// segment that it overlaps longest. Segments whose display text does not change keep their spelling, including meta
/// and spaces. If a diagnostic is an error, the clip does not change. Clips without a frame rate have
/// [`DEFAULT_RATE`], unless the options set one.
pub fn join<'s>(
    mut document: Document<'s>,
    cues: &[Cue],
    locale: &str,
    options: &SubtitleOptions<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Document<'s> {
    // A text without a locale stays so.
    let own = text_in(&document, locale, options.default_locale).map(|element| element.name.text.to_string());
    let name = own.unwrap_or_else(|| format!("text_{locale}"));
    let rate = rate(&document).or(options.default_rate).unwrap_or(DEFAULT_RATE);
    let visemes = document.string("visemes").map(str::to_owned);
    let bounds = visemes.as_deref().map(bounds);
    let frames = bounds.as_ref().and_then(|bounds| bounds.last().copied());
    let cues = match frames {
        Some(_) => in_clip(cues, frames, rate, diagnostics),
        None => Some(cues.into()),
    };
    let Some(cues) = cues.as_deref() else { return document };
    let text = match &visemes {
        Some(visemes) if is_undivided(&document, &name) => {
            let codes: Vec<u8> = visemes.bytes().filter(|byte| !is_white_space(char::from(*byte))).collect();
            let division = divide(cues, codes.len() as u64, rate, diagnostics);
            set(&mut document, "visemes", division.visemes(&codes));
            division.text()
        }
        Some(_) => in_segments(cues, &bounds.unwrap_or_default(), rate, diagnostics).join(BAR),
        None => cues.iter().map(|cue| trim(&cue.text)).collect::<Vec<_>>().join(BAR),
    };
    let text = match document.string(&name) {
        Some(old) => {
            let new = keep_spelling(old, &text);
            diagnostics.extend(lost(&name, old, &new));
            new
        }
        None => text,
    };
    set(&mut document, &name, text);
    document
}

/// `|` as a string.
const BAR: &str = "|";

/// Whether the document is undivided, apart from the text with this name, which is replaced.
fn is_undivided(document: &Document<'_>, name: &str) -> bool {
    let is_segmented = |name: &str| matches!(name, "visemes" | "events") || text_name(name).is_some();
    let mut others =
        document.elements.iter().filter(|element| element.name.text != name && is_segmented(&element.name.text));
    others.all(|element| match &element.value {
        // An undivided text in a different locale would have to be divided as well.
        Value::String(string) if element.name.text == "visemes" => !string.text.contains(DELIMITER),
        Value::String(string) => trim(&string.text).is_empty(),
        _ => true,
    })
}

/// The segments for a list of cues.
#[derive(Default)]
struct Division {
    /// The start of each segment, with its text.
    segments: Vec<(u64, String)>,
}

impl Division {
    fn visemes(&self, codes: &[u8]) -> String {
        let starts = self.segments.iter().skip(1).map(|(start, _)| usize::try_from(*start).unwrap_or(usize::MAX));
        let bounds: Vec<usize> = std::iter::once(0).chain(starts).chain([codes.len()]).collect();
        let parts = bounds.windows(2).map(|pair| match pair {
            &[start, end] => codes.get(start..end).unwrap_or_default(),
            _ => &[],
        });
        parts.map(|codes| codes.iter().copied().map(char::from).collect::<String>()).collect::<Vec<_>>().join(BAR)
    }

    fn text(&self) -> String {
        self.segments.iter().map(|(_, text)| trim(text)).collect::<Vec<_>>().join(BAR)
    }
}

/// Returns a segment for each cue, and one without text for each gap.
fn divide(cues: &[Cue], frames: u64, rate: Rate, diagnostics: &mut Vec<Diagnostic>) -> Division {
    let mut division = Division::default();
    let mut end = 0;
    for cue in cues {
        let frame = |ms| Time::new(ms, 1000).nearest_frame(rate).min(frames);
        let (start, until) = (frame(cue.start_ms).max(end), frame(cue.end_ms));
        if until <= start {
            diagnostics.push(place(cue, "the subtitle is not visible in any frame of the clip"));
        }
        if start > end {
            division.segments.push((end, String::new()));
        }
        division.segments.push((start, cue.text.clone()));
        end = until.max(start);
    }
    if end < frames || division.segments.is_empty() {
        division.segments.push((end, String::new()));
    }
    division
}

/// Returns the texts of segments with these bounds. Each cue belongs to the segment that it overlaps longest.
fn in_segments(cues: &[Cue], bounds: &[u64], rate: Rate, diagnostics: &mut Vec<Diagnostic>) -> Vec<String> {
    let mut texts = vec![String::new(); bounds.len().saturating_sub(1)];
    for cue in cues {
        let frame = |ms| Time::new(ms, 1000).nearest_frame(rate);
        let (start, end) = (frame(cue.start_ms), frame(cue.end_ms));
        let shared = |pair: &[u64]| match pair {
            &[first, next] => end.min(next).saturating_sub(start.max(first)),
            _ => 0,
        };
        // Only the segments from the start of the cue to its end are searched.
        let begun = bounds.partition_point(|first| *first <= start).saturating_sub(1);
        let until = bounds.partition_point(|first| *first < end).max(begun);
        let spanned = bounds.get(begun..=until).unwrap_or_else(|| bounds.get(begun..).unwrap_or_default());
        let shows = || (begun..).zip(spanned.windows(2).map(shared));
        // The first one of equal length. A subtitle that overlaps none belongs to the last segment that has begun.
        let last_begun = begun.min(texts.len().saturating_sub(1));
        let longest = shows().max_by_key(|&(at, frames)| (frames, Reverse(at))).filter(|(_, frames)| *frames > 0);
        let (at, longest) = longest.unwrap_or((last_begun, 0));
        if longest == 0 {
            diagnostics.push(place(cue, "the subtitle is not visible in any frame of the clip"));
        } else if let Some((other, frames)) = shows().find(|&(other, frames)| other != at && frames > 1) {
            let (own, other) = (at + 1, other + 1);
            let diagnostic =
                place(cue, &format!("the cue becomes the text of segment {own}, but overlaps segment {other}"));
            diagnostics.push(
                diagnostic.note(format!("it shows for {longest} frames in the first, and for {frames} in the second")),
            );
        }
        if let Some(text) = texts.get_mut(at) {
            if !text.is_empty() {
                text.push('\n');
            }
            text.push_str(trim(&cue.text));
        }
    }
    texts
}

fn place(cue: &Cue, message: &str) -> Diagnostic {
    Diagnostic::at(Code::SubtitlePlace, cue.span, message)
        .help("give it the times of a segment, which each `|` in the visemes sets")
}

/// Restores the old spelling of all segments whose display text has not changed.
fn keep_spelling(old: &str, new: &str) -> String {
    let parts = |text: &str| segments(text).map(|range| text.get(range).unwrap_or_default().to_owned()).collect();
    let (old, mut new): (Vec<String>, Vec<String>) = (parts(old), parts(new));
    for (new, old) in new.iter_mut().zip(old) {
        if display(new).text == display(&old).text {
            *new = old;
        }
    }
    new.join(BAR)
}

/// Returns the parts of the old text that the new one lacks, apart from changed words: texts of segments that are now
/// empty, and meta.
fn lost(name: &str, old: &str, new: &str) -> Option<Diagnostic> {
    let parts = |text| segments(text).map(move |range| text.get(range).unwrap_or_default());
    let (mut emptied, mut metas) = (Vec::new(), Vec::new());
    for ((number, old), new) in (1..).zip(parts(old)).zip(parts(new).chain(std::iter::repeat(""))) {
        if display(new).text.is_empty() && !display(old).text.is_empty() {
            emptied.push(format!("segment {number}: {}", escape::quoted(trim(old))));
            continue;
        }
        let own = meta(old).into_iter().filter_map(|place| old.get(place)).filter(|own| !new.contains(own));
        metas.extend(own.map(|own| format!("segment {number}: {}", escape::quoted(own))));
    }
    let mut all = emptied.iter().map(|text| format!("no subtitle for {text}")).chain(metas);
    let mut diagnostic = Diagnostic::new(
        Code::ClipReplaced,
        format!("{} loses parts that the subtitles do not have", escape::quoted(name)),
    );
    diagnostic = diagnostic.note(all.next()?);
    for text in all.by_ref().take(LOSSES_SHOWN - 1) {
        diagnostic = diagnostic.note(text);
    }
    match all.count() {
        0 => Some(diagnostic),
        more => Some(diagnostic.note(format!("and {more} more"))),
    }
}

/// The number of losses that a diagnostic lists.
const LOSSES_SHOWN: usize = 8;

/// Sets the value of an element. A new text is inserted after the last one, or after the visemes.
fn set(document: &mut Document<'_>, name: &str, value: String) {
    let new = element(name, value);
    match document.elements.iter_mut().find(|element| element.name.text == name) {
        Some(element) => *element = new,
        None => {
            let is_before = |name: &str| name == "visemes" || text_name(name).is_some();
            let before = document.elements.iter().rposition(|element| is_before(&element.name.text));
            document.elements.insert(before.map_or(0, |at| at + 1), new);
        }
    }
}
