//! A new mouth for a clip that exists: the work of writers and translators stays.
//!
//! A retake, or another analysis of the same recording, decides about mouth shapes and times only. [`merge`] gives
//! them to a clip; [`Clip::merge`](crate::Clip::merge) does so with what an import has besides.

mod imported;
mod place;

use crate::import::{element, fps, spell};
use crate::{Time, Timed};
use lipz_diagnostics::{Code, Diagnostic, Severity, escape};
use lipz_file::locale::{TextName, text_name};
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, is_white_space, segment_count};
use lipz_file::{Document, Value};
use lipz_types::VisemeType;

/// The mouth of a recording: codes, and what is known about the times of what is said.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Mouth {
    /// The codes, one per frame, without `|`.
    pub codes: String,
    /// The frame rate.
    pub rate: Rate,
    /// The type of the codes.
    pub viseme_type: VisemeType,
    /// When each segment but the first starts, if that is known. It counts for clips with that many segments.
    pub segment_starts: Option<Vec<Time>>,
    /// The spoken words, in the order of their times.
    pub words: Vec<Timed>,
    /// Stretches of text that belong together, in the order of their times.
    pub phrases: Vec<Timed>,
}

impl Mouth {
    /// A mouth of which nothing but the codes is known.
    pub fn new(codes: impl Into<String>, rate: Rate, viseme_type: VisemeType) -> Mouth {
        let (codes, words, phrases) = (codes_of(&codes.into()).collect(), Vec::new(), Vec::new());
        Mouth { codes, rate, viseme_type, segment_starts: None, words, phrases }
    }

    /// Sets when each segment but the first starts.
    #[must_use]
    pub fn segment_starts(self, segment_starts: impl Into<Option<Vec<Time>>>) -> Mouth {
        Mouth { segment_starts: segment_starts.into(), ..self }
    }

    /// Sets the spoken words, in the order of their times.
    #[must_use]
    pub fn words(self, words: Vec<Timed>) -> Mouth {
        Mouth { words, ..self }
    }

    /// Sets the phrases, in the order of their times.
    #[must_use]
    pub fn phrases(self, phrases: Vec<Timed>) -> Mouth {
        Mouth { phrases, ..self }
    }
}

/// What a project decides about merging.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MergeOptions<'a> {
    /// The locale that is spoken; without it, or a text in it, the first text of the clip is.
    pub locale: Option<&'a str>,
    /// The shortest rest of the mouth that is a pause.
    pub min_pause: Time,
    /// The frame rate of files without `fps`: a clip of this rate needs none.
    pub default_rate: Option<Rate>,
    /// The type of files without `viseme_type`: a clip of this type needs none.
    pub default_viseme_type: Option<VisemeType>,
}

impl Default for MergeOptions<'_> {
    fn default() -> Self {
        let (locale, default_rate, default_viseme_type) = (None, None, None);
        MergeOptions { locale, min_pause: Time::new(300, 1000), default_rate, default_viseme_type }
    }
}

/// Setters; each takes a value or an `Option`.
impl<'a> MergeOptions<'a> {
    /// The usual decisions.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the locale that is spoken.
    #[must_use]
    pub fn locale(self, locale: impl Into<Option<&'a str>>) -> Self {
        MergeOptions { locale: locale.into(), ..self }
    }

    /// Sets the shortest rest of the mouth that is a pause.
    #[must_use]
    pub fn min_pause(self, min_pause: Time) -> Self {
        MergeOptions { min_pause, ..self }
    }

    /// Sets the frame rate of files without `fps`.
    #[must_use]
    pub fn default_rate(self, default_rate: impl Into<Option<Rate>>) -> Self {
        MergeOptions { default_rate: default_rate.into(), ..self }
    }

    /// Sets the type of files without `viseme_type`.
    #[must_use]
    pub fn default_viseme_type(self, default_viseme_type: impl Into<Option<VisemeType>>) -> Self {
        MergeOptions { default_viseme_type: default_viseme_type.into(), ..self }
    }
}

/// A clip with a new mouth.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Merged<'s> {
    /// The clip.
    pub document: Document<'s>,
    /// What was guessed, and what of an import was not taken.
    pub diagnostics: Vec<Diagnostic>,
}

/// Gives a clip a new mouth: `visemes`, `viseme_type` and `fps` are replaced, all other elements stay, in their order.
///
/// The clip keeps its segments. Where each of them starts in the new mouth is looked up, in this order: the mouth's
/// own segments, if it has as many; the old places, if the codes are the same; the mouth's phrases, if it has as many;
/// the times of words; the old times, if the recording is as long as before; the pause of the mouth that is nearest to
/// where the segment was in the old speech or, without an old mouth, to where it would be if every letter took the
/// same time. A segment that starts at none of these is a guess, which a diagnostic tells (LZ1109).
///
/// ```
/// use lipz_interop::{MergeOptions, Mouth, merge};
/// use lipz_types::VisemeType;
/// let clip = lipz_file::parse(br#"{ "fps": 4, "visemes": "MA--|EO", "text_en-us": "Hi. |You?", "mood": 7 }"#);
/// let clip = clip.document.ok_or("a valid file")?;
/// let rate = lipz_file::rate::parse("4").ok_or("a rate")?;
/// let merged = merge(&clip, &Mouth::new("-MMA--EOOO", rate, VisemeType::Blair), &MergeOptions::new());
/// assert_eq!(merged.document.string("visemes"), Some("-MMA--|EOOO"));
/// assert_eq!(merged.document.string("text_en-us"), Some("Hi. |You?"));
/// assert!(merged.diagnostics.is_empty() && merged.document.get("mood").is_some());
/// # Ok::<(), &str>(())
/// ```
pub fn merge<'s>(clip: &Document<'s>, mouth: &Mouth, options: &MergeOptions<'_>) -> Merged<'s> {
    let mut diagnostics = Vec::new();
    let parts = Parts::from_document(clip, options.locale);
    parts.report_others(clip, &mut diagnostics);
    let starts = place::starts(&parts, clip, mouth, options, &mut diagnostics);
    let mut document = clip.clone();
    set_mouth(&mut document, divided(&mouth.codes, &starts), mouth, options);
    Merged { document, diagnostics }
}

