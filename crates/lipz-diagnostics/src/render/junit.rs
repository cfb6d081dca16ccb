//! Diagnostics as a JUnit report, which Jenkins, GitLab, Azure Pipelines, TeamCity and others show as tests.

use super::places::Places;
use crate::{Diagnostic, Report, Severity, escape};
use std::fmt::Write;

/// Returns one JUnit report: a test suite per file, a test case per diagnostic. Errors are failures; warnings pass and
/// have their text as output. Without diagnostics, one test case passes, because several tools reject an empty report.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render};
/// let report = Report::about("voices/aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// assert!(render::junit(&[report]).contains(r#"<testcase name="LZ0002 empty-file" classname="voices/aye.lipz">"#));
/// ```
pub fn junit(reports: &[Report]) -> String {
    let reports: Vec<&Report> = reports.iter().filter(|report| !report.diagnostics.is_empty()).collect();
    let [tests, failures] = reports.iter().map(|report| totals(report)).fold([0, 0], |[a, b], [c, d]| [a + c, b + d]);
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let _ = writeln!(xml, "<testsuites name=\"lipz\" tests=\"{}\" failures=\"{failures}\">", tests.max(1));
    if reports.is_empty() {
        xml.push_str("  <testsuite name=\"lipz\" tests=\"1\" failures=\"0\">\n");
        xml.push_str("    <testcase name=\"no diagnostics\" classname=\"lipz\"/>\n  </testsuite>\n");
    }
    for report in reports {
        suite(&mut xml, report);
    }
    xml + "</testsuites>\n"
}

/// Returns the number of diagnostics of a file, and of errors among them.
fn totals(report: &Report) -> [usize; 2] {
    [report.diagnostics.len(), report.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()]
}

fn suite(xml: &mut String, report: &Report) {
    let places = Places::new(report);
    // Diagnostics without a file belong to the run.
    let path = if report.source.path.is_empty() { "lipz" } else { &report.source.path };
    let [tests, failures] = totals(report);
    let class = escaped(path);
    let _ = writeln!(xml, "  <testsuite name=\"{class}\" tests=\"{tests}\" failures=\"{failures}\">");
    for diagnostic in &report.diagnostics {
        case(xml, &class, &places.prefix(&report.source.path, diagnostic), &line(&places, diagnostic), diagnostic);
    }
    xml.push_str("  </testsuite>\n");
}

/// Returns the start of a diagnostic, as an attribute.
fn line(places: &Places, diagnostic: &Diagnostic) -> String {
    let line = diagnostic.primary.as_ref().map(|label| places.ends(label.span)[0].line);
    line.map(|line| format!(" line=\"{line}\"")).unwrap_or_default()
}

fn case(xml: &mut String, class: &str, place: &str, line: &str, diagnostic: &Diagnostic) {
    let name = format!("{} {}", diagnostic.code, diagnostic.code.name());
    let _ = writeln!(xml, "    <testcase name=\"{name}\" classname=\"{class}\"{line}>");
    let text = escaped(&format!("{place}{diagnostic}"));
    let _ = match diagnostic.severity {
        Severity::Error => {
            let message = escaped(&diagnostic.message);
            writeln!(xml, "      <failure type=\"{}\" message=\"{message}\">{text}</failure>", diagnostic.code)
        }
        Severity::Warning => writeln!(xml, "      <system-out>{text}</system-out>"),
    };
    xml.push_str("    </testcase>\n");
}

/// Escapes text between quotes or tags. XML 1.0 cannot represent control characters, so they are shown in JSON's
/// spelling.
fn escaped(text: &str) -> String {
    let mut lines = text.split('\n').map(escape::text).collect::<Vec<_>>().join("\n");
    for (character, reference) in [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;")] {
        lines = lines.replace(character, reference);
    }
    // The other two characters that XML 1.0 forbids.
    lines.replace(['\u{FFFE}', '\u{FFFF}'], "\u{FFFD}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Source, Span};

    #[test]
    fn an_xml_parser_reads_back_what_was_found() {
        let found = [
            Diagnostic::at(Code::ForeignCode, Span::new(2, 3), "`<` & \"\u{1}\" \u{FFFE}").help("use - ]]>"),
            Diagnostic::at(Code::UnknownElement, Span::new(0, 1), "odd"),
        ];
        let reports = [
            Report::new(Source::new("a \"b\" & <c>.lipz", "{\n<}"), found.into()),
            Report::about("clean.lipz", Diagnostic::new(Code::EmptyDocument, "empty")),
            Report::about("", Diagnostic::new(Code::NoSources, "none")),
            Report::new(Source::new("nothing.lipz", ""), Vec::new()),
        ];
        let xml = junit(&reports);
        let document = roxmltree::Document::parse(&xml).unwrap();
        let root = document.root_element();
        assert_eq!((root.attribute("tests"), root.attribute("failures")), (Some("4"), Some("2")));
        let suites: Vec<_> = root.children().filter_map(|suite| suite.attribute("name")).collect();
        assert_eq!(suites, ["a \"b\" & <c>.lipz", "clean.lipz", "lipz"]);
        let failures: Vec<_> = document.descendants().filter(|node| node.has_tag_name("failure")).collect();
        assert_eq!(failures[0].attribute("message"), Some("`<` & \"\\u0001\" \u{FFFD}"));
        assert_eq!(
            failures[0].text(),
            Some("a \"b\" & <c>.lipz:2:1: error[LZ0401]: `<` & \"\\u0001\" \u{FFFD}\n  help: use - ]]>\n")
        );
        assert_eq!(failures[0].parent().and_then(|case| case.attribute("line")), Some("2"));
        let passed = document.descendants().filter(|node| node.has_tag_name("system-out")).count();
        assert_eq!(passed, 2);
    }

    #[test]
    fn no_diagnostics_are_a_test_that_passed() {
        let xml = junit(&[]);
        let document = roxmltree::Document::parse(&xml).unwrap();
        assert_eq!(document.root_element().attribute("tests"), Some("1"));
        assert_eq!(document.descendants().filter(|node| node.has_tag_name("testcase")).count(), 1);
    }
}
