//! The event strings of a clip's segments: kept as they are, and checked where they are Character
//! Event Syntax or nearly so.

mod names;
mod near_miss;

use super::texts::nul;
use crate::{KnownNames, Options};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::event::{self, Part};
use lipz_file::{JsonString, text};
use std::collections::BTreeMap;
use std::ops::Range;

/// Diagnostics of one kind that one element shows in full; the rest is counted.
const SHOWN: usize = 3;

/// The trimmed event string of each segment.
pub(super) fn trimmed<'t>(
    string: &'t JsonString<'_>,
    options: &Options,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<&'t str> {
    nul(string, Code::NulInEvents, "the events contain", diagnostics);
    let (known_names, is_strict) = (&options.known_names, wants_events_only(options));
    let mut of_events = EventDiagnostics { string, known_names, is_strict, by_code: BTreeMap::new() };
    let trimmed = text::segments(&string.text)
        .map(|range| {
            let segment = &string.text[range.clone()];
            of_events.of_segment(segment, range.start);
            text::trim(segment)
        })
        .collect();
    diagnostics.extend(of_events.by_code.into_values().flat_map(OfCode::shown));
    trimmed
}

/// Whether nothing is wrong with the events of a segment, in any file.
pub(super) fn is_clean(segment: &str, options: &Options) -> bool {
    let known_names = &options.known_names;
    match event::parse(segment) {
        Some(mut events) => events.all(|event| names::unknown(&event, known_names).next().is_none()),
        // What is clean in one file is taken for clean in all.
        None => !options.may_report(Code::OtherEvents) && near_miss::near_misses(segment, known_names).next().is_none(),
    }
}

/// Whether the project has no other syntax for events.
fn wants_events_only(options: &Options) -> bool {
    options.levels.severity(Code::OtherEvents).is_some()
}

/// What is wrong with the events of an element.
struct EventDiagnostics<'e> {
    string: &'e JsonString<'e>,
    known_names: &'e KnownNames,
    /// Whether events of another syntax are reported, too.
    is_strict: bool,
    by_code: BTreeMap<Code, OfCode>,
}

/// The diagnostics of one code: the first few, and how many there are.
#[derive(Default)]
struct OfCode {
    first: Vec<Diagnostic>,
    count: usize,
}

impl EventDiagnostics<'_> {
    /// Adds what is wrong in a segment, which starts at byte `start` of the element's text.
    fn of_segment(&mut self, segment: &str, start: usize) {
        let (string, known_names) = (self.string, self.known_names);
        let span = |at: Range<usize>| string.span_of(start + at.start..start + at.end);
        match event::parse(segment) {
            Some(events) => {
                for unknown in events.flat_map(|event| names::unknown(&event, known_names)) {
                    self.add(unknown.code(), || unknown.diagnostic(span(unknown.word.range()), known_names));
                }
            }
            None => {
                let mut is_near = false;
                for near_miss in near_miss::near_misses(segment, known_names) {
                    is_near = true;
                    self.add(Code::NearEvent, || near_miss.diagnostic(span(near_miss.at.clone())));
                }
                if self.is_strict && !is_near {
                    let parts = event::parts(segment).filter(|part| part.event().is_none());
                    for part in parts {
                        self.add(Code::OtherEvents, || other_events(part, span));
                    }
                }
            }
        }
    }

    fn add(&mut self, code: Code, diagnostic: impl FnOnce() -> Diagnostic) {
        let of_code = self.by_code.entry(code).or_default();
        of_code.count += 1;
        if of_code.count <= SHOWN {
            of_code.first.push(diagnostic());
        }
    }
}

/// A part of a segment is no event.
fn other_events(part: Part<'_>, span: impl Fn(Range<usize>) -> Span) -> Diagnostic {
    let written = text::trim(part.text);
    let start = part.start + part.text.find(written).unwrap_or(0);
    let message = match written {
        "" => "an event is missing beside this `,`".to_owned(),
        _ => format!("{} is not Character Event Syntax", escape::quoted(written)),
    };
    Diagnostic::at(Code::OtherEvents, span(start..start + written.len()), message)
        .note("all of the segment is kept as text: games see no events in it")
        .help("write it as in `amy feels sad, points door`, and actions of the game as in `amy does wave`")
}

impl OfCode {
    /// The diagnostics that are shown; the last one says how many are not.
    fn shown(mut self) -> Vec<Diagnostic> {
        let hidden = self.count - self.first.len();
        if hidden > 0
            && let Some(last) = self.first.pop()
        {
            self.first.push(last.note(format!("{hidden} more in these events are not shown")));
        }
        self.first
    }
}
