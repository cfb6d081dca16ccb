//! Diagnostics as a Code Quality report of GitLab, which shows them next to the changed lines of a merge request.

use super::places::Places;
use super::to_json;
use crate::{Diagnostic, Report, Severity};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Violation<'r> {
    description: String,
    check_name: &'static str,
    fingerprint: String,
    severity: &'static str,
    location: Location<'r>,
}

#[derive(Serialize)]
struct Location<'r> {
    path: &'r str,
    lines: Lines,
}

#[derive(Serialize)]
struct Lines {
    begin: u32,
    end: u32,
}

/// Returns one Code Quality report (GitLab Docs, "Code Quality report format") with all diagnostics, an empty list if
/// there are none. An error is `major`, a warning `minor`. A diagnostic without a file has the path `.`, because GitLab
/// requires one.
///
/// A fingerprint identifies a diagnostic independently of its line number: by code, path, message, and a number among
/// identical ones.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render};
/// let report = Report::about("voices/aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// let found: serde_json::Value = serde_json::from_str(&render::gitlab(&[report])).unwrap();
/// assert_eq!(found[0]["location"]["path"], "voices/aye.lipz");
/// assert_eq!(found[0]["severity"], "major");
/// ```
pub fn gitlab(reports: &[Report]) -> String {
    let mut seen = BTreeMap::new();
    let mut violations = Vec::new();
    for report in reports {
        let places = Places::new(report);
        for diagnostic in &report.diagnostics {
            violations.push(violation(&report.source.path, &places, diagnostic, &mut seen));
        }
    }
    to_json(&violations)
}

fn violation<'r>(
    path: &'r str,
    places: &Places,
    diagnostic: &Diagnostic,
    seen: &mut BTreeMap<String, usize>,
) -> Violation<'r> {
    // GitLab expects paths as in git.
    let path = path.strip_prefix("./").unwrap_or(path);
    let same = format!("{} {path} {}", diagnostic.code, diagnostic.message);
    let count = seen.entry(same.clone()).or_default();
    *count += 1;
    let lines = diagnostic.primary.as_ref().map_or(Lines { begin: 1, end: 1 }, |label| {
        let [start, end] = places.ends(label.span);
        Lines { begin: start.line, end: end.line }
    });
    Violation {
        description: description(diagnostic),
        check_name: diagnostic.code.number(),
        fingerprint: format!("{same} {count}"),
        severity: match diagnostic.severity {
            Severity::Error => "major",
            Severity::Warning => "minor",
        },
        location: Location { path: if path.is_empty() { "." } else { path }, lines },
    }
}

/// Returns message and help as one paragraph, because GitLab shows only one.
fn description(diagnostic: &Diagnostic) -> String {
    match &diagnostic.help {
        Some(help) => format!("{} ({help})", diagnostic.message),
        None => diagnostic.message.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Source, Span};
    use serde_json::{Value, json};

    #[test]
    fn places_and_fingerprints() {
        let at = |start| Diagnostic::at(Code::UnknownElement, Span::new(start, start + 3), "odd").help("delete it");
        let two = Report::new(Source::new("./a.lipz", "{\n\n\"a\": 1\n}"), vec![at(3), at(8)]);
        let none = Report::about("", Diagnostic::new(Code::NoSources, "none"));
        let found: Value = serde_json::from_str(&gitlab(&[two, none])).unwrap();
        assert_eq!(
            found,
            json!([
                { "description": "odd (delete it)", "check_name": "LZ0203", "severity": "minor",
                  "fingerprint": "LZ0203 a.lipz odd 1",
                  "location": { "path": "a.lipz", "lines": { "begin": 3, "end": 3 } } },
                { "description": "odd (delete it)", "check_name": "LZ0203", "severity": "minor",
                  "fingerprint": "LZ0203 a.lipz odd 2",
                  "location": { "path": "a.lipz", "lines": { "begin": 3, "end": 4 } } },
                { "description": "none", "check_name": "LZ0805", "severity": "major",
                  "fingerprint": "LZ0805  none 1", "location": { "path": ".", "lines": { "begin": 1, "end": 1 } } },
            ])
        );
        assert_eq!(gitlab(&[]), "[]\n");
    }
}
