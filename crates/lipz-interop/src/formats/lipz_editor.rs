//! JSON of the Lipz author's first editor. It resembles Lipz files, but has `visemeType`, stores frame rate and type in
//! a nested `source`, joins several objects with commas, and lacks the `|` of the texts in the visemes.

use super::Format;
use crate::json::{self, Node};
use crate::{DEFAULT_RATE, ImportOptions, Shape, Text, Time, TimedText, Track, source};
use lipz_diagnostics::{Code, Diagnostic, Span};
use lipz_file::locale::text_name;
use lipz_file::rate::Rate;
use lipz_file::text::DELIMITER;
use lipz_file::{Element, JsonString, Value};
use lipz_types::VisemeType;
use std::borrow::Cow;

pub(super) const FORMAT: Format = Format {
    name: "lipz-editor",
    about: "the Lipz author's first editor, JSON",
    extension: "json",
    maps: &["blair", "toonboom", "rms"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    let objects = json::joined(text, diagnostics);
    let numbered = objects.into_iter().zip(1_usize..);
    numbered.filter_map(|(object, number)| track(object, number, diagnostics)).collect()
}

fn track(object: Node<'_>, number: usize, diagnostics: &mut Vec<Diagnostic>) -> Option<Track> {
    if !object.is_object() {
        diagnostics.push(object.not("an object with \"visemes\" and texts"));
        return None;
    }
    let rate = rate(object, diagnostics).unwrap_or(DEFAULT_RATE);
    let mut track = Track { name: Some(number.to_string()), rate: Some(rate), ..Track::default() };
    track.map = viseme_type(object, diagnostics).map(VisemeType::name);
    let visemes = object.get(&["visemes"]).and_then(|node| Some((node, node.string()?)));
    if let Some((node, visemes)) = visemes {
        shapes(node.span(), &visemes, rate, &mut track);
    }
    for (name, node) in object.members() {
        let locale = match text_name(&name) {
            Some(text) => text.tag(),
            None => {
                other(&name, node, &mut track, diagnostics);
                continue;
            }
        };
        match node.string() {
            Some(text) => track.texts.push(Text { locale, text }),
            None => diagnostics.push(node.not("a text")),
        }
    }
    Some(track)
}

/// Returns the member of the object, or of its `source`.
fn of_clip<'s>(object: Node<'s>, names: &[&str]) -> Option<Node<'s>> {
    object.get(names).or_else(|| object.get(&["source"])?.get(names))
}

fn rate(object: Node<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Rate> {
    let fps = of_clip(object, &["fps"])?;
    let rate = fps.number().and_then(|digits| lipz_file::rate::parse(&digits));
    if rate.is_none() {
        diagnostics.push(fps.not("a frame rate from 1 to 1000"));
    }
    rate
}

fn viseme_type(object: Node<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<VisemeType> {
    let named = of_clip(object, &["viseme_type", "visemeType"])?;
    let found = named.string().and_then(|name| name.to_ascii_lowercase().parse().ok());
    if found.is_none() {
        diagnostics.push(named.not("a viseme type: blair, toonboom or rms"));
    }
    found
}

/// Adds a shape for each code, and a phrase for each segment of the visemes, if they have segments.
fn shapes(place: Span, visemes: &str, rate: Rate, track: &mut Track) {
    let mut frame = 0;
    let mut segments = vec![Time::ZERO];
    for c in visemes.chars().filter(|c| !c.is_whitespace()) {
        let start = Time::of_frame(frame, rate);
        if c == DELIMITER {
            segments.push(start);
        } else {
            track.shapes.push(Shape::at(place, start, c.to_string()));
            frame += 1;
        }
    }
    if segments.len() > 1 {
        track.phrases = segments.into_iter().map(|start| TimedText { start, text: String::new() }).collect();
    }
    track.end = Some(Time::of_frame(frame, rate));
}

/// Adds events. A Lipz file cannot store the editor's other members.
fn other(name: &str, node: Node<'_>, track: &mut Track, diagnostics: &mut Vec<Diagnostic>) {
    let string = |text: String| JsonString::from(Cow::<'static, str>::Owned(text));
    match name {
        "visemes" | "fps" | "viseme_type" | "visemeType" => {}
        "events" => {
            if track.elements.iter().any(|element| element.name.text == name) {
                diagnostics.push(Diagnostic::at(Code::DuplicateElement, node.span(), "the file has events twice"));
            } else if let Some(events) = node.string() {
                track.elements.push(Element { name: string(name.to_owned()), value: Value::String(string(events)) });
            }
        }
        _ => {
            let message = format!("{} is left out", lipz_diagnostics::escape::quoted(name));
            let diagnostic = Diagnostic::at(Code::ForeignOddity, node.span(), message);
            diagnostics.push(diagnostic.note("Lipz files cannot store it; its frame rate and viseme type are used"));
        }
    }
}
