//! Output of build scripts for cargo (The Cargo Book, "Outputs of the Build Script"): one line per message, which
//! cannot be mistaken for a different instruction.

use super::places::Places;
use crate::Report;
use crate::escape;
use crate::{Code, Diagnostic, Severity};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The most diagnostics of one code that are printed; the rest are counted.
const PRINTED_PER_CODE: usize = 100;

/// Returns lines for a build script to print: one per diagnostic, and one per code with more than 100.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render};
/// let report = Report::about("voices/aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// assert_eq!(render::cargo(&[report]), "cargo::error=voices/aye.lipz: the file is empty [LZ0002]\n");
/// ```
pub fn cargo(reports: &[Report]) -> String {
    let mut lines = String::new();
    let mut counts: BTreeMap<(Code, Severity), usize> = BTreeMap::new();
    for report in reports {
        let places = Places::new(report);
        for found in &report.diagnostics {
            let count = counts.entry((found.code, found.severity)).or_default();
            *count += found.count();
            if *count <= PRINTED_PER_CODE {
                line(&mut lines, found.severity, &message(&report.source.path, &places, found));
            }
        }
    }
    for ((code, severity), count) in counts {
        if count > PRINTED_PER_CODE {
            let more = count - PRINTED_PER_CODE;
            line(&mut lines, severity, &format!("{more} more of {code}: {}", code.summary()));
        }
    }
    lines
}

fn line(lines: &mut String, severity: Severity, message: &str) {
    let _ = writeln!(lines, "cargo::{severity}={}", escape::text(message));
}

/// Returns `voices/mayor.lipz:3:16: message [LZ0401]; help: advice`.
fn message(path: &str, places: &Places, found: &Diagnostic) -> String {
    let mut message = places.prefix(path, found);
    let _ = write!(message, "{} [{}]", found.message, found.code);
    // Notes that start with a space are rows of a table, which cannot be shown on one line.
    for note in found.notes.iter().filter(|note| !note.starts_with(' ')) {
        let _ = write!(message, "; note: {note}");
    }
    if let Some(help) = &found.help {
        let _ = write!(message, "; help: {help}");
    }
    message
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Source, Span};

    fn report(path: &str, text: &str, diagnostics: Vec<Diagnostic>) -> Report {
        Report::new(Source::new(path, text), diagnostics)
    }

    #[test]
    fn a_diagnostic_is_one_line() {
        let found = Diagnostic::at(Code::ForeignCode, Span::new(4, 5), "`Z` is foreign").help("use\nanother");
        let lines = cargo(&[report("a\ncargo::rustc-env=X=1.lipz", "é\nxZ", vec![found])]);
        assert_eq!(
            lines,
            "cargo::error=a\\ncargo::rustc-env=X=1.lipz:2:2: `Z` is foreign [LZ0401]; help: use\\nanother\n"
        );
        let lines = cargo(&[report("", "", vec![Diagnostic::new(Code::EmptyDocument, "empty")])]);
        assert_eq!(lines, "cargo::warning=empty [LZ0204]\n");
    }

    #[test]
    fn many_diagnostics_of_one_code_are_counted() {
        for count in [250, 2_500] {
            let mut many = vec![Diagnostic::new(Code::UnknownElement, "odd"); count];
            crate::bound::limit(&mut many);
            let lines = cargo(&[report("a.lipz", "", many)]);
            assert_eq!(lines.lines().count(), PRINTED_PER_CODE + 1);
            let rest = count - PRINTED_PER_CODE;
            assert!(
                lines.ends_with(&format!(
                    "cargo::warning={rest} more of LZ0203: an element is not part of the format\n"
                )),
                "{lines}"
            );
        }
    }
}
