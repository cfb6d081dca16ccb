//! Amazon Polly speech marks: one JSON object per line, with milliseconds. Visemes have only a start; marks of words
//! and sentences contain their times.

use super::Format;
use crate::json::{self, Node};
use crate::source::{self, Line};
use crate::{ImportOptions, Shape, Text, Time, TimedText, Track};
use lipz_diagnostics::{Diagnostic, escape};
use lipz_file::text::is_white_space;

/// The characters that SSML escapes, `&amp;` last.
const ENTITIES: [(&str, &str); 5] = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];

pub(super) const FORMAT: Format = Format {
    name: "polly",
    about: "Amazon Polly speech marks",
    extension: "marks",
    maps: &["polly", "polly-languages"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let mut track = Track::default();
    // Some programs store the marks as one array.
    let array =
        text.trim_start().starts_with('[').then(|| json::root(text, diagnostics).and_then(Node::items)).flatten();
    if let Some(marks) = array {
        marks.into_iter().for_each(|mark| add(mark, &mut track, diagnostics));
        return vec![finished(track)];
    }
    for line in source::lines(text).filter(|line| !line.text.trim().is_empty()) {
        // Each line is a JSON text, with positions relative to the line.
        let mut found = Vec::new();
        let mark = json::root(line.text, &mut found)
            .map(|root| Node { line: Line { at: line.at + root.line.at, ..root.line } });
        if mark.is_none() {
            let is_last = line.at + line.text.len() >= text.trim_end().len();
            diagnostics.push(match found.pop() {
                Some(diagnostic) if diagnostic.code == lipz_diagnostics::Code::ForeignCutOff && is_last => {
                    source::cut_off(text, "the last speech mark is not complete")
                }
                _ => line.not("a speech mark, a JSON object on a line"),
            });
            continue;
        }
        if let Some(mark) = mark {
            add(mark, &mut track, diagnostics);
        }
    }
    vec![finished(track)]
}

/// Returns the track with the text of its sentences, up to the silence at its end.
fn finished(mut track: Track) -> Track {
    let sentences: Vec<&str> = track.phrases.iter().map(|phrase| phrase.text.as_str()).collect();
    if !sentences.is_empty() {
        track.texts.push(Text { locale: None, text: sentences.join(" ") });
    }
    // The last viseme is the silence after the voice.
    if track.shapes.len() > 1 && track.shapes.last().is_some_and(|last| last.symbol == "sil") {
        track.end = track.shapes.pop().map(|last| last.start);
    }
    track
}

/// Returns the sentence as spoken: without SSML tags, and with its escapes resolved.
fn spoken(sentence: &str) -> String {
    let mut text = String::with_capacity(sentence.len());
    let mut rest = sentence;
    while let Some((before, tag)) = rest.split_once('<') {
        let Some((_, after)) = tag.split_once('>') else { break };
        text.push_str(before);
        rest = after;
    }
    text.push_str(rest);
    let text = ENTITIES.iter().fold(text, |text, (entity, character)| text.replace(entity, character));
    text.split(is_white_space).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

fn add(mark: Node<'_>, track: &mut Track, diagnostics: &mut Vec<Diagnostic>) {
    let mut member = |name: &str| {
        let found = mark.get(&[name]);
        if found.is_none() {
            diagnostics.push(mark.lacks(&format!("\"{name}\"")));
        }
        found
    };
    let (Some(time), Some(kind), Some(value)) = (member("time"), member("type"), member("value")) else { return };
    let Some(start) = time.number().and_then(|ms| ms.parse().ok()).map(|ms| Time::new(ms, 1000)) else {
        diagnostics.push(time.not("a time in milliseconds"));
        return;
    };
    let Some(text) = value.string() else {
        diagnostics.push(value.not("a text"));
        return;
    };
    match kind.string().as_deref() {
        Some("viseme") => track.shapes.push(Shape::at(value.span(), start, text)),
        Some("word") => track.words.push(TimedText { start, text }),
        Some("sentence") => track.phrases.push(TimedText { start, text: spoken(&text) }),
        // Its name only matters to the program that requested it: `<mark name="wave"/>`.
        Some("ssml") => track.remarks.push(format!("the mark {} at {start} is left out", escape::quoted(&text))),
        _ => diagnostics.push(kind.not("a type of speech mark: viseme, word, sentence or ssml")),
    }
}
