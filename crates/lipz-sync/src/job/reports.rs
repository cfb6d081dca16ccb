//! Reporting of a job's diagnostics, at the levels of the project.

use super::SyncOptions;
use lipz_diagnostics::{Diagnostic, Report};

/// Reports diagnostics of a Lipz file, at the project's levels. Returns whether one is an error.
pub(super) fn push(
    reports: &mut Vec<Report>,
    options: &SyncOptions,
    name: &str,
    bytes: &[u8],
    mut diagnostics: Vec<Diagnostic>,
) -> bool {
    options.options.levels_for(name).apply(&mut diagnostics);
    let has_errors = diagnostics.iter().any(Diagnostic::is_error);
    diagnostics.sort_by_key(Diagnostic::start);
    if !diagnostics.is_empty() {
        reports.push(Report::from_bytes(name, bytes, diagnostics));
    }
    has_errors
}

/// Reports diagnostics of other files, at the project's levels.
pub(super) fn push_report(reports: &mut Vec<Report>, options: &SyncOptions, report: Option<Report>) {
    reports.extend(report.map(|mut report| {
        options.options.apply_levels(&mut report);
        report
    }));
}
