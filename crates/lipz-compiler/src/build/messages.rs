//! What build scripts print for cargo (The Cargo Book, "Outputs of the Build Script"): one line per
//! message, nothing of which can be taken for another.

use crate::{Report, discover};
use lipz::diagnostic::show;
use lipz::{Code, Diagnostic, Level, Source};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// Findings of one code that are told; the others are counted.
const TOLD_PER_CODE: usize = 100;

/// The lines that run the script again when something at `paths` changes; cargo looks at all that
/// is below a folder. A path that one line cannot spell is spelled so that it does not exist: then
/// the script always runs.
pub(super) fn watched(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| format!("cargo::rerun-if-changed={}\n", show::text(&discover::display(path)))).collect()
}

/// A line per finding, and one per code that has too many.
pub(super) fn findings(reports: &[Report]) -> String {
    let mut lines = String::new();
    let mut counts: BTreeMap<(Code, Level), usize> = BTreeMap::new();
    for report in reports {
        for found in &report.diagnostics {
            let count = counts.entry((found.code, found.level)).or_default();
            *count += 1;
            if *count <= TOLD_PER_CODE {
                line(&mut lines, found.level, &message(&report.source, found));
            }
        }
    }
    for ((code, level), count) in counts {
        if count > TOLD_PER_CODE {
            let more = count - TOLD_PER_CODE;
            line(&mut lines, level, &format!("{more} more of {code}: {}", code.summary()));
        }
    }
    lines
}

fn line(lines: &mut String, level: Level, message: &str) {
    let _ = writeln!(lines, "cargo::{level}={}", show::text(message));
}

/// `voices/mayor.lipz:3:16: what is wrong [LZ0401]; help: what to do`.
fn message(source: &Source, found: &Diagnostic) -> String {
    let mut message = String::new();
    if !source.path.is_empty() {
        message.push_str(&source.path);
        if found.primary.is_some() {
            let place = source.line_column(found.start());
            let _ = write!(message, ":{}:{}", place.line, place.column);
        }
        message.push_str(": ");
    }
    let _ = write!(message, "{} [{}]", found.headline, found.code);
    // Notes that start with a blank are rows of a table, which makes no sense on one line.
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
    use lipz::Span;

    fn report(path: &str, text: &str, diagnostics: Vec<Diagnostic>) -> Report {
        Report { source: Source { path: path.into(), text: text.into() }, diagnostics }
    }

    #[test]
    fn a_finding_is_one_line() {
        let found = Diagnostic::at(Code::ForeignCode, Span::new(4, 5), "`Z` is foreign").help("use\nanother");
        let lines = findings(&[report("a\ncargo::rustc-env=X=1.lipz", "é\nxZ", vec![found])]);
        assert_eq!(
            lines,
            "cargo::error=a\\ncargo::rustc-env=X=1.lipz:2:2: `Z` is foreign [LZ0401]; help: use\\nanother\n"
        );
        let lines = findings(&[report("", "", vec![Diagnostic::new(Code::EmptyDocument, "empty")])]);
        assert_eq!(lines, "cargo::warning=empty [LZ0204]\n");
        assert_eq!(watched(&["a\nb".into()]), "cargo::rerun-if-changed=a\\nb\n");
    }

    #[test]
    fn many_findings_of_one_code_are_counted() {
        let many = (0..250).map(|_| Diagnostic::new(Code::UnknownElement, "odd")).collect();
        let lines = findings(&[report("a.lipz", "", many)]);
        assert_eq!(lines.lines().count(), TOLD_PER_CODE + 1);
        assert!(lines.ends_with("cargo::warning=150 more of LZ0203: an element is not one of the format\n"), "{lines}");
    }
}
