//! JSON with all exchanged data, for programs. `docs/lipz-texts.schema.json` describes it.

use crate::exchange::entry::{Entry, IncomingFile, ReadOptions, Words};
use crate::exchange::model::{Exchange, Segment, State, Translation, Unit};
use crate::exchange::{Mark, decode};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The value of `format`.
const FORMAT: &str = "lipz-texts";

/// The version that is written, and the latest that can be read.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct FileOut<'a> {
    format: &'a str,
    version: u32,
    source_locale: &'a str,
    locales: &'a [String],
    clips: Vec<ClipOut<'a>>,
}

#[derive(Serialize)]
struct ClipOut<'a> {
    key: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    recording: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<&'a str>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    comments: BTreeMap<&'a str, CommentsOut<'a>>,
    segments: Vec<SegmentOut<'a>>,
}

#[derive(Serialize)]
struct CommentsOut<'a> {
    lines: &'a [String],
    exported: String,
}

#[derive(Serialize)]
struct SegmentOut<'a> {
    source: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    speaker: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    events: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start_ms: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    end_ms: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_characters: Option<usize>,
    translations: BTreeMap<&'a str, TranslationOut<'a>>,
}

#[derive(Serialize)]
struct TranslationOut<'a> {
    text: &'a str,
    state: &'a str,
    exported: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    made_from: Option<&'a str>,
}

/// Returns the file with all locales.
pub(crate) fn write(exchange: &Exchange) -> Vec<u8> {
    let file = FileOut {
        format: FORMAT,
        version: VERSION,
        source_locale: &exchange.source_locale,
        locales: &exchange.locales,
        clips: exchange.units.iter().map(|unit| ClipOut::new(unit, &exchange.locales)).collect(),
    };
    // Serialising strings and numbers to memory cannot fail.
    let mut bytes = serde_json::to_vec_pretty(&file).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

impl<'a> ClipOut<'a> {
    fn new(unit: &'a Unit, locales: &'a [String]) -> ClipOut<'a> {
        ClipOut {
            key: unit.id(),
            file: unit.file.as_deref(),
            recording: unit.recording.as_deref(),
            note: unit.note.as_deref(),
            comments: comments(unit, locales),
            segments: (0..)
                .zip(&unit.segments)
                .map(|(at, segment)| SegmentOut::new(at, segment, unit, locales))
                .collect(),
        }
    }
}

/// Returns the comments of translators by locale.
fn comments<'a>(unit: &'a Unit, locales: &'a [String]) -> BTreeMap<&'a str, CommentsOut<'a>> {
    let all = locales.iter().zip(&unit.translations).filter(|(_, translation)| !translation.comments.is_empty());
    all.map(|(locale, translation)| {
        let lines = translation.comments.as_slice();
        (locale.as_str(), CommentsOut { lines, exported: Mark::of_comments(lines).to_string() })
    })
    .collect()
}

impl<'a> SegmentOut<'a> {
    fn new(at: usize, segment: &'a Segment, unit: &'a Unit, locales: &'a [String]) -> SegmentOut<'a> {
        let translations = locales.iter().zip(&unit.translations);
        SegmentOut {
            source: &segment.source,
            speaker: segment.speaker.as_deref(),
            events: segment.events.as_deref(),
            start_ms: segment.time_ms.map(|(start, _)| start),
            end_ms: segment.time_ms.map(|(_, end)| end),
            max_characters: segment.max_characters,
            translations: translations
                .filter(|(_, translation)| !translation.is_unneeded)
                .map(|(locale, translation)| (locale.as_str(), TranslationOut::new(at, segment, translation)))
                .collect(),
        }
    }
}

impl<'a> TranslationOut<'a> {
    fn new(at: usize, segment: &Segment, translation: &'a Translation) -> TranslationOut<'a> {
        let text = translation.texts.get(at).map_or("", String::as_str);
        let made_from = translation.made_from_at(at, &segment.source);
        let is_open = text.is_empty() || made_from.is_some();
        let state = if is_open { State::Initial } else { translation.state }.name();
        TranslationOut { text, state, exported: Mark::of(text).to_string(), made_from }
    }
}

/// The parts of a file that are read. The rest is for people.
#[derive(Deserialize)]
struct FileIn<'a> {
    format: String,
    version: u32,
    #[serde(borrow)]
    clips: Vec<ClipIn<'a>>,
}

#[derive(Deserialize)]
struct ClipIn<'a> {
    #[serde(borrow)]
    key: &'a RawValue,
    #[serde(default)]
    comments: BTreeMap<String, CommentsIn>,
    #[serde(borrow)]
    segments: Vec<SegmentIn<'a>>,
}

