//! Rhubarb Lip Sync, `-f json`: `mouthCues` with `start`, `end` and `value`. Files in the wild also contain times as
//! strings, a bare array without `metadata`, and gaps, in which the mouth rests.

use super::Format;
use super::rhubarb::{self, Cue};
use crate::json::{self, Node};
use crate::{ImportOptions, Time, Track, source};
use lipz_diagnostics::Diagnostic;
use std::fmt::Write;

pub(super) const FORMAT: Format = Format {
    name: "rhubarb-json",
    about: "Rhubarb Lip Sync, JSON (-f json)",
    extension: "json",
    maps: rhubarb::MAPS,
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(root) = source::text(bytes, diagnostics).and_then(|text| json::root(text, diagnostics)) else {
        return Vec::new();
    };
    let list = if root.is_object() { root.get(&["mouthCues"]) } else { Some(root) };
    let Some(items) = list.and_then(Node::items) else {
        diagnostics.push(root.lacks("\"mouthCues\", a list of mouth shapes,"));
        return Vec::new();
    };
    let duration = root.get(&["metadata"]).and_then(|metadata| metadata.get(&["duration"]));
    let duration = duration.and_then(|node| time(node, diagnostics));
    let cues = items.into_iter().filter_map(|item| cue(item, diagnostics)).collect();
    vec![rhubarb::track(cues, duration)]
}

fn cue(item: Node<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Cue> {
    let mut member = |name: &str| {
        let found = item.get(&[name]);
        if found.is_none() {
            diagnostics.push(item.lacks(&format!("\"{name}\"")));
        }
        found
    };
    let (start, end, value) = (member("start")?, member("end")?, member("value")?);
    let Some(symbol) = value.string() else {
        diagnostics.push(value.not("a mouth shape, such as \"A\""));
        return None;
    };
    Some(Cue { start: time(start, diagnostics)?, end: time(end, diagnostics)?, symbol, span: value.span() })
}

fn time(node: Node<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Time> {
    let time = node.number().and_then(|digits| Time::parse(&digits));
    if time.is_none() {
        diagnostics.push(node.not("a time in seconds"));
    }
    time
}

fn write(track: &Track, _: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut text = String::from("{\n  \"metadata\": {\n    \"soundFile\": \"\",\n");
    let _ = writeln!(text, "    \"duration\": {}\n  }},\n  \"mouthCues\": [", rhubarb::seconds(rhubarb::end(track)));
    let rows: Vec<String> = rhubarb::spans(track)
        .into_iter()
        .map(|(start, end, symbol)| {
            let value = lipz_file::literal(symbol);
            format!("    {{ \"start\": {start}, \"end\": {end}, \"value\": {value} }}")
        })
        .collect();
    let _ = writeln!(text, "{}\n  ]\n}}", rows.join(",\n"));
    text.into_bytes()
}
