//! Papagayo-NG project, `.pg2`: JSON version 2 with the same voices, phrases, words and phonemes as `.pgo`.

use super::Format;
use super::papagayo::{MAPS, Voice};
use crate::json::{self, Node};
use crate::{ImportOptions, Shape, Time, Timed, Track, source};
use lipz_diagnostics::Diagnostic;
use lipz_file::rate::Rate;

pub(super) const FORMAT: Format = Format {
    name: "papagayo-ng",
    about: "Papagayo-NG project, .pg2",
    extension: "pg2",
    maps: MAPS,
    is_binary: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, findings: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(root) = source::text(bytes, findings).and_then(|text| json::root(text, findings)) else {
        return Vec::new();
    };
    project(root, findings).unwrap_or_default()
}

fn project(root: Node<'_>, findings: &mut Vec<Diagnostic>) -> Option<Vec<Track>> {
    let fps = member(root, "fps", findings)?;
    let Some(rate) = fps.number().and_then(|digits| lipz_file::rate::parse(&digits)) else {
        findings.push(fps.not("a frame rate from 1 to 1000"));
        return None;
    };
    let duration = frame(root, "sound_duration", findings)?;
    let mut tracks = Vec::new();
    for voice in list(root, "voices", findings)? {
        let mut voice = self::voice(voice, rate, findings)?;
        voice.end(duration);
        tracks.push(voice.track);
    }
    Some(tracks)
}

fn voice(node: Node<'_>, rate: Rate, findings: &mut Vec<Diagnostic>) -> Option<Voice> {
    let name = text(node, "name", findings)?;
    // JSON keeps the line breaks that .pgo writes as `|`.
    let said = text(node, "text", findings)?.trim_end().replace('\n', "|");
    let mut voice = Voice::new(name, &said, rate);
    for phrase in list(node, "phrases", findings)? {
        let start = Time::of_frame(frame(phrase, "start_frame", findings)?, rate);
        voice.track.phrases.push(Timed { start, text: text(phrase, "text", findings)? });
        for word in list(phrase, "words", findings)? {
            voice.word(&text(word, "text", findings)?, frame(word, "start_frame", findings)?);
            for phoneme in list(word, "phonemes", findings)? {
                let at = frame(phoneme, "frame", findings)?;
                let place = member(phoneme, "text", findings)?.span();
                let symbol = text(phoneme, "text", findings)?;
                voice.phoneme(at, |start| Shape::at(place, start, symbol));
            }
            voice.end_word(frame(word, "end_frame", findings)?);
        }
    }
    Some(voice)
}

fn member<'s>(node: Node<'s>, name: &str, findings: &mut Vec<Diagnostic>) -> Option<Node<'s>> {
    let found = node.get(&[name]);
    if found.is_none() {
        findings.push(node.lacks(&format!("\"{name}\"")));
    }
    found
}

fn text(node: Node<'_>, name: &str, findings: &mut Vec<Diagnostic>) -> Option<String> {
    let member = member(node, name, findings)?;
    let text = member.string();
    if text.is_none() {
        findings.push(member.not("a text"));
    }
    text
}

fn list<'s>(node: Node<'s>, name: &str, findings: &mut Vec<Diagnostic>) -> Option<Vec<Node<'s>>> {
    let member = member(node, name, findings)?;
    let items = member.items();
    if items.is_none() {
        findings.push(member.not("a list"));
    }
    items
}

/// The number of a frame; old versions write it with a point.
fn frame(node: Node<'_>, name: &str, findings: &mut Vec<Diagnostic>) -> Option<u64> {
    let member = member(node, name, findings)?;
    let frame = member.number().and_then(|digits| Some(Time::parse(&digits)?.in_units(1)));
    if frame.is_none() {
        findings.push(member.not("the number of a frame"));
    }
    frame
}
