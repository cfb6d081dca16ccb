//! A new lip-sync track for an existing clip, which keeps the work of writers and translators.
//!
//! A retake, or a new analysis of the same recording, only affects mouth shapes and times. [`merge`] applies these to a
//! clip; [`Clip::merge`](crate::ImportedClip::merge) also adds the other content of an import.

mod imported;
mod place;

use crate::import::{element, fps, spell};
use crate::text_element::locale_of;
use crate::{Time, TimedText};
use lipz_diagnostics::{Code, Diagnostic, Severity, escape};
use lipz_file::locale::text_name;
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, is_white_space, segment_count};
use lipz_file::{Document, Element, Value, phones};
use lipz_types::VisemeType;

/// The lip-sync track of a recording: codes, and the known times of its text.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Mouth {
    /// The codes, one per frame, without `|`.
    pub codes: String,
    /// The frame rate.
    pub rate: Rate,
    /// The type of the codes.
    pub viseme_type: VisemeType,
    /// The start of each segment except the first, if known. It is used for clips with the same number of segments.
    pub segment_starts: Option<Vec<Time>>,
    /// The spoken words, ordered by time.
    pub words: Vec<TimedText>,
    /// The phrases: stretches of text that belong together, ordered by time.
    pub phrases: Vec<TimedText>,
    /// The value of the element `phones`, if the phones of the recording are known.
    pub phones: Option<String>,
}

impl Mouth {
    /// Returns a lip-sync track that only has codes.
    pub fn new(codes: impl Into<String>, rate: Rate, viseme_type: VisemeType) -> Mouth {
        let (codes, words, phrases) = (codes_of(&codes.into()).collect(), Vec::new(), Vec::new());
        Mouth { codes, rate, viseme_type, segment_starts: None, words, phrases, phones: None }
    }

    /// Sets the start of each segment except the first.
    #[must_use]
    pub fn segment_starts(self, segment_starts: impl Into<Option<Vec<Time>>>) -> Mouth {
        Mouth { segment_starts: segment_starts.into(), ..self }
    }

    /// Sets the spoken words, ordered by time.
    #[must_use]
    pub fn words(self, words: Vec<TimedText>) -> Mouth {
        Mouth { words, ..self }
    }

    /// Sets the phrases, ordered by time.
    #[must_use]
    pub fn phrases(self, phrases: Vec<TimedText>) -> Mouth {
        Mouth { phrases, ..self }
    }

    /// Sets the value of the element `phones`.
    #[must_use]
    pub fn phones(self, phones: impl Into<Option<String>>) -> Mouth {
        Mouth { phones: phones.into(), ..self }
    }
}

/// The options of merging.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MergeOptions<'a> {
    /// The spoken locale. Without it, or without a text in it, the first text of the clip counts as spoken.
    pub locale: Option<&'a str>,
    /// The locale of `text` without a locale.
    pub default_locale: Option<&'a str>,
    /// The shortest rest that counts as a pause.
    pub min_pause: Time,
    /// The frame rate of files without `fps`. Clips with this rate do not need the element.
    pub default_rate: Option<Rate>,
    /// The type of files without `viseme_type`. Clips with this type do not need the element.
    pub default_viseme_type: Option<VisemeType>,
    /// Whether an import adds phones to clips that have visemes, but no phones.
    pub phones: bool,
}

impl Default for MergeOptions<'_> {
    fn default() -> Self {
        MergeOptions {
            locale: None,
            default_locale: None,
            min_pause: Time::new(300, 1000),
            default_rate: None,
            default_viseme_type: None,
            phones: false,
        }
    }
}

/// Setters; each takes a value or an `Option`.
impl<'a> MergeOptions<'a> {
    /// Returns the default options.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the spoken locale.
    #[must_use]
    pub fn locale(self, locale: impl Into<Option<&'a str>>) -> Self {
        MergeOptions { locale: locale.into(), ..self }
    }

    /// Sets the locale of `text` without a locale.
    #[must_use]
    pub fn default_locale(self, locale: impl Into<Option<&'a str>>) -> Self {
        MergeOptions { default_locale: locale.into(), ..self }
    }

    /// Sets the shortest rest that counts as a pause.
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

    /// Sets whether an import adds phones to clips that have visemes, but no phones.
    #[must_use]
    pub fn phones(self, phones: bool) -> Self {
        MergeOptions { phones, ..self }
    }
}

/// A clip with a new lip-sync track.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct MergedClip<'s> {
    /// The clip.
    pub document: Document<'s>,
    /// The guesses, and the parts of an import that were dropped.
    pub diagnostics: Vec<Diagnostic>,
}