/// The segments of a clip, as its texts and events have them.
struct Parts<'d> {
    /// How many there are.
    count: usize,
    /// What is spoken, if the clip has a text.
    spoken: Option<&'d str>,
}

impl<'d> Parts<'d> {
    fn from_document(clip: &'d Document<'_>, locale: Option<&str>) -> Parts<'d> {
        let texts = || clip.elements.iter().filter_map(|element| Some((tag(&element.name.text)?, string(element)?)));
        let is_spoken = |(tag, _): &(String, &str)| Some(tag.as_str()) == locale;
        let spoken = texts().find(is_spoken).or_else(|| texts().next()).map(|(_, text)| text);
        let divided = spoken.or_else(|| clip.string("events")).or_else(|| clip.string("visemes"));
        Parts { count: divided.map_or(1, segment_count), spoken }
    }

    /// Reports texts and events with another number of segments: they did not agree before, either.
    fn report_others(&self, clip: &Document<'_>, diagnostics: &mut Vec<Diagnostic>) {
        for element in &clip.elements {
            let is_divided = element.name.text == "events" || text_name(&element.name.text).is_some();
            let Some(count) = string(element).filter(|_| is_divided).map(segment_count) else { continue };
            if count != self.count {
                let name = escape::quoted(&element.name.text);
                let segments = if count == 1 { "segment" } else { "segments" };
                let message = format!("{name} has {count} {segments}, but the new mouth has {}", self.count);
                let diagnostic = Diagnostic::at(Code::SegmentCount, element.value.span(), message);
                let mut diagnostic = diagnostic.help("put a `|` into each element where the segments meet");
                diagnostic.severity = Severity::Warning;
                diagnostics.push(diagnostic);
            }
        }
    }
}

/// The locale of a text by the name of its element, empty if it names none; `None` if it is no text.
fn tag(name: &str) -> Option<String> {
    Some(match text_name(name)? {
        TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag)) => tag,
        TextName::OtherShape(locale, None) => locale,
        TextName::NoLocale => String::new(),
    })
}

fn string<'d>(element: &'d lipz_file::Element<'_>) -> Option<&'d str> {
    match &element.value {
        Value::String(string) => Some(&string.text),
        _ => None,
    }
}

/// The codes of `visemes` without `|`.
fn codes_of(visemes: &str) -> impl Iterator<Item = char> + '_ {
    visemes.chars().filter(|&code| code != DELIMITER && !is_white_space(code))
}

/// Codes with a `|` before each of these frames, which ascend.
fn divided(codes: &str, starts: &[usize]) -> String {
    let mut divided = String::with_capacity(codes.len() + starts.len());
    let mut done = 0;
    for &start in starts {
        divided += codes.get(done..start).unwrap_or_default();
        divided.push(DELIMITER);
        done = start;
    }
    divided + codes.get(done..).unwrap_or_default()
}

/// Replaces what a mouth decides about. Values that say the same stay as they are spelled.
fn set_mouth(document: &mut Document<'_>, visemes: String, mouth: &Mouth, options: &MergeOptions<'_>) {
    if document.string("visemes") != Some(&visemes) {
        set(document, "visemes", element("visemes", visemes));
    }
    let viseme_type = match document.get("viseme_type") {
        Some(_) => document.string("viseme_type").and_then(|name| name.parse().ok()),
        None => options.default_viseme_type,
    };
    if viseme_type != Some(mouth.viseme_type) {
        set(document, "viseme_type", element("viseme_type", mouth.viseme_type.name().to_owned()));
    }
    let is_same = |rate: Rate| (rate.numerator, rate.denominator) == (mouth.rate.numerator, mouth.rate.denominator);
    let rate = match document.get("fps") {
        Some(_) => crate::export::rate(document),
        None => options.default_rate,
    };
    // A rate that decimal digits do not hold is compared as it would be spelled.
    let spelled = rate.is_some_and(|rate| spell(rate) == spell(mouth.rate));
    if !spelled && !rate.is_some_and(is_same) {
        set(document, "fps", fps(mouth.rate));
    }
}

/// Gives an element a value; a new one comes where the specification's examples have it.
fn set(document: &mut Document<'_>, name: &str, new: lipz_file::Element<'static>) {
    if let Some(element) = document.elements.iter_mut().find(|element| element.name.text == name) {
        element.value = new.value;
        return;
    }
    let is_before = |other: &str| match name {
        "visemes" => false,
        "viseme_type" | "fps" => matches!(other, "visemes" | "events" | "viseme_type") || text_name(other).is_some(),
        _ => other == "visemes" || text_name(other).is_some(),
    };
    let before = document.elements.iter().rposition(|element| is_before(&element.name.text));
    document.elements.insert(before.map_or(0, |at| at + 1), new);
}
