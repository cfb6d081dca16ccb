//! Azure visemes: events with an audio offset and a viseme ID from 0 to 21 (the IDs of Microsoft's SAPI).
//!
//! The service uses ticks of 100 ns; most programs store milliseconds, as Microsoft's samples print them. Both units
//! are read, in the spellings of the SDKs and of the service's own messages, as a bare array or below `visemes`,
//! `events` or `Metadata`.

use super::Format;
use crate::json::{self, Node};
use crate::{ImportOptions, Shape, Time, Track, source};
use lipz_diagnostics::Diagnostic;

/// The ticks per second, the unit of the service.
const TICKS: u32 = 10_000_000;
/// The milliseconds per second, the unit of programs that divide the ticks like Microsoft's samples.
const MILLISECONDS: u32 = 1_000;
/// The least average distance of offsets in ticks. Closer offsets are milliseconds, because speech never has a thousand
/// visemes per second.
const FEWEST_TICKS: u64 = 10_000;

/// The spellings of the offset in SDKs and programs. Case is ignored.
const OFFSET: &[&str] = &["audio_offset", "audioOffset", "offset", "privAudioOffset"];
/// The spellings that indicate milliseconds.
const OFFSET_MS: &[&str] = &["offset_ms", "offsetMs", "audio_offset_ms", "audioOffsetMs"];
const ID: &[&str] = &["viseme_id", "visemeId", "id", "viseme", "privVisemeId"];
/// The members of an object that contain the events; `Metadata` in the messages of the service.
const LISTS: &[&str] = &["visemes", "events", "Metadata"];
/// The member of the service's messages that contains the members of an event.
const DATA: &[&str] = &["Data"];

pub(super) const FORMAT: Format = Format {
    name: "azure",
    about: "Azure (and SAPI) viseme events, JSON",
    extension: "json",
    maps: &["azure"],
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(root) = source::text(bytes, diagnostics).and_then(|text| json::root(text, diagnostics)) else {
        return Vec::new();
    };
    let list = if root.is_object() { root.get(LISTS) } else { Some(root) };
    let Some(events) = list.and_then(Node::items) else {
        let what = "a list of viseme events, \"visemes\" or \"events\",";
        diagnostics.push(if root.get(&["BlendShapes"]).is_some() {
            root.lacks(what)
                .help("request viseme ids from the service; this file has blend shapes instead of mouth shapes")
        } else {
            root.lacks(what)
        });
        return Vec::new();
    };
    let mut track = Track::default();
    let read: Vec<Offset<'_>> = events.into_iter().filter_map(|event| offset(event, diagnostics)).collect();
    let per_second = if are_milliseconds(&read) { MILLISECONDS } else { TICKS };
    for Offset { text, symbol, id, .. } in &read {
        // Fractions of a millisecond are kept: the text is parsed as thousandths of a second.
        let time = Time::parse(&format!("{text}{}", if per_second == TICKS { "e-7" } else { "e-3" }));
        if let Some(start) = time {
            track.shapes.push(Shape::at(id.span(), start, symbol.clone()));
        }
    }
    if per_second == MILLISECONDS && !read.iter().all(|offset| offset.is_ms) {
        track.remarks.push("offsets read as milliseconds, not as ticks of 100 ns".to_owned());
    }
    if track.shapes.len() > 1 && track.shapes.last().is_some_and(|last| last.symbol == "0") {
        track.end = track.shapes.pop().map(|last| last.start);
    }
    vec![track]
}

/// A viseme event, before the unit of its offset is determined.
struct Offset<'s> {
    /// The digits of the offset.
    text: String,
    /// Whether its name indicates milliseconds.
    is_ms: bool,
    symbol: String,
    id: Node<'s>,
}

/// Returns the event, or reports a missing member.
fn offset<'s>(event: Node<'s>, diagnostics: &mut Vec<Diagnostic>) -> Option<Offset<'s>> {
    let event = event.get(DATA).unwrap_or(event);
    let in_ms = event.get(OFFSET_MS);
    let (Some(offset), Some(id)) = (in_ms.or_else(|| event.get(OFFSET)), event.get(ID)) else {
        diagnostics.push(event.lacks("an audio offset or a viseme id"));
        return None;
    };
    let Some(text) = offset.number().filter(|text| !text.contains(['e', 'E']) && Time::parse(text).is_some()) else {
        diagnostics.push(offset.not("an audio offset, a number of ticks of 100 ns or of milliseconds"));
        return None;
    };
    let Some(symbol) = id.number() else {
        diagnostics.push(id.not("a viseme id, a number from 0 to 21"));
        return None;
    };
    Some(Offset { text, is_ms: in_ms.is_some(), symbol, id })
}

/// Whether the offsets are milliseconds: a name indicates it, one has a fraction, or as ticks they would be closer
/// together than in any speech.
fn are_milliseconds(offsets: &[Offset<'_>]) -> bool {
    let last = offsets.iter().filter_map(|offset| offset.text.parse::<u64>().ok()).max().unwrap_or(0);
    let gaps = u64::try_from(offsets.len()).unwrap_or(u64::MAX).saturating_sub(1);
    offsets.iter().any(|offset| offset.is_ms || offset.text.contains('.')) || last < gaps.saturating_mul(FEWEST_TICKS)
}
