//! Reports in an object, as JSON from which they can be restored exactly.

use lipz_diagnostics::{Code, Diagnostic, Fix, Label, Report, Severity, Source, Span};
use serde::{Deserialize, Serialize};

/// A [`Report`] as a document from which it can be restored exactly.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WireReport {
    path: String,
    text: String,
    diagnostics: Vec<WireDiagnostic>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireDiagnostic {
    code: String,
    is_error: bool,
    message: String,
    primary: Option<WireLabel>,
    labels: Vec<WireLabel>,
    notes: Vec<String>,
    help: Option<String>,
    fix: Option<WireLabel>,
    is_fix_certain: bool,
    rest: usize,
}

/// A range of bytes in the text, with its label, or with its replacement in a fix.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct WireLabel(u32, u32, String);

impl WireLabel {
    fn new(span: Span, text: &str) -> WireLabel {
        WireLabel(span.start, span.end, text.to_owned())
    }

    /// Returns the span, if it is valid in `text`.
    fn span(&self, text: &str) -> Option<Span> {
        let span = Span::new(self.0 as usize, self.1 as usize);
        // Positions after the end occur in reports about a truncated file.
        let is_boundary = |at: u32| at as usize >= text.len() || text.is_char_boundary(at as usize);
        (self.0 <= self.1 && is_boundary(self.0) && is_boundary(self.1)).then_some(span)
    }
}

impl WireReport {
    /// Converts a report to its document.
    pub fn of(report: &Report) -> WireReport {
        let diagnostics = report.diagnostics.iter().map(WireDiagnostic::of).collect();
        WireReport { path: report.source.path.clone(), text: report.source.text.clone(), diagnostics }
    }

    /// Converts the document to a report; `None` if its rule is unknown or its positions are invalid.
    pub fn into_report(self) -> Option<Report> {
        let diagnostics = self.diagnostics.iter().map(|wire| wire.diagnostic(&self.text)).collect::<Option<_>>()?;
        Some(Report::new(Source::new(self.path, self.text), diagnostics))
    }
}

impl WireDiagnostic {
    fn of(diagnostic: &Diagnostic) -> WireDiagnostic {
        let label = |label: &Label| WireLabel::new(label.span, &label.text);
        WireDiagnostic {
            code: diagnostic.code.number().to_owned(),
            is_error: diagnostic.is_error(),
            message: diagnostic.message.clone(),
            primary: diagnostic.primary.as_ref().map(label),
            labels: diagnostic.labels.iter().map(label).collect(),
            notes: diagnostic.notes.clone(),
            help: diagnostic.help.clone(),
            fix: diagnostic.fix.as_ref().map(|fix| WireLabel::new(fix.span, &fix.replacement)),
            is_fix_certain: diagnostic.fix.as_ref().is_some_and(Fix::is_certain),
            rest: diagnostic.rest,
        }
    }

    fn diagnostic(&self, text: &str) -> Option<Diagnostic> {
        let code: Code = self.code.parse().ok()?;
        let mut diagnostic = match &self.primary {
            Some(primary) => Diagnostic::at(code, primary.span(text)?, &self.message).label(&primary.2),
            None => Diagnostic::new(code, &self.message),
        };
        diagnostic.severity = if self.is_error { Severity::Error } else { Severity::Warning };
        for label in &self.labels {
            diagnostic = diagnostic.also(label.span(text)?, &label.2);
        }
        diagnostic.notes.clone_from(&self.notes);
        diagnostic.help.clone_from(&self.help);
        if let Some(fix) = &self.fix {
            let span = fix.span(text)?;
            diagnostic = match self.is_fix_certain {
                true => diagnostic.fix(span, &fix.2),
                false => diagnostic.suggest(span, &fix.2),
            };
        }
        diagnostic.rest = self.rest;
        Some(diagnostic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_come_back_as_they_were() {
        let text = "{ \"f\u{fc}\": 1, }";
        let mut error =
            Diagnostic::at(Code::TrailingComma, Span::new(11, 12), "m").label("here").also(Span::new(2, 7), "l");
        error = error.note("n").help("h").fix(Span::new(11, 12), "");
        error.severity = Severity::Warning;
        error.rest = 3;
        let offered = error.clone().suggest(Span::new(2, 7), "g");
        let whole = Diagnostic::new(Code::Usage, "whole");
        let report = Report::new(Source::new("a.lipz", text), vec![error, offered, whole]);
        let json = serde_json::to_string(&WireReport::of(&report)).unwrap();
        let back: WireReport = serde_json::from_str(&json).unwrap();
        assert_eq!(back.into_report(), Some(report));
        for (from, to) in [("LZ0102", "LZ0000"), ("[11,12", "[12,11"), ("[2,7", "[2,5")] {
            let forged = json.replacen(from, to, 1);
            assert_ne!(forged, json);
            let forged: WireReport = serde_json::from_str(&forged).unwrap();
            assert_eq!(forged.into_report(), None, "{to}");
        }
    }
}
