//! Diagnostics as workflow commands of GitHub Actions, which shows them next to the changed lines.

use super::places::Places;
use crate::Diagnostic;
use crate::Report;
use crate::escape;
use std::fmt::Write;

/// Returns workflow commands of GitHub Actions, one line per diagnostic. GitHub shows them next to the changed lines.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render};
/// let report = Report::about("voices/aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// assert_eq!(
///     render::github(&[report]),
///     "::error file=voices/aye.lipz,title=LZ0002 empty-file::the file is empty\n"
/// );
/// ```
pub fn github(reports: &[Report]) -> String {
    let mut text = String::new();
    for report in reports {
        let places = Places::new(report);
        for diagnostic in &report.diagnostics {
            text.push_str(&annotation(&report.source.path, &places, diagnostic));
        }
    }
    text
}

fn annotation(path: &str, places: &Places, diagnostic: &Diagnostic) -> String {
    let mut command = format!("::{} ", diagnostic.severity);
    if !path.is_empty() {
        let _ = write!(command, "file={},", property(path));
    }
    if let Some(label) = &diagnostic.primary {
        let [start, end] = places.ends(label.span);
        let _ = write!(command, "line={},endLine={},", start.line, end.line);
        // GitHub accepts columns only for ranges within one line.
        if start.line == end.line {
            let _ = write!(command, "col={},endColumn={},", start.column, end.column);
        }
    }
    let title = format!("{} {}", diagnostic.code, diagnostic.code.name());
    let _ = writeln!(command, "title={}::{}", property(&title), data(&message(diagnostic)));
    command
}

/// Returns the message, notes and help, one per line.
fn message(diagnostic: &Diagnostic) -> String {
    let mut message = diagnostic.message.clone();
    for note in &diagnostic.notes {
        let _ = write!(message, "\nnote: {note}");
    }
    if let Some(help) = &diagnostic.help {
        let _ = write!(message, "\nhelp: {help}");
    }
    message
}

/// Returns the text after `::`, escaped like GitHub's toolkit (`escapeData`), so that no part of it can start a line of
/// the log and act as a command.
fn data(text: &str) -> String {
    escape::text(&text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")).into_owned()
}

/// Returns the value of a property, escaped like GitHub's toolkit (`escapeProperty`).
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Source, Span};

    fn annotated(found: Diagnostic) -> String {
        let source = Source { path: "act 1, a:b/100%.lipz".into(), text: "{\n  \"é\": 1\n}".into() };
        github(&[Report { source, diagnostics: vec![found] }])
    }

    #[test]
    fn texts_cannot_leave_their_command() {
        let found = Diagnostic::at(Code::UnknownElement, Span::new(4, 8), "a\r\n::error::b, 100%")
            .note("c\u{1b}[2J")
            .help("d: e");
        assert_eq!(
            annotated(found),
            "::warning file=act 1%2C a%3Ab/100%25.lipz,line=2,endLine=2,col=3,endColumn=6,\
             title=LZ0203 unknown-element::a%0D%0A::error::b, 100%25%0Anote: c\\u001B[2J%0Ahelp: d: e\n"
        );
    }

    #[test]
    fn columns_are_left_out_of_several_lines() {
        let found = Diagnostic::at(Code::JsonSyntax, Span::new(0, 13), "x");
        let text = annotated(found);
        assert!(text.contains(",line=1,endLine=3,title="), "{text}");
        assert!(text.starts_with("::error file="), "{text}");
    }

    #[test]
    fn diagnostics_without_a_file_have_a_title() {
        assert_eq!(
            github(&[Report::about("", Diagnostic::new(Code::NoSources, "none"))]),
            "::error title=LZ0805 no-sources::none\n"
        );
    }
}
