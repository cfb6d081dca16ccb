//! Diagnostics as one JSON document. Fields may be added, but are never removed (docs/reference/versions.md).

use super::places::Places;
use crate::Label;
use crate::Report;
use crate::reports::count;
use crate::{Diagnostic, LineColumn, Severity, escape};
use serde::Serialize;
use std::io;

/// Returns all diagnostics as one JSON document, even if there are none.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render};
/// let report = Report::about("voices/aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// let document: serde_json::Value = serde_json::from_str(&render::json(&[report])).unwrap();
/// assert_eq!(document["errors"], 1);
/// assert_eq!(document["diagnostics"][0]["code"], "LZ0002");
/// ```
pub fn json(reports: &[Report]) -> String {
    to_json(&DiagnosticsDocument::new(reports))
}

/// Returns the same document, followed by the fields of `result`, for a run with results and diagnostics.
///
/// ```
/// use lipz_diagnostics::render::json_with;
/// #[derive(serde::Serialize)]
/// struct Result { made: usize }
/// let document: serde_json::Value = serde_json::from_str(&json_with(&[], &Result { made: 3 })).unwrap();
/// assert_eq!((&document["errors"], &document["made"]), (&0.into(), &3.into()));
/// ```
pub fn json_with<T: Serialize>(reports: &[Report], result: &T) -> String {
    to_json(&DocumentWithResult { document: DiagnosticsDocument::new(reports), result })
}

#[derive(Serialize)]
struct DocumentWithResult<'r, T> {
    #[serde(flatten)]
    document: DiagnosticsDocument<'r>,
    #[serde(flatten)]
    result: &'r T,
}

/// Returns the value as indented JSON, with every control character escaped, because serde_json does not escape those
/// above U+007E.
///
/// For other documents than [`json`]. A value that cannot be serialised becomes `null`.
///
/// ```
/// use lipz_diagnostics::render::to_json;
/// assert_eq!(to_json(&["灯台\u{9b}"]), "[\n  \"灯台\\u009B\"\n]\n");
/// ```
pub fn to_json<T: Serialize>(value: &T) -> String {
    let mut json = TerminalEscaper(Vec::new());
    if serde_json::to_writer_pretty(&mut json, value).is_err() {
        return "null\n".to_owned();
    }
    json.0.push(b'\n');
    String::from_utf8(json.0).unwrap_or_else(|_| "null\n".to_owned())
}

/// Receives JSON in pieces of whole characters, and escapes characters that control a terminal. A document with many
/// diagnostics is therefore in memory only once.
struct TerminalEscaper(Vec<u8>);

impl io::Write for TerminalEscaper {
    fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
        match str::from_utf8(piece) {
            Ok(text) if !text.is_ascii() => self.0.extend_from_slice(escape::text(text).as_bytes()),
            // serde_json escapes all of ASCII except U+007F, and writes line breaks between values.
            _ if piece.contains(&0x7F) => {
                self.0.extend(String::from_utf8_lossy(piece).replace('\u{7F}', "\\u007F").into_bytes());
            }
            _ => self.0.extend_from_slice(piece),
        }
        Ok(piece.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Every diagnostic of a run.
#[derive(Serialize)]
struct DiagnosticsDocument<'r> {
    errors: usize,
    warnings: usize,
    diagnostics: Vec<DiagnosticEntry<'r>>,
}

#[derive(Serialize)]
struct DiagnosticEntry<'r> {
    code: &'static str,
    name: &'static str,
    severity: String,
    message: &'r str,
    path: &'r str,
    /// The marked characters; `None` for a diagnostic about the whole file.
    span: Option<Span>,
    label: Option<&'r str>,
    /// Other positions that belong to the diagnostic.
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
    /// Whether `lipz check --fix` applies it.
    applicability: &'static str,
}

/// From the first character to the one after the last.
#[derive(Serialize)]
struct Span {
    start: JsonPosition,
    end: JsonPosition,
}

/// Line and column in characters, both from 1; byte offset in the text, from 0, without a byte order mark.
#[derive(Serialize)]
struct JsonPosition {
    line: u32,
    column: u32,
    offset_bytes: u32,
}

impl<'r> DiagnosticsDocument<'r> {
    pub(super) fn new(reports: &'r [Report]) -> Self {
        let entries = |report: &'r Report| {
            let places = Places::new(report);
            report.diagnostics.iter().map(move |found| DiagnosticEntry::new(&report.source.path, &places, found))
        };
        DiagnosticsDocument {
            errors: count(reports, Severity::Error),
            warnings: count(reports, Severity::Warning),
            diagnostics: reports.iter().flat_map(entries).collect(),
        }
    }
}

impl<'r> DiagnosticEntry<'r> {
    fn new(path: &'r str, places: &Places, diagnostic: &'r Diagnostic) -> Self {
        let primary = diagnostic.primary.as_ref();
        let other = |label: &'r Label| OtherPlace { span: Span::new(places, label.span), text: &label.text };
        DiagnosticEntry {
            code: diagnostic.code.number(),
            name: diagnostic.code.name(),
            severity: diagnostic.severity.to_string(),
            message: &diagnostic.message,
            path,
            span: primary.map(|label| Span::new(places, label.span)),
            label: primary.map(|label| label.text.as_str()).filter(|text| !text.is_empty()),
            labels: diagnostic.labels.iter().map(other).collect(),
            notes: &diagnostic.notes,
            help: diagnostic.help.as_deref(),
            fix: diagnostic.fix.as_ref().map(|fix| Fix {
                span: Span::new(places, fix.span),
                replacement: &fix.replacement,
                applicability: fix.applicability.name(),
            }),
        }
    }
}

impl Span {
    fn new(places: &Places, span: crate::Span) -> Span {
        let [start, end] = places.ends(span);
        Span { start: JsonPosition::new(start, span.start), end: JsonPosition::new(end, span.end) }
    }
}

impl JsonPosition {
    fn new(place: LineColumn, offset_bytes: u32) -> JsonPosition {
        JsonPosition { line: place.line, column: place.column, offset_bytes }
    }
}
