//! The event strings of a clip's segments: kept as they are, and checked where they are Character
//! Event Syntax or nearly so.

mod names;
mod near;

use super::texts::nul;
use crate::Registry;
use lipz::event;
use lipz::{Code, Diagnostic, JsonString, text};
use names::Unknown;
use near::Near;
use std::ops::Range;

/// Findings of one kind that one element shows in full; the rest is counted.
const SHOWN: usize = 3;

/// The kinds of findings about events.
const CODES: [Code; 5] =
    [Code::UnknownEmotion, Code::UnknownCharacter, Code::UnknownTarget, Code::UnknownAction, Code::NearEvent];

/// The trimmed event string of each segment.
pub(super) fn trimmed(
    string: &JsonString<'_>,
    registry: &Registry,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Box<str>> {
    nul(string, Code::NulInEvents, "the events contain", diagnostics);
    let mut faults = Vec::new();
    let trimmed = text::segments(&string.text)
        .map(|range| {
            let segment = &string.text[range.clone()];
            collect(segment, range.start, registry, &mut faults);
            text::trim(segment).into()
        })
        .collect();
    if !faults.is_empty() {
        report(&faults, string, registry, diagnostics);
    }
    trimmed
}

/// Something that is wrong in a segment.
struct Fault<'t> {
    /// Where the segment starts, in bytes of the element's text.
    segment_start: usize,
    what: What<'t>,
}

enum What<'t> {
    Unknown(Unknown<'t>),
    Near(Near<'t>),
}

impl Fault<'_> {
    fn code(&self) -> Code {
        match &self.what {
            What::Unknown(unknown) => unknown.code(),
            What::Near(_) => Code::NearEvent,
        }
    }

    fn finding(&self, string: &JsonString<'_>, registry: &Registry) -> Diagnostic {
        let span = |at: Range<usize>| string.span_of(self.segment_start + at.start..self.segment_start + at.end);
        match &self.what {
            What::Unknown(unknown) => unknown.finding(span(unknown.word.range()), registry),
            What::Near(near) => near.finding(span(near.at.clone())),
        }
    }
}

fn collect<'t>(segment: &'t str, segment_start: usize, registry: &Registry, faults: &mut Vec<Fault<'t>>) {
    let mut add = |what| faults.push(Fault { segment_start, what });
    match event::parse(segment) {
        Some(events) => {
            let unknown = events.iter().flat_map(|event| names::unknown(event, registry));
            unknown.for_each(|unknown| add(What::Unknown(unknown)));
        }
        None => near::near(segment, registry).into_iter().for_each(|near| add(What::Near(near))),
    }
}

/// Shows the first few faults of each kind.
fn report(faults: &[Fault<'_>], string: &JsonString<'_>, registry: &Registry, diagnostics: &mut Vec<Diagnostic>) {
    for code in CODES {
        let of_kind = || faults.iter().filter(|fault| fault.code() == code);
        let hidden = of_kind().count().saturating_sub(SHOWN);
        for (index, fault) in of_kind().take(SHOWN).enumerate() {
            let finding = fault.finding(string, registry);
            diagnostics.push(if hidden > 0 && index + 1 == SHOWN {
                finding.note(format!("{hidden} more in these events are not shown"))
            } else {
                finding
            });
        }
    }
}
