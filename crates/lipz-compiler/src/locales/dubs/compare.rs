//! Comparison of dubs with their originals.

use super::KeptDubs;
use crate::clip::{Clip, Clips};
use crate::project::Options;
use crate::project::pseudo_locale::is_pseudo;
use crate::sources::{Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, escape};
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, JsonString, Value};
use std::borrow::Cow;
use std::collections::HashMap;
use std::fs;

const DIVIDE: &str =
    "put a `|` into the dub where each segment of the original starts; their texts and events belong together";
const REMOVE: &str = "remove the text from the dub, which then has that of the original, or allow the lint if the \
    difference is intended";

/// Returns the problems of the dubs among these files, whose clips are in `batches` together with those of a bank
/// below: reports at the project's levels, each with the number of its input.
pub(crate) fn compare(batches: &[Clips], inputs: &[Input], options: &Options, kept: &KeptDubs) -> Vec<(u32, Report)> {
    if options.voices.locales().nth(1).is_none() && kept.originals.is_empty() {
        return Vec::new();
    }
    let places: HashMap<&str, usize> = inputs.iter().map(|input| input.key.as_str()).zip(0..).collect();
    let clips = Clips::by_key(batches);
    let clip = |key: &str| Some(&clips[clips.binary_search_by(|clip| clip.key().cmp(key)).ok()?]);
    let mut found = Vec::new();
    for (index, dub) in inputs.iter().enumerate() {
        let Some(line) = options.voices.dubbed_line(&dub.key) else {
            // A file of a line whose dubs are in the bank below.
            let of_line = kept.of_line(&dub.key).filter(|key| !places.contains_key(key));
            let report = clip(&dub.key).and_then(|own| segments_below(own, dub, of_line.filter_map(clip)));
            found.extend(report.map(|report| (index as u32, report)));
            continue;
        };
        let is_there = |key: &str| places.contains_key(key) || clip(key).is_some();
        let original = options.voices.original_of(&dub.key, is_there).filter(|key| !kept.originals.contains_key(key));
        let report = match original {
            None => Some(Report::about(dub.name(), without_original(dub, line, options))),
            Some(original) => match (clip(&dub.key), clip(&original), places.get(original.as_str())) {
                (Some(one), Some(other), Some(place)) => {
                    inputs.get(*place).and_then(|original| differing(one, other, dub, original, options))
                }
                (Some(one), Some(other), None) => segments_below(one, dub, [other].into_iter()),
                _ => None, // one of the two has errors
            },
        };
        let Some(mut report) = report else { continue };
        options.apply_levels(&mut report);
        if !report.diagnostics.is_empty() {
            found.push((index as u32, report));
        }
    }
    found
}

/// Reports that a file has different segments than one of the clips of its line in a bank below.
fn segments_below<'c>(
    own: &Clip<'_>,
    input: &Input,
    mut of_line: impl Iterator<Item = &'c Clip<'c>>,
) -> Option<Report> {
    let other = of_line.find(|other| other.starts().len() != own.starts().len())?;
    let (theirs, key) = (other.starts().len(), escape::text(other.key()));
    let message = format!(
        "the clip has {}, but `{key}` of the same line in the bank below has {theirs}",
        count(own.starts().len())
    );
    let help = format!(
        "add `{key}` with the same number of segments; the texts and events of a dub and its original belong together"
    );
    Some(Report::about(input.name(), Diagnostic::new(Code::DubSegments, message).help(help)))
}

fn without_original(dub: &Input, line: &str, options: &Options) -> Diagnostic {
    let (locale, _) = options.voices.of_key(&dub.key).unwrap_or_default();
    let wanted = options.voices.originals_of(line);
    let wanted: Vec<String> = wanted.iter().map(|key| format!("`{}`", escape::text(key))).collect();
    let message = format!("the clip is a dub in `{locale}`, but its original is missing: {}", wanted.join(" or "));
    Diagnostic::new(Code::DubWithoutOriginal, message).help(
        "add the original, rename the dub, or correct the pattern in [voices]; games find dubs through their originals",
    )
}

