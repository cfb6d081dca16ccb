//! Findings as one JSON document. Fields are only ever added (docs/VERSIONING.md).

use super::places::Places;
use lipz::diagnostic::Label;
use lipz::{Diagnostic, Level, LineColumn};
use lipz_compiler::{Report, count};
use serde::Serialize;

/// Every finding of a run.
#[derive(Serialize)]
pub(super) struct Document<'r> {
    errors: usize,
    warnings: usize,
    findings: Vec<Finding<'r>>,
}

#[derive(Serialize)]
struct Finding<'r> {
    code: &'static str,
    name: &'static str,
    level: String,
    message: &'r str,
    path: &'r str,
    /// The characters that the finding is about; none if it is about the file.
    span: Option<Span>,
    label: Option<&'r str>,
    /// Other places that belong to the finding.
    labels: Vec<OtherPlace<'r>>,
    notes: &'r [String],
    help: Option<&'r str>,
    fix: Option<Fix<'r>>,
}

#[derive(Serialize)]
struct OtherPlace<'r> {
    span: Span,
    text: &'r str,
}

#[derive(Serialize)]
struct Fix<'r> {
    span: Span,
    replacement: &'r str,
}

/// From the first character to the one after the last.
#[derive(Serialize)]
struct Span {
    start: Place,
    end: Place,
}

/// Line and column in characters, both from 1; bytes of the text from 0, not counting a byte order mark.
#[derive(Serialize)]
struct Place {
    line: u32,
    column: u32,
    offset_bytes: u32,
}

impl<'r> Document<'r> {
    pub(super) fn of(reports: &'r [Report]) -> Self {
        let of = |report: &'r Report| {
            let places = Places::of(report);
            report.diagnostics.iter().map(move |found| Finding::of(&report.source.path, &places, found))
        };
        Document {
            errors: count(reports, Level::Error),
            warnings: count(reports, Level::Warning),
            findings: reports.iter().flat_map(of).collect(),
        }
    }
}

impl<'r> Finding<'r> {
    fn of(path: &'r str, places: &Places, diagnostic: &'r Diagnostic) -> Self {
        let primary = diagnostic.primary.as_ref();
        let other = |label: &'r Label| OtherPlace { span: Span::of(places, label.span), text: &label.text };
        Finding {
            code: diagnostic.code.number(),
            name: diagnostic.code.name(),
            level: diagnostic.level.to_string(),
            message: &diagnostic.headline,
            path,
            span: primary.map(|label| Span::of(places, label.span)),
            label: primary.map(|label| label.text.as_str()).filter(|text| !text.is_empty()),
            labels: diagnostic.secondary.iter().map(other).collect(),
            notes: &diagnostic.notes,
            help: diagnostic.help.as_deref(),
            fix: diagnostic
                .fix
                .as_ref()
                .map(|fix| Fix { span: Span::of(places, fix.span), replacement: &fix.replacement }),
        }
    }
}

impl Span {
    fn of(places: &Places, span: lipz::Span) -> Span {
        let [start, end] = places.ends(span);
        Span { start: Place::of(start, span.start), end: Place::of(end, span.end) }
    }
}

impl Place {
    fn of(place: LineColumn, offset_bytes: u32) -> Place {
        Place { line: place.line, column: place.column, offset_bytes }
    }
}
