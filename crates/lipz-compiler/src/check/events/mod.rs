//! The event strings of a clip's segments. They are kept unchanged, and checked if they are Character Event Syntax or
//! nearly so.

mod broken;
mod names;
mod near_miss;

use super::texts::nul;
use crate::project::{KnownNames, Options};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::event::{self, Part};
use lipz_file::{JsonString, text};
use names::UnregisteredName;
use near_miss::{NearMiss, near_misses};
use std::collections::BTreeMap;
use std::ops::Range;

/// The maximum number of diagnostics of one kind per element that are shown in full; the rest are counted.
const SHOWN: usize = 3;

/// Returns the trimmed event string of each segment.
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

/// Whether the events of a segment do not need a diagnostic in any file.
pub(super) fn is_clean(segment: &str, options: &Options) -> bool {
    // A string that is clean in one file is treated as clean in all files.
    faults(segment, &options.known_names, options.may_report(Code::OtherEvents)).is_empty()
}

/// A fault in the events of a segment.
enum Fault<'s> {
    /// A name that the project does not register.
    UnregisteredName(UnregisteredName<'s>),
    /// A part that is nearly an event.
    NearMiss(NearMiss<'s>),
    /// A part that is not an event, in a segment that starts like events.
    Broken(Part<'s>),
    /// A part that is not an event.
    Other(Part<'s>),
}

/// Returns all faults in the events of a segment. A fault that is missing here is never reported. If it `is_strict`,
/// events in another syntax are faults, too.
fn faults<'s>(segment: &'s str, known_names: &KnownNames, is_strict: bool) -> Vec<Fault<'s>> {
    if let Some(events) = event::parse(segment) {
        return events.flat_map(|event| names::unknown(&event, known_names)).map(Fault::UnregisteredName).collect();
    }
    let mut faults: Vec<Fault<'_>> = near_misses(segment, known_names).map(Fault::NearMiss).collect();
    if is_strict && faults.is_empty() {
        faults.extend(event::parts(segment).filter(|part| part.event().is_none()).map(Fault::Other));
    }
    if faults.is_empty() {
        faults.extend(broken::broken(segment, known_names).map(Fault::Broken));
    }
    faults
}

/// Whether the project reports events in another syntax.
fn wants_events_only(options: &Options) -> bool {
    options.levels.severity(Code::OtherEvents).is_some()
}

/// The diagnostics about the events of an element.
struct EventDiagnostics<'e> {
    string: &'e JsonString<'e>,
    known_names: &'e KnownNames,
    /// Whether events of another syntax are reported, too.
    is_strict: bool,
    by_code: BTreeMap<Code, OfCode>,
}

/// The diagnostics of one code: the first few, and the number of all.
#[derive(Default)]
struct OfCode {
    first: Vec<Diagnostic>,
    count: usize,
}

impl EventDiagnostics<'_> {
    /// Adds the faults of a segment that starts at byte `start` of the element's text.
    fn of_segment(&mut self, segment: &str, start: usize) {
        let (string, known_names) = (self.string, self.known_names);
        let span = |at: Range<usize>| string.span_of(start + at.start..start + at.end);
        for fault in faults(segment, known_names, self.is_strict) {
            match fault {
                Fault::UnregisteredName(name) => {
                    self.add(name.code(), || name.diagnostic(span(name.word.range()), known_names));
                }
                Fault::NearMiss(event) => {
                    self.add(Code::NearEvent, || event.diagnostic(span(event.at.clone()), span(event.event.clone())));
                }
                Fault::Broken(part) => self.add(Code::BrokenEvent, || broken::diagnostic(part, span)),
                Fault::Other(part) => self.add(Code::OtherEvents, || other_events(part, span)),
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

/// Returns the diagnostic for a part of a segment that is not an event.
fn other_events(part: Part<'_>, span: impl Fn(Range<usize>) -> Span) -> Diagnostic {
    let written = text::trim(part.text);
    let start = part.start + part.text.find(written).unwrap_or(0);
    let message = match written {
        "" => "an event is missing next to this `,`".to_owned(),
        _ => format!("{} is not Character Event Syntax", escape::quoted(written)),
    };
    Diagnostic::at(Code::OtherEvents, span(start..start + written.len()), message)
        .note("the whole segment is kept as text; games do not see its events")
        .help("write it as in `amy feels sad, points door`; for an action of the game, as in `amy does wave`")
}

impl OfCode {
    /// Returns the diagnostics to show. The last one states the number of hidden ones.
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
