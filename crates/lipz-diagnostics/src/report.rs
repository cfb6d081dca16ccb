//! Findings grouped by the file that they are about.

use crate::{Code, Diagnostic, Severity, Source, escape};
use std::fmt;

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// The findings in one file, with its text for showing them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Report {
    /// The file.
    pub source: Source,
    /// What was found, in the order of the places.
    pub diagnostics: Vec<Diagnostic>,
}

impl Report {
    /// Findings in a file, in the order of their places.
    pub fn new(source: Source, diagnostics: Vec<Diagnostic>) -> Report {
        Report { source, diagnostics }
    }

    /// One finding about a file as a whole.
    pub fn about(path: impl Into<String>, diagnostic: Diagnostic) -> Report {
        Report::all_about(path, vec![diagnostic])
    }

    /// Findings about a file as a whole.
    pub fn all_about(path: impl Into<String>, diagnostics: Vec<Diagnostic>) -> Report {
        Report { source: Source { path: path.into(), text: String::new() }, diagnostics }
    }

    /// Findings in a file with these bytes: a byte order mark is no part of the text, and what is not UTF-8
    /// is replaced.
    pub fn from_bytes(path: impl Into<String>, bytes: &[u8], diagnostics: Vec<Diagnostic>) -> Report {
        let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
        Report::new(Source::new(path, String::from_utf8_lossy(text)), diagnostics)
    }

    /// Whether a finding is at error level.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|finding| finding.severity == Severity::Error)
    }

    /// A finding with a whole-file message and a help line.
    pub fn failure(path: impl Into<String>, code: Code, message: impl Into<String>, help: &str) -> Report {
        Report::about(path, Diagnostic::new(code, message).help(help))
    }
}

/// Each diagnostic with its place, `voices/mayor.lipz:3:16: error[LZ0401]: …`, as compilers write them.
/// [`render::human`](crate::render::human) shows the marked source, too.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for diagnostic in &self.diagnostics {
            if !self.source.path.is_empty() {
                write!(f, "{}:", escape::text(&self.source.path))?;
                if let Some(label) = &diagnostic.primary {
                    let place = self.source.line_column(label.span.start);
                    write!(f, "{}:{}:", place.line, place.column)?;
                }
                f.write_str(" ")?;
            }
            write!(f, "{diagnostic}")?;
        }
        Ok(())
    }
}

/// The number of findings at this level.
pub fn count(reports: &[Report], severity: Severity) -> usize {
    reports.iter().flat_map(|report| &report.diagnostics).filter(|diagnostic| diagnostic.severity == severity).count()
}

/// Whether a finding forbids to write the bank.
pub fn has_errors(reports: &[Report]) -> bool {
    reports.iter().any(Report::has_errors)
}

/// Sorts reports by path and merges those about the same file.
pub fn sort(reports: &mut Vec<Report>) {
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
