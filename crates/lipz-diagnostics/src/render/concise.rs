//! Diagnostics as single lines in the format of compilers and linters: for `grep`, editors' error lists and logs.

use super::places::Places;
use crate::Report;
use crate::escape;
use std::fmt::Write;

/// Returns one line per diagnostic: path, line, column (both from 1, in characters), severity, code, message, and
/// `[fixable]` at the end if there is a certain fix. Empty without diagnostics.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, render};
/// let diagnostic = Diagnostic::at(Code::TrailingComma, Span::new(11, 12), "a comma follows the last element")
///     .fix(Span::new(11, 12), "");
/// let report = Report::new(Source::new("mayor.lipz", r#"{ "fps": 24, }"#), vec![diagnostic]);
/// assert_eq!(
///     render::concise(&[report]),
///     "mayor.lipz:1:12: error[LZ0102]: a comma follows the last element [fixable]\n"
/// );
/// ```
pub fn concise(reports: &[Report]) -> String {
    let mut lines = String::new();
    for report in reports {
        let places = Places::new(report);
        for found in &report.diagnostics {
            lines.push_str(&places.prefix(&report.source.path, found));
            let fixable = if found.fix.as_ref().is_some_and(crate::Fix::is_certain) { " [fixable]" } else { "" };
            let message = escape::text(&found.message);
            let _ = writeln!(lines, "{}[{}]: {message}{fixable}", found.severity, found.code);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Diagnostic, Source, Span};

    #[test]
    fn a_diagnostic_is_one_line() {
        let found = Diagnostic::at(Code::ForeignCode, Span::new(4, 5), "`Z`\nis foreign").note("a note").help("a help");
        let report = Report::new(Source::new("a\nb.lipz", "é\nxZ"), vec![found]);
        assert_eq!(concise(&[report]), "a\\nb.lipz:2:2: error[LZ0401]: `Z`\\nis foreign\n");
        let about = |path| concise(&[Report::about(path, Diagnostic::new(Code::EmptyFile, "empty"))]);
        assert_eq!(about("a.lipz"), "a.lipz: error[LZ0002]: empty\n");
        assert_eq!(about(""), "error[LZ0002]: empty\n");
    }
}