/// Replaces the lip-sync track of a clip: `visemes`, `viseme_type`, `fps` and `phones`. All other elements stay, in
/// order.
///
/// If the visemes change and the new track has no phones, the phones of the clip belong to another recording. They are
/// removed, which a diagnostic reports (LZ1117).
///
/// The clip keeps its segments. The first of these that applies determines where each of them starts: the segments of
/// the new track, if it has the same number; the old positions, if the codes are unchanged; the phrases of the track,
/// if it has the same number; the times of words; the old times, if the length of the recording is unchanged; the pause
/// nearest to the old share of the speech or, without an old track, to the share of the letters. If none of them
/// applies, the start is a guess, which a diagnostic reports (LZ1109).
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
pub fn merge<'s>(clip: &Document<'s>, mouth: &Mouth, options: &MergeOptions<'_>) -> MergedClip<'s> {
    let mut diagnostics = Vec::new();
    let parts = Parts::from_document(clip, options);
    parts.report_others(clip, &mut diagnostics);
    let starts = place::starts(&parts, clip, mouth, options, &mut diagnostics);
    let mut document = clip.clone();
    set_phones(&mut document, mouth, &mut diagnostics);
    set_mouth(&mut document, divided(&mouth.codes, &starts), mouth, options);
    MergedClip { document, diagnostics }
}

/// The segments of a clip, from its texts and events.
struct Parts<'d> {
    /// The number of segments.
    count: usize,
    /// The spoken text, if the clip has one.
    spoken: Option<&'d str>,
}

impl<'d> Parts<'d> {
    fn from_document(clip: &'d Document<'_>, options: &MergeOptions<'_>) -> Parts<'d> {
        let locale_of = |element: &'d Element<'_>| locale_of(&element.name.text, options.default_locale);
        let texts = || clip.elements.iter().filter_map(|element| Some((locale_of(element)?, string(element)?)));
        let is_spoken = |(locale, _): &(String, &str)| Some(locale.as_str()) == options.locale;
        let spoken = texts().find(is_spoken).or_else(|| texts().next()).map(|(_, text)| text);
        let divided = spoken.or_else(|| clip.string("events")).or_else(|| clip.string("visemes"));
        Parts { count: divided.map_or(1, segment_count), spoken }
    }

    /// Reports texts and events with a different number of segments, which did not match before either.
    fn report_others(&self, clip: &Document<'_>, diagnostics: &mut Vec<Diagnostic>) {
        for element in &clip.elements {
            let is_divided = element.name.text == "events" || text_name(&element.name.text).is_some();
            let Some(count) = string(element).filter(|_| is_divided).map(segment_count) else { continue };
            if count != self.count {
                let name = escape::quoted(&element.name.text);
                let segments = if count == 1 { "segment" } else { "segments" };
                let message = format!("{name} has {count} {segments}, but the new visemes have {}", self.count);
                let diagnostic = Diagnostic::at(Code::SegmentCount, element.value.span(), message);
                let mut diagnostic = diagnostic.help("put a `|` into each element where the segments meet");
                diagnostic.severity = Severity::Warning;
                diagnostics.push(diagnostic);
            }
        }
    }
}

fn string<'d>(element: &'d Element<'_>) -> Option<&'d str> {
    match &element.value {
        Value::String(string) => Some(&string.text),
        _ => None,
    }
}

/// Returns the codes of `visemes` without `|`.
fn codes_of(visemes: &str) -> impl Iterator<Item = char> + '_ {
    visemes.chars().filter(|&code| code != DELIMITER && !is_white_space(code))
}

/// Returns the codes with a `|` before each of these frames, which ascend.
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

/// Replaces the phones, or removes those of another recording.
fn set_phones(document: &mut Document<'_>, mouth: &Mouth, diagnostics: &mut Vec<Diagnostic>) {
    if let Some(phones) = &mouth.phones {
        return set(document, phones::ELEMENT, element(phones::ELEMENT, phones.clone()));
    }
    let is_new = document.string("visemes").is_some_and(|visemes| !codes_of(visemes).eq(mouth.codes.chars()));
    let Some(old) = document.get(phones::ELEMENT).filter(|_| is_new) else { return };
    let message = "the phones of the clip are removed because its visemes change";
    diagnostics.push(
        Diagnostic::at(Code::PhonesRemoved, old.value.span(), message)
            .note("they have the times of the previous recording")
            .help("run `lipz sync` with phones = true in the table [sync] to write the phones of the new recording"),
    );
    document.elements.retain(|element| element.name.text != phones::ELEMENT);
}

/// Replaces the elements of the lip-sync track. Values with the same meaning keep their spelling.
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
    // A rate without an exact decimal form is compared by its spelling.
    let spelled = rate.is_some_and(|rate| spell(rate) == spell(mouth.rate));
    if !spelled && !rate.is_some_and(is_same) {
        set(document, "fps", fps(mouth.rate));
    }
}

/// Sets the value of an element. A new element is inserted at the position that the specification's examples use.
fn set(document: &mut Document<'_>, name: &str, new: Element<'static>) {
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
