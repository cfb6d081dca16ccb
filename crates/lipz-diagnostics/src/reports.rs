//! All reports of a run: their counts and their order.
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

use crate::{Code, Diagnostic, Report, Severity};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The number of diagnostics of a rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Frequency {
    /// The rule.
    pub code: Code,
    /// The highest severity of its diagnostics.
    pub severity: Severity,
    /// The number of diagnostics, including those that are only counted.
    pub count: usize,
    /// The number of diagnostics with a certain fix.
    pub fixable: usize,
}

/// Returns the number of diagnostics with this severity.
pub fn count(reports: &[Report], severity: Severity) -> usize {
    reports.iter().map(|report| report.count(severity)).sum()
}

/// Whether a diagnostic is an error, so that no bank is written.
pub fn have_errors(reports: &[Report]) -> bool {
    reports.iter().any(Report::has_errors)
}

/// Returns the counts of all rules with diagnostics, the most frequent first.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, reports};
/// let found = vec![Diagnostic::new(Code::EmptyDocument, ""), Diagnostic::new(Code::UnknownElement, "")];
/// let all = [Report::all_about("a.lipz", found), Report::about("b.lipz", Diagnostic::new(Code::UnknownElement, ""))];
/// let counts = reports::frequencies(&all);
/// assert_eq!((counts[0].code, counts[0].count), (Code::UnknownElement, 2));
/// ```
pub fn frequencies(reports: &[Report]) -> Vec<Frequency> {
    let mut by_code: BTreeMap<Code, Frequency> = BTreeMap::new();
    for found in reports.iter().flat_map(|report| &report.diagnostics) {
        let none = Frequency { code: found.code, severity: found.severity, count: 0, fixable: 0 };
        let frequency = by_code.entry(found.code).or_insert(none);
        frequency.severity = frequency.severity.max(found.severity);
        frequency.count += found.count();
        frequency.fixable += found.fixes().count();
    }
    let mut frequencies: Vec<Frequency> = by_code.into_values().collect();
    frequencies.sort_by_key(|frequency| Reverse(frequency.count));
    frequencies
}

/// Sorts reports by path and merges those of the same file. Removes reports without diagnostics.
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
    use crate::{Source, Span};

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
