//! All reports of a run: how many diagnostics they have, and their order.
//!
//! ```
//! use lipz_diagnostics::{Code, Diagnostic, Report, Severity, reports};
//! let about = |path: &str, code| Report::about(path, Diagnostic::new(code, ""));
//! let mut all = vec![about("b.lipz", Code::EmptyFile), about("a.lipz", Code::EmptyDocument)];
//! reports::sort(&mut all);
//! assert_eq!(all[0].source.path, "a.lipz");
//! assert_eq!(reports::count(&all, Severity::Error), 1);
//! assert!(reports::have_errors(&all));
//! ```

use crate::{Diagnostic, Report, Severity};

/// The number of diagnostics with this severity.
pub fn count(reports: &[Report], severity: Severity) -> usize {
    reports.iter().map(|report| report.count(severity)).sum()
}

/// Whether a diagnostic is an error, so that no bank is written.
pub fn have_errors(reports: &[Report]) -> bool {
    reports.iter().any(Report::has_errors)
}

/// Sorts reports by path and merges those about the same file. Reports without diagnostics are dropped.
pub fn sort(reports: &mut Vec<Report>) {
    reports.retain(|report| !report.diagnostics.is_empty());
    reports.sort_by(|a, b| a.source.path.cmp(&b.source.path));
    reports.dedup_by(|next, kept| {
        let is_same = next.source.path == kept.source.path;
        if is_same {
            kept.diagnostics.append(&mut next.diagnostics);
            if kept.source.text.is_empty() {
                kept.source.text = std::mem::take(&mut next.source.text);
            }
            kept.diagnostics.sort_by_key(Diagnostic::start);
        }
        is_same
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Source, Span};

    #[test]
    fn reports_about_a_file_are_merged() {
        let at = |start| Diagnostic::at(Code::UnknownElement, Span::new(start, start + 1), "");
        let text = Report::new(Source::new("b", "{ }"), vec![at(2), at(0)]);
        let mut reports = vec![
            Report::new(Source::new("c", ""), vec![]),
            Report::about("b", Diagnostic::new(Code::KeyClash, "")),
            text,
            Report::about("a", Diagnostic::new(Code::EmptyFile, "")),
        ];
        sort(&mut reports);
        assert_eq!(reports.iter().map(|report| report.source.path.as_str()).collect::<Vec<_>>(), ["a", "b"]);
        let merged = &reports[1];
        assert_eq!(merged.source.text, "{ }");
        assert_eq!(merged.diagnostics.iter().map(Diagnostic::start).collect::<Vec<_>>(), [0, 0, 2]);
        assert_eq!(count(&reports, Severity::Warning), 2);
    }
}
