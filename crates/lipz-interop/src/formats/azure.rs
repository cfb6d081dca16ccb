//! Azure visemes: events with an audio offset in ticks of 100 ns and a viseme id from 0 to 21 (those of
//! Microsoft's SAPI). Programs store them as they like: the spellings of their SDKs are read, as a bare array
//! or below `visemes` or `events`.

use super::Format;
use crate::json::{self, Node};
use crate::{ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::Diagnostic;

/// Ticks of a second.
const TICKS: u32 = 10_000_000;
/// How the SDKs spell the two members; the case of letters makes no difference.
const OFFSET: &[&str] = &["audio_offset", "audioOffset", "offset"];
const ID: &[&str] = &["viseme_id", "visemeId", "id"];
/// Where events stand below an object.
const LISTS: &[&str] = &["visemes", "events"];

pub(super) const FORMAT: Format = Format {
    name: "azure",
    about: "Azure (and SAPI) viseme events, JSON",
    extension: "json",
    examples: &["lipz import azure speech/*.json -o voices"],
    maps: &["azure"],
    is_binary: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, findings: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(root) = source::text(bytes, findings).and_then(|text| json::root(text, findings)) else {
        return Vec::new();
    };
    let list = if root.is_object() { root.get(LISTS) } else { Some(root) };
    let Some(events) = list.and_then(Node::items) else {
        let what = "a list of viseme events, \"visemes\" or \"events\",";
        findings.push(if root.get(&["BlendShapes"]).is_some() {
            root.lacks(what).help("these are blend shapes, which have no mouth shapes: ask the service for viseme ids")
        } else {
            root.lacks(what)
        });
        return Vec::new();
    };
    let mut track = Track::default();
    for event in events {
        let (Some(offset), Some(id)) = (event.get(OFFSET), event.get(ID)) else {
            findings.push(event.lacks("an audio offset or a viseme id"));
            continue;
        };
        let Some(start) = offset.number().and_then(|ticks| ticks.parse().ok()) else {
            findings.push(offset.not("a number of ticks of 100 ns"));
            continue;
        };
        match id.number() {
            Some(symbol) => track.shapes.push(Shape::at(id.span(), Time::new(start, TICKS), symbol)),
            None => findings.push(id.not("a viseme id, a number from 0 to 21")),
        }
    }
    if track.shapes.len() > 1 && track.shapes.last().is_some_and(|last| last.symbol == "0") {
        track.end = track.shapes.pop().map(|last| last.start);
    }
    vec![track]
}
