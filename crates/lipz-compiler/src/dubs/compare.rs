//! Whether dubs and their originals belong together.

use crate::clip::{Clip, Clips};
use crate::{Content, Input, Options};
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, escape};
use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, JsonString, Value};
use std::borrow::Cow;
use std::collections::HashMap;
use std::fs;

/// What is wrong with the dubs among these files, whose clips are in `batches`: reports at the project's levels, each with
/// the number of its input.
pub(crate) fn compare(batches: &[Clips], inputs: &[Input], options: &Options) -> Vec<(u32, Report)> {
    if options.voices.locales().nth(1).is_none() {
        return Vec::new();
    }
    let places: HashMap<&str, usize> = inputs.iter().map(|input| input.key.as_str()).zip(0..).collect();
    let clips = Clips::by_key(batches);
    let clip = |key: &str| Some(&clips[clips.binary_search_by(|clip| clip.key().cmp(key)).ok()?]);
    let mut found = Vec::new();
    for (index, dub) in inputs.iter().enumerate() {
        let Some(line) = options.voices.dubbed_line(&dub.key) else { continue };
        let original = options.voices.original_of(&dub.key, |key| places.contains_key(key));
        let report = match original.and_then(|original| inputs.get(*places.get(original.as_str())?)) {
            None => Some(Report::about(dub.name(), without_original(dub, line, options))),
            Some(original) => match (clip(&dub.key), clip(&original.key)) {
                (Some(one), Some(other)) => differing(one, other, dub, original, options),
                _ => None, // one of the two has errors
            },
        };
        let Some(mut report) = report else { continue };
        options.levels.apply(&mut report.diagnostics);
        if !report.diagnostics.is_empty() {
            found.push((index as u32, report));
        }
    }
    found
}

fn without_original(dub: &Input, line: &str, options: &Options) -> Diagnostic {
    let (locale, _) = options.voices.of_key(&dub.key).unwrap_or_default();
    let wanted = options.voices.originals_of(line);
    let wanted: Vec<String> = wanted.iter().map(|key| format!("`{}`", escape::text(key))).collect();
    let message =
        format!("the clip is the dub of a line in `{locale}`, but there is no original: {}", wanted.join(" or "));
    Diagnostic::new(Code::DubWithoutOriginal, message).help(
        "add the original, rename the dub, or correct the pattern in [voices]: a game asks for dubs by their originals",
    )
}

/// Reports other segments, or else texts that contradict those of the original.
fn differing(one: &Clip<'_>, other: &Clip<'_>, dub: &Input, original: &Input, options: &Options) -> Option<Report> {
    let counts = (one.starts().len(), other.starts().len());
    let texts: Vec<&str> = if counts.0 == counts.1 { contradicting(one, other) } else { Vec::new() };
    if counts.0 == counts.1 && texts.is_empty() {
        return None;
    }
    // Read once more: clips have no places, and few dubs get here.
    let (dub_bytes, original_bytes) = (bytes_of(dub)?, bytes_of(original)?);
    let parsed = (lipz_file::parse(&dub_bytes).document, lipz_file::parse(&original_bytes).document);
    let (Some(dub_document), Some(original_document)) = parsed else { return None };
    let place = |span: Span| {
        let source =
            Source::new(original.name(), String::from_utf8_lossy(lipz_file::without_byte_order_mark(&original_bytes)));
        let at = source.line_column(span.start);
        format!("{}:{}:{}", escape::text(&source.path), at.line, at.column)
    };
    let mut diagnostics = Vec::new();
    if counts.0 != counts.1 {
        let count = |count: usize| if count == 1 { "1 segment".to_owned() } else { format!("{count} segments") };
        let message = format!("the dub has {}, but its original has {}", count(counts.0), counts.1);
        let (own, theirs) = (divided(&dub_document), divided(&original_document));
        let diagnostic = match own {
            Some(own) => Diagnostic::at(Code::DubSegments, own.span(), message).label(count(counts.0)),
            None => Diagnostic::new(Code::DubSegments, message),
        };
        let at = theirs.map_or_else(|| original.name(), |theirs| place(theirs.span()));
        let shown = theirs.map(|theirs| format!(": {}", escape::quoted(&theirs.text))).unwrap_or_default();
        diagnostics.push(diagnostic.note(format!("the original has {} at {at}{shown}", count(counts.1))).help(
            "put a `|` into the dub where each segment of the original starts: texts and events of both belong together",
        ));
    }
    for tag in texts {
        let (Some(own), Some(theirs)) =
            (text_in(&dub_document, tag, options), text_in(&original_document, tag, options))
        else {
            continue; // a pseudo-locale, or a locale that is not packed
        };
        let message = format!("the dub has another text in `{tag}` than its original");
        let note = format!("the original says {} at {}", escape::quoted(&theirs.text), place(theirs.span()));
        diagnostics.push(Diagnostic::at(Code::DubText, own.span(), message).note(note).help(
            "remove the text from the dub, which then has that of the original; or allow the lint if both are meant",
        ));
    }
    Some(Report::from_bytes(dub.name(), &dub_bytes, diagnostics))
}

/// The locales in which both have a text, and not the same.
fn contradicting<'c>(dub: &Clip<'c>, original: &Clip<'_>) -> Vec<&'c str> {
    let own = dub.texts().iter().filter(|text| !text.is_fallback());
    let differs = |tag: &str, whole: &[u8]| {
        let mut theirs = original.texts().iter().filter(|text| !text.is_fallback());
        theirs.find(|text| original.tag(text) == tag).is_some_and(|text| original.whole_run(text) != whole)
    };
    own.filter(|text| differs(dub.tag(text), dub.whole_run(text))).map(|text| dub.tag(text)).collect()
}

fn bytes_of(input: &Input) -> Option<Cow<'_, [u8]>> {
    match &input.content {
        Content::Bytes { bytes, .. } => Some(Cow::Borrowed(bytes)),
        Content::File(path) => fs::read(path).ok().map(Cow::Owned),
    }
}

/// The element that says how many segments a clip has.
fn divided<'d>(document: &'d Document<'d>) -> Option<&'d JsonString<'d>> {
    let string = |is_meant: fn(&str) -> bool| string_where(document, is_meant);
    string(|name| name == "visemes")
        .or_else(|| string(|name| text_name(name).is_some()))
        .or_else(|| string(|name| name == "events"))
}

/// The text in a locale.
fn text_in<'d>(document: &'d Document<'d>, tag: &str, options: &Options) -> Option<&'d JsonString<'d>> {
    let default = options.default_locale.as_deref();
    string_where(document, |name| match text_name(name) {
        Some(TextName::Canonical(own) | TextName::Misspelt(own) | TextName::OtherShape(_, Some(own))) => own == tag,
        Some(TextName::NoLocale) => default == Some(tag),
        Some(TextName::OtherShape(_, None)) | None => false,
    })
}

/// The first string element whose name is meant.
fn string_where<'d>(document: &'d Document<'d>, is_meant: impl Fn(&str) -> bool) -> Option<&'d JsonString<'d>> {
    document.elements.iter().find(|element| is_meant(&element.name.text)).and_then(|element| match &element.value {
        Value::String(string) => Some(string),
        _ => None,
    })
}