#[derive(Deserialize)]
struct CommentsIn {
    lines: Vec<String>,
    exported: Option<String>,
}

#[derive(Deserialize)]
struct SegmentIn<'a> {
    #[serde(borrow)]
    source: &'a RawValue,
    #[serde(borrow, default)]
    translations: BTreeMap<String, TranslationIn<'a>>,
}

#[derive(Deserialize)]
struct TranslationIn<'a> {
    #[serde(borrow)]
    text: &'a RawValue,
    state: Option<String>,
    exported: Option<String>,
}

/// Reads a file with arbitrary content.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) {
    let Some(text) = decode::text(bytes, None, &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    match serde_json::from_str::<FileIn<'_>>(&text) {
        Ok(file) if file.format == FORMAT && file.version == VERSION => clips(&file, &text, options, incoming),
        Ok(file) => {
            let (format, version) = (escape::quoted(&file.format), file.version);
            let message = format!("the format is {format} version {version}, not `{FORMAT}` version {VERSION}");
            incoming.diagnostics.push(Diagnostic::new(Code::ExchangeSyntax, message));
        }
        Err(error) => incoming.diagnostics.push(mistake(&text, &error)),
    }
    incoming.text = text.into_owned();
}

/// Returns the diagnostic for a text that is not JSON, or not in this format.
fn mistake(text: &str, error: &serde_json::Error) -> Diagnostic {
    let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    // serde_json counts columns in bytes, from 1.
    let at = text.floor_char_boundary((before + error.column().saturating_sub(1)).min(text.len()));
    let length = text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    let message = error.to_string();
    let what = message.split(" at line ").next().unwrap_or(&message);
    let message = format!("the file cannot be read: {}", escape::text(what));
    Diagnostic::at(Code::ExchangeSyntax, Span::new(at, at + length), message)
        .help("correct the file; docs/lipz-texts.schema.json describes the format")
}

fn clips(file: &FileIn<'_>, text: &str, options: &ReadOptions, incoming: &mut IncomingFile) {
    for clip in &file.clips {
        let Some(key) = string(clip.key, text, &mut incoming.diagnostics) else { continue };
        let key = Arc::new(key);
        for (number, segment) in (1..).zip(&clip.segments) {
            let Some(source) = string(segment.source, text, &mut incoming.diagnostics) else { continue };
            let source = Arc::new(source);
            for (tag, translation) in &segment.translations {
                let Some(text) = string(translation.text, text, &mut incoming.diagnostics) else { continue };
                let locale = match options.locale(tag) {
                    Ok(locale) => locale.into(),
                    Err(why) => {
                        incoming.diagnostics.push(why.diagnostic(tag, text.span));
                        continue;
                    }
                };
                let comments = clip.comments.get(tag);
                let lines = comments.into_iter().flat_map(|comments| &comments.lines).flat_map(|line| line.lines());
                let state = translation.state.as_deref().and_then(State::from_name).unwrap_or(State::Translated);
                incoming.entries.push(Entry {
                    key: Arc::clone(&key),
                    segment: Some(number),
                    segment_count: Some(clip.segments.len()),
                    source: Some(Arc::clone(&source)),
                    locale,
                    state: if text.text.is_empty() { State::Initial } else { state },
                    says_state: translation.state.is_some(),
                    text,
                    mark: translation.exported.as_deref().and_then(|mark| mark.parse().ok()),
                    comments: lines.filter(|line| !line.trim().is_empty()).map(str::to_owned).collect(),
                    comments_mark: comments.and_then(|comments| comments.exported.as_ref()?.parse().ok()),
                    ..Entry::default()
                });
            }
        }
    }
}

/// Returns a string, and its position between the quotes.
fn string(raw: &RawValue, text: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Words> {
    let start = (raw.get().as_ptr() as usize).wrapping_sub(text.as_ptr() as usize);
    let end = start + raw.get().len();
    match serde_json::from_str(raw.get()) {
        Ok(text) => Some(Words { text, span: Span::new(start + 1, end - 1) }),
        Err(_) => {
            diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, Span::new(start, end), "a text must be a string"));
            None
        }
    }
}
