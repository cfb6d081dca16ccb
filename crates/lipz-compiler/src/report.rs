//! Findings grouped by the file that they are about.

use lipz::{Code, Diagnostic, Level, Source};

/// The findings in one file, with its text for showing them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Report {
    /// The file.
    pub source: Source,
    /// What was found, in the order of the places.
    pub diagnostics: Vec<Diagnostic>,
}

impl Report {
    /// One finding about a file as a whole.
    pub fn about(path: impl Into<String>, diagnostic: Diagnostic) -> Report {
        Report::all_about(path, vec![diagnostic])
    }

    /// Findings about a file as a whole.
    pub fn all_about(path: impl Into<String>, diagnostics: Vec<Diagnostic>) -> Report {
        Report { source: Source { path: path.into(), text: String::new() }, diagnostics }
    }

    /// Findings in a file with these bytes.
    pub fn of_file(path: impl Into<String>, bytes: &[u8], diagnostics: Vec<Diagnostic>) -> Report {
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let text = String::from_utf8_lossy(bytes).into_owned();
        Report { source: Source { path: path.into(), text }, diagnostics }
    }

    /// Whether a finding is at error level.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|finding| finding.level == Level::Error)
    }

    /// A finding with a whole-file headline and a help line.
    pub(crate) fn failure(path: impl Into<String>, code: Code, headline: String, help: &str) -> Report {
        Report::about(path, Diagnostic::new(code, headline).help(help))
    }
}

/// The number of findings at this level.
pub fn count(reports: &[Report], level: Level) -> usize {
    reports.iter().flat_map(|report| &report.diagnostics).filter(|diagnostic| diagnostic.level == level).count()
}

/// Whether a finding forbids to write the bank.
pub(crate) fn has_errors(reports: &[Report]) -> bool {
    reports.iter().any(Report::has_errors)
}

/// Sorts reports by path and merges those about the same file.
pub(crate) fn sort(reports: &mut Vec<Report>) {
    reports.retain(|report| !report.diagnostics.is_empty());
    reports.sort_by(|a, b| a.source.path.cmp(&b.source.path));
    reports.dedup_by(|next, kept| {
        let same = next.source.path == kept.source.path;
        if same {
            kept.diagnostics.append(&mut next.diagnostics);
            if kept.source.text.is_empty() {
                kept.source.text = std::mem::take(&mut next.source.text);
            }
            kept.diagnostics.sort_by_key(Diagnostic::start);
        }
        same
    });
}
