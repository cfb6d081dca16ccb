//! The position of a diagnostic in a clip: element, segment and frame.

use lipz_diagnostics::{Diagnostic, Report, Severity, escape};
use lipz_file::text::{DELIMITER, segments};
use lipz_file::{Document, JsonString, Value, parse};
use serde::Serialize;
use std::collections::BTreeSet;

/// A diagnostic, as it is sent to the page.
#[derive(Serialize)]
pub(super) struct PlacedDiagnostic {
    code: &'static str,
    name: &'static str,
    severity: String,
    message: String,
    notes: Vec<String>,
    help: Option<String>,
    /// The position in the file, from 1; `None` if the diagnostic concerns the whole file.
    line: Option<u32>,
    column: Option<u32>,
    /// The element of the file.
    element: Option<String>,
    /// The segment, from 0.
    segment: Option<usize>,
    /// The frame, for diagnostics about visemes.
    frame: Option<usize>,
}

/// Returns the elements with errors.
pub(super) fn elements_with_errors(diagnostics: &[PlacedDiagnostic]) -> BTreeSet<String> {
    let errors = diagnostics.iter().filter(|found| found.severity == Severity::Error.to_string());
    errors.filter_map(|found| found.element.clone()).collect()
}

/// Returns the diagnostics of a file with their positions in its clip.
pub(super) fn placed(reports: &[Report]) -> Vec<PlacedDiagnostic> {
    let of_report = |report: &Report| {
        let document = parse(report.source.text.as_bytes()).document;
        report.diagnostics.iter().map(|found| one(report, document.as_ref(), found)).collect::<Vec<_>>()
    };
    reports.iter().flat_map(of_report).collect()
}

fn one(report: &Report, document: Option<&Document<'_>>, found: &Diagnostic) -> PlacedDiagnostic {
    let start = found.primary.as_ref().map(|label| label.span.start);
    let place = start.map(|start| report.source.line_column(start));
    let element = start.zip(document).and_then(|(start, document)| {
        document.elements.iter().find(|element| {
            let span = element.value.span();
            span.start <= start && start < span.end.max(span.start + 1)
        })
    });
    let (mut segment, mut frame) = (None, None);
    if let (Some(start), Some(Value::String(string))) = (start, element.map(|element| &element.value)) {
        let at = decoded(string, start);
        segment = segments(&string.text).position(|range| at <= range.end);
        let is_mouth = element.is_some_and(|element| element.name.text == "visemes");
        let before = string.text.get(..at).unwrap_or_default();
        frame = is_mouth.then(|| before.chars().filter(|code| *code != DELIMITER).count());
    }
    PlacedDiagnostic {
        code: found.code.number(),
        name: found.code.name(),
        severity: found.severity.to_string(),
        message: escape::text(&found.message).into_owned(),
        notes: found.notes.iter().map(|note| escape::text(note).into_owned()).collect(),
        help: found.help.as_ref().map(|help| escape::text(help).into_owned()),
        line: place.map(|place| place.line),
        column: place.map(|place| place.column),
        element: element.map(|element| element.name.text.to_string()),
        segment,
        frame,
    }
}

/// Returns the offset in a decoded string of a position in the file. Positions ascend with offsets, so that a binary
/// search finds it.
fn decoded(string: &JsonString<'_>, place: u32) -> usize {
    let bounds: Vec<usize> = string.text.char_indices().map(|(at, _)| at).collect();
    let behind = bounds.partition_point(|at| string.span_of(*at..*at).start <= place);
    behind.checked_sub(1).and_then(|index| bounds.get(index)).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_diagnostics::{Code, Span};

    #[test]
    fn diagnostics_are_where_their_characters_are() {
        let file = "{ \"visemes\": \"MA|Q-\",\n  \"text_en-us\": \"Na\\u00efve|Aye\" }";
        let at = |needle: &str| {
            let start = file.find(needle).unwrap();
            Diagnostic::at(Code::ForeignCode, Span::new(start, start + 1), "m")
        };
        let report = Report::from_bytes("a.lipz", file.as_bytes(), vec![at("Q"), at("ve|"), at("Aye"), at("{")]);
        let places = placed(&[report]);
        let place = |index: usize| (places[index].element.as_deref(), places[index].segment, places[index].frame);
        assert_eq!(place(0), (Some("visemes"), Some(1), Some(2)));
        assert_eq!(place(1), (Some("text_en-us"), Some(0), None));
        assert_eq!(place(2), (Some("text_en-us"), Some(1), None));
        assert_eq!(place(3), (None, None, None));
        assert_eq!((places[0].line, places[2].line), (Some(1), Some(2)));
    }
}
