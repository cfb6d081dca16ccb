//! Conversion of diagnostics to the form of the protocol.

use crate::document::Document;
use crate::{place, uri};
use lipz_diagnostics::{Diagnostic, Label, Report, Severity, Span};
use lsp_types::{
    CodeDescription, Diagnostic as Shown, DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString,
    Range, Uri,
};
use ropey::Rope;
use std::path::Path;
use std::str::FromStr;

/// The page that describes all rules.
const PAGE: &str = concat!(env!("CARGO_PKG_REPOSITORY"), "/blob/main/docs/reference/diagnostics.md");

/// Returns the diagnostics of an open file.
pub(crate) fn of_document(document: &Document) -> Vec<Shown> {
    let shift = document.mark_bytes();
    document.shown.iter().map(|diagnostic| shown(diagnostic, &document.rope, shift, &document.uri)).collect()
}

/// Returns the diagnostics of a closed file, and its URI; `None` for a report without a file.
pub(crate) fn of_report(report: &Report) -> Option<(Uri, Vec<Shown>)> {
    let uri = uri::of_path(Path::new(&report.source.path))?;
    let rope = Rope::from_str(&report.source.text);
    let shown = report.diagnostics.iter().map(|diagnostic| shown(diagnostic, &rope, 0, &uri)).collect();
    Some((uri, shown))
}

/// Converts a span of the text after its byte order mark to a range of the whole text.
pub(crate) fn range(rope: &Rope, span: Span, shift: usize) -> Range {
    place::range(rope, Span::new(span.start as usize + shift, span.end as usize + shift))
}

fn shown(diagnostic: &Diagnostic, rope: &Rope, shift: usize, uri: &Uri) -> Shown {
    let related = |label: &Label| DiagnosticRelatedInformation {
        location: Location::new(uri.clone(), range(rope, label.span, shift)),
        message: if label.text.is_empty() { "see here".to_owned() } else { label.text.clone() },
    };
    let related: Vec<_> = diagnostic.labels.iter().map(related).collect();
    let page = format!("{PAGE}#{}-{}", diagnostic.code.number().to_lowercase(), diagnostic.code.name());
    Shown {
        range: diagnostic.primary.as_ref().map(|label| range(rope, label.span, shift)).unwrap_or_default(),
        severity: Some(match diagnostic.severity {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        }),
        code: Some(NumberOrString::String(diagnostic.code.number().to_owned())),
        code_description: Uri::from_str(&page).ok().map(|href| CodeDescription { href }),
        source: Some("lipz".to_owned()),
        message: message(diagnostic),
        related_information: (!related.is_empty()).then_some(related),
        ..Shown::default()
    }
}

/// Returns the message, remark, notes and help, on one line each.
fn message(diagnostic: &Diagnostic) -> String {
    let mut text = diagnostic.message.clone();
    let label = diagnostic.primary.iter().map(|label| label.text.as_str()).filter(|text| !text.is_empty());
    label.for_each(|label| text.push_str(&format!(" ({label})")));
    diagnostic.notes.iter().for_each(|note| text.push_str(&format!("\nnote: {note}")));
    diagnostic.help.iter().for_each(|help| text.push_str(&format!("\nhelp: {help}")));
    text
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use lipz_diagnostics::Code;

    #[test]
    fn all_that_a_diagnostic_says_is_shown_at_its_place() {
        let uri = Uri::from_str("untitled:a").unwrap();
        let mut document = Document::new(uri, 1, "\u{feff}𝄞Z".into());
        let diagnostic = Diagnostic::at(Code::ForeignCode, Span::new(4, 5), "`Z` is no code").label("here");
        document.shown = vec![diagnostic.also(Span::new(0, 4), "").note("a note").help("do it")];
        let shown = &of_document(&document)[0];
        assert_eq!((shown.range.start.character, shown.range.end.character), (3, 4), "in UTF-16");
        assert_eq!(shown.message, "`Z` is no code (here)\nnote: a note\nhelp: do it");
        assert_eq!(shown.related_information.as_ref().unwrap()[0].location.range.start.character, 1);
        let href = shown.code_description.as_ref().unwrap().href.as_str();
        assert!(href.ends_with("/docs/reference/diagnostics.md#lz0401-foreign-code"), "{href}");
    }
}
