//! Phones of Annosoft's Lipsync Tool, text: `phn START END WEIGHT PHONEME` in milliseconds. A transcript may come first,
//! between marks.

use super::Format;
use crate::source;
use crate::{ImportOptions, Shape, Text, Time, TimedText, Track};
use lipz_diagnostics::{Code, Diagnostic};

/// The marks around the transcript.
const TEXT_BEGIN: &str = "%%-begin-anno-text-%%";
const TEXT_END: &str = "%%-end-anno-text-%%";
/// The lines of a phone and of a word.
const PHONE: &str = "phn";
const WORD: &str = "word";
/// The label of silence in the files, and in the mapping table.
const SILENCE: &str = "x";
const REST: &str = "rest";

pub(super) const FORMAT: Format = Format {
    name: "annosoft",
    about: "Annosoft phones, .anno",
    extension: "anno",
    maps: &["cmu"],
    is_binary: false,
    is_legacy: true,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut track = Track::default();
    let (mut is_text, mut said) = (false, Vec::new());
    for line in source::lines(text).map(source::Line::trimmed) {
        match line.text {
            TEXT_BEGIN => is_text = true,
            TEXT_END => is_text = false,
            _ if is_text => said.push(line.text),
            "" => {}
            // Settings of the tool.
            comment if comment.starts_with("%%") => {}
            _ => entry(line, &mut track, diagnostics),
        }
    }
    if is_text {
        diagnostics.push(source::cut_off(text, "the transcript does not end"));
    }
    let said = said.join(" ");
    if !said.trim().is_empty() {
        track.texts.push(Text { locale: None, text: said.trim().to_owned() });
    }
    vec![track]
}

/// Reads the line of a phone or a word.
fn entry(line: source::Line<'_>, track: &mut Track, diagnostics: &mut Vec<Diagnostic>) {
    let fields: Vec<_> = line.fields().collect();
    let [kind, start, end, weight, rest @ ..] = fields.as_slice() else {
        return diagnostics.push(line.not("a phone, such as `phn 0 120 100 AA`"));
    };
    let Some(label) = rest.first().filter(|_| matches!(kind.text, PHONE | WORD)) else {
        return diagnostics.push(line.not("a phone, such as `phn 0 120 100 AA`"));
    };
    let mut ms = |field: source::Line<'_>| Some(Time::new(field.number("a time in milliseconds", diagnostics)?, 1000));
    let (Some(start_time), Some(end_time)) = (ms(*start), ms(*end)) else { return };
    if end_time < start_time {
        return diagnostics.push(end.diagnostic(Code::ForeignValue, "the phone ends before it starts"));
    }
    if weight.text.parse::<f64>().is_err() {
        return diagnostics.push(weight.not("a weight from 0 to 100"));
    }
    if kind.text == WORD {
        let text = rest.iter().map(|part| part.text).collect::<Vec<_>>().join(" ");
        return track.words.push(TimedText { start: start_time, text });
    }
    // The mouth rests in gaps.
    if let Some(gap) = track.end.filter(|gap| *gap < start_time) {
        track.shapes.push(Shape::at(label.span(), gap, REST));
    }
    let symbol = if label.text.eq_ignore_ascii_case(SILENCE) { REST } else { label.text };
    track.shapes.push(Shape::at(label.span(), start_time, symbol));
    track.end = track.end.max(Some(end_time));
}