/// Reports different segments, or else texts that contradict those of the original.
fn differing(one: &Clip<'_>, other: &Clip<'_>, dub: &Input, original: &Input, options: &Options) -> Option<Report> {
    let counts = (one.starts().len(), other.starts().len());
    let texts: Vec<&str> = if counts.0 == counts.1 { contradicting(one, other) } else { Vec::new() };
    if counts.0 == counts.1 && texts.is_empty() {
        return None;
    }
    // Read the files again, because clips do not store positions, and few dubs get here.
    let (dub_bytes, original_bytes) = (bytes_of(dub).unwrap_or_default(), bytes_of(original).unwrap_or_default());
    let parsed = (lipz_file::parse(&dub_bytes).document, lipz_file::parse(&original_bytes).document);
    let (Some(dub_document), Some(original_document)) = parsed else {
        return Some(Report::all_about(dub.name(), without_places(counts, &texts, original)));
    };
    let place = |span: Span| {
        let source =
            Source::new(original.name(), String::from_utf8_lossy(lipz_file::without_byte_order_mark(&original_bytes)));
        let at = source.line_column(span.start);
        format!("{}:{}:{}", escape::text(&source.path), at.line, at.column)
    };
    let mut diagnostics = Vec::new();
    if counts.0 != counts.1 {
        let message = other_segments(counts);
        let (own, theirs) = (divided(&dub_document), divided(&original_document));
        let diagnostic = match own {
            Some(own) => Diagnostic::at(Code::DubSegments, own.span(), message).label(count(counts.0)),
            None => Diagnostic::new(Code::DubSegments, message),
        };
        let at = theirs.map_or_else(|| original.name(), |theirs| place(theirs.span()));
        let shown = theirs.map(|theirs| format!(": {}", escape::quoted(&theirs.text))).unwrap_or_default();
        diagnostics.push(diagnostic.note(format!("the original has {} at {at}{shown}", count(counts.1))).help(DIVIDE));
    }
    for tag in texts {
        let (Some(own), Some(theirs)) =
            (text_in(&dub_document, tag, options), text_in(&original_document, tag, options))
        else {
            continue; // a pseudo-locale, or a locale that is not packed
        };
        let message = other_text(tag);
        let note = format!("the original has {} at {}", escape::quoted(&theirs.text), place(theirs.span()));
        diagnostics.push(Diagnostic::at(Code::DubText, own.span(), message).note(note).help(REMOVE));
    }
    Some(Report::from_bytes(dub.name(), &dub_bytes, diagnostics))
}

/// Reports the same without the files: on a machine that links objects, or if they have been deleted.
fn without_places(counts: (usize, usize), texts: &[&str], original: &Input) -> Vec<Diagnostic> {
    let note = || format!("the original is {}", original.name());
    let segments = (counts.0 != counts.1)
        .then(|| Diagnostic::new(Code::DubSegments, other_segments(counts)).note(note()).help(DIVIDE));
    let texts = texts.iter().filter(|tag| !is_pseudo(tag));
    let texts = texts.map(|tag| Diagnostic::new(Code::DubText, other_text(tag)).note(note()).help(REMOVE));
    segments.into_iter().chain(texts).collect()
}

fn count(count: usize) -> String {
    if count == 1 { "1 segment".to_owned() } else { format!("{count} segments") }
}

fn other_segments((own, theirs): (usize, usize)) -> String {
    format!("the dub has {}, but its original has {theirs}", count(own))
}

fn other_text(tag: &str) -> String {
    format!("the dub and its original have different texts in `{tag}`")
}

/// Returns the locales in which both have texts, but different ones.
fn contradicting<'c>(dub: &Clip<'c>, original: &Clip<'_>) -> Vec<&'c str> {
    let own = dub.texts().iter().enumerate().filter(|(_, text)| !text.is_fallback());
    let differs = |tag: &str, own: usize| {
        let mut theirs = original.texts().iter().enumerate().filter(|(_, text)| !text.is_fallback());
        let theirs = theirs.find(|(_, text)| original.tag(text) == tag);
        theirs.is_some_and(|(theirs, _)| {
            dub.text_ends(own) != original.text_ends(theirs) || dub.displays(own) != original.displays(theirs)
        })
    };
    own.filter(|(own, text)| differs(dub.tag(text), *own)).map(|(_, text)| dub.tag(text)).collect()
}

fn bytes_of(input: &Input) -> Option<Cow<'_, [u8]>> {
    match &input.content {
        Content::Bytes { bytes, .. } => Some(Cow::Borrowed(bytes)),
        Content::File(path) => fs::read(path).ok().map(Cow::Owned),
    }
}

/// Returns the element that determines the number of a clip's segments.
fn divided<'d>(document: &'d Document<'d>) -> Option<&'d JsonString<'d>> {
    let string = |is_meant: fn(&str) -> bool| string_where(document, is_meant);
    string(|name| name == "visemes")
        .or_else(|| string(|name| text_name(name).is_some()))
        .or_else(|| string(|name| name == "events"))
}

/// Returns the text in a locale.
fn text_in<'d>(document: &'d Document<'d>, tag: &str, options: &Options) -> Option<&'d JsonString<'d>> {
    let default = options.default_locale.as_deref();
    string_where(document, |name| match text_name(name) {
        Some(TextName::NoLocale) => default == Some(tag),
        text => text.and_then(TextName::tag).as_deref() == Some(tag),
    })
}

/// Returns the first string element with a matching name.
fn string_where<'d>(document: &'d Document<'d>, is_meant: impl Fn(&str) -> bool) -> Option<&'d JsonString<'d>> {
    document.elements.iter().find(|element| is_meant(&element.name.text)).and_then(|element| match &element.value {
        Value::String(string) => Some(string),
        _ => None,
    })
}
