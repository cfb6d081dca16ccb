//! Diagnostics grouped by file.

use crate::render::Places;
use crate::{Code, Diagnostic, Severity, Source};
use std::fmt;

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Replaces a byte that is not UTF-8: the substitute character of ASCII, which is one byte long.
const SUBSTITUTE: char = '\u{1A}';

/// The diagnostics of one file, with its text for excerpts.
#[derive(Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Report {
    /// The file.
    pub source: Source,
    /// The diagnostics, ordered by position.
    pub diagnostics: Vec<Diagnostic>,
}

impl Report {
    /// Returns diagnostics in a file, ordered by position. Their spans refer to the text of `source`.
    pub fn new(source: Source, diagnostics: Vec<Diagnostic>) -> Report {
        Report { source, diagnostics }
    }

    /// Returns one diagnostic about a file as a whole, or without a file if `path` is empty.
    pub fn about(path: impl Into<String>, diagnostic: Diagnostic) -> Report {
        Report::all_about(path, vec![diagnostic])
    }

    /// Returns diagnostics about a file as a whole.
    pub fn all_about(path: impl Into<String>, diagnostics: Vec<Diagnostic>) -> Report {
        Report::new(Source::new(path, ""), diagnostics)
    }

    /// Returns diagnostics in a file with these bytes. A byte order mark is not part of the text, and each byte that is
    /// not UTF-8 is replaced by one U+001A, so that positions do not change.
    pub fn from_bytes(path: impl Into<String>, bytes: &[u8], diagnostics: Vec<Diagnostic>) -> Report {
        let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
        Report::new(Source::new(path, readable(text)), diagnostics)
    }

    /// Returns a diagnostic with a help line about a file as a whole, or without a file if `path` is empty.
    pub fn failure(path: impl Into<String>, code: Code, message: impl Into<String>, help: &str) -> Report {
        Report::about(path, Diagnostic::new(code, message).help(help))
    }

    /// Returns the number of diagnostics with this severity.
    pub fn count(&self, severity: Severity) -> usize {
        let of_severity = self.diagnostics.iter().filter(|diagnostic| diagnostic.severity == severity);
        of_severity.map(Diagnostic::count).sum()
    }

    /// Whether a diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Returns the bytes as text, in which bytes that are not UTF-8 are replaced by substitutes of the same length.
fn readable(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        text.extend(chunk.invalid().iter().map(|_| SUBSTITUTE));
    }
    text
}

/// Prints each diagnostic with its position, `voices/mayor.lipz:3:16: error[LZ0401]: …`, in the format of compilers.
/// [`render::human`](crate::render::human) also shows the marked source.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let places = Places::new(self);
        for diagnostic in &self.diagnostics {
            f.write_str(&places.prefix(&self.source.path, diagnostic))?;
            write!(f, "{diagnostic}")?;
        }
        Ok(())
    }
}

/// Prints the same text, because a `main` that returns the report as an error prints it this way.
impl fmt::Debug for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.diagnostics.len() {
            0 => write!(f, "no diagnostics in {:?}", self.source.path),
            _ => f.write_str(self.to_string().trim_end()),
        }
    }
}

/// A report also serves as an error: `?` returns it, and it prints its diagnostics.
impl std::error::Error for Report {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Span;

    #[test]
    fn reports_are_shown_with_places() {
        let mut report = Report::from_bytes(
            "a\u{1b}.lipz",
            b"\xEF\xBB\xBF{\n\xFF \"fps\": 0 }",
            vec![
                Diagnostic::new(Code::ByteOrderMark, "a mark"),
                Diagnostic::at(Code::FpsOutOfRange, Span::new(11, 12), "0 is no\nrate").note("a note").help("a help"),
            ],
        );
        assert_eq!(
            report.to_string(),
            "a\\u001B.lipz: warning[LZ0005]: a mark\n\
             a\\u001B.lipz:2:10: error[LZ0301]: 0 is no\\nrate\n  note: a note\n  help: a help\n"
        );
        assert_eq!([Severity::Error, Severity::Warning].map(|severity| report.count(severity)), [1, 1]);
        assert!(report.has_errors());
        report.diagnostics.truncate(1);
        assert!(!report.has_errors());
        let nowhere = Report::failure("", Code::Usage, "no", "yes");
        assert_eq!(nowhere.to_string(), "error[LZ1601]: no\n  help: yes\n");
        assert_eq!(format!("{nowhere:?}"), "error[LZ1601]: no\n  help: yes", "what a `main` prints");
        assert_eq!(format!("{:?}", Report::default()), "no diagnostics in \"\"");
    }
}
