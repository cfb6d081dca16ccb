//! Papagayo-NG project, `.pg2`: JSON version 2, with the same voices, phrases, words and phonemes as `.pgo`.

use super::Format;
use super::papagayo::{MAPS, PapagayoVoice, with_table};
use crate::json::{self, Node};
use crate::{ImportOptions, Shape, Time, TimedText, Track, source};
use lipz_diagnostics::Diagnostic;
use lipz_file::rate::Rate;

pub(super) const FORMAT: Format = Format {
    name: "papagayo-ng",
    about: "Papagayo-NG project, .pg2",
    extension: "pg2",
    maps: MAPS,
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], options: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(root) = source::text(bytes, diagnostics).and_then(|text| json::root(text, diagnostics)) else {
        return Vec::new();
    };
    let set = root.get(&["phoneme_set"]).and_then(Node::string);
    with_table(project(root, diagnostics).unwrap_or_default(), set.as_deref(), options)
}

fn project(root: Node<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Track>> {
    let fps = member(root, "fps", diagnostics)?;
    let Some(rate) = fps.number().and_then(|digits| lipz_file::rate::parse(&digits)) else {
        diagnostics.push(fps.not("a frame rate from 1 to 1000"));
        return None;
    };
    let duration = frame(root, "sound_duration", diagnostics)?;
    let mut tracks = Vec::new();
    for voice in list(root, "voices", diagnostics)? {
        let mut voice = self::voice(voice, rate, diagnostics)?;
        voice.end(duration);
        tracks.push(voice.track);
    }
    Some(tracks)
}

fn voice(node: Node<'_>, rate: Rate, diagnostics: &mut Vec<Diagnostic>) -> Option<PapagayoVoice> {
    let name = text(node, "name", diagnostics)?;
    // JSON keeps line breaks, which .pgo stores as `|`.
    let said = text(node, "text", diagnostics)?.trim_end().replace('\n', "|");
    let mut voice = PapagayoVoice::new(name, &said, rate);
    for phrase in list(node, "phrases", diagnostics)? {
        let start = Time::of_frame(frame(phrase, "start_frame", diagnostics)?, rate);
        voice.track.phrases.push(TimedText { start, text: text(phrase, "text", diagnostics)? });
        for word in list(phrase, "words", diagnostics)? {
            voice.word(&text(word, "text", diagnostics)?, frame(word, "start_frame", diagnostics)?);
            for phoneme in list(word, "phonemes", diagnostics)? {
                let at = frame(phoneme, "frame", diagnostics)?;
                let place = member(phoneme, "text", diagnostics)?.span();
                let symbol = text(phoneme, "text", diagnostics)?;
                voice.phoneme(at, |start| Shape::at(place, start, symbol));
            }
            voice.end_word(frame(word, "end_frame", diagnostics)?);
        }
    }
    Some(voice)
}

fn member<'s>(node: Node<'s>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Node<'s>> {
    let found = node.get(&[name]);
    if found.is_none() {
        diagnostics.push(node.lacks(&format!("\"{name}\"")));
    }
    found
}

fn text(node: Node<'_>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
    let member = member(node, name, diagnostics)?;
    let text = member.string();
    if text.is_none() {
        diagnostics.push(member.not("a text"));
    }
    text
}

fn list<'s>(node: Node<'s>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Node<'s>>> {
    let member = member(node, name, diagnostics)?;
    let items = member.items();
    if items.is_none() {
        diagnostics.push(member.not("a list"));
    }
    items
}

/// Reads the number of a frame, which old versions write with a decimal point.
fn frame(node: Node<'_>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<u64> {
    let member = member(node, name, diagnostics)?;
    let frame = member.number().and_then(|digits| Some(Time::parse(&digits)?.in_units(1)));
    if frame.is_none() {
        diagnostics.push(member.not("a frame number"));
    }
    frame
}
