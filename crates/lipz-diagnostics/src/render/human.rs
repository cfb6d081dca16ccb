//! Diagnostics as text for people: message, position, caret, notes, help.
//!
//! Keys, paths and texts are untrusted: they must not output control characters to the terminal (`visible_text.rs` ensures
//! this in excerpts).

use super::excerpt::{Excerpt, Mark, excerpts};
use super::places::Places;
use super::visible_text::VisibleText;
use crate::Report;
use crate::escape;
use crate::reports::count;
use crate::{Code, Diagnostic, Severity, Source};
use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level as Title, Origin, Renderer, Snippet};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// The most diagnostics of one code that a run shows in full; the rest are counted.
const SHOWN_PER_CODE: usize = 100;

/// Returns text for people: message, position, caret, notes and help of each diagnostic, 100 columns wide, without
/// colours. [`HumanStyle`] has options for width and colours.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, render};
/// let diagnostic = Diagnostic::at(Code::ForeignCode, Span::new(15, 16), "`Z` is not a blair code");
/// let report = Report::new(Source::new("mayor.lipz", r#"{ "visemes": "MZ" }"#), vec![diagnostic]);
/// assert_eq!(
///     render::human(&[report]),
///     "error[LZ0401]: `Z` is not a blair code
///  --> mayor.lipz:1:16
///   |
/// 1 | { \"visemes\": \"MZ\" }
///   |                ^
///
/// 1 error in 1 file
/// "
/// );
/// ```
pub fn human(reports: &[Report]) -> String {
    HumanStyle::default().render(reports)
}

/// Options of text for people.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Report, render::HumanStyle};
/// let report = Report::about("aye.lipz", Diagnostic::new(Code::EmptyFile, "the file is empty"));
/// let coloured = HumanStyle::default().width(80).styled(true).render(&[report]);
/// assert!(coloured.contains("\u{1b}["));
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct HumanStyle {
    width: usize,
    is_styled: bool,
}

impl Default for HumanStyle {
    fn default() -> HumanStyle {
        HumanStyle { width: 100, is_styled: false }
    }
}

impl HumanStyle {
    /// Sets the number of columns of the terminal.
    #[must_use]
    pub fn width(mut self, columns: usize) -> HumanStyle {
        self.width = columns;
        self
    }

    /// Enables colours, as ANSI escape sequences.
    #[must_use]
    pub fn styled(mut self, is_styled: bool) -> HumanStyle {
        self.is_styled = is_styled;
        self
    }

    /// Returns all diagnostics, at most 100 per code, the number of the others, and a final count. Empty without
    /// diagnostics.
    pub fn render(self, reports: &[Report]) -> String {
        let renderer = if self.is_styled { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii).term_width(self.width);
        let mut tallies: BTreeMap<Code, Tally<'_>> = BTreeMap::new();
        let mut text = String::new();
        for report in reports {
            let places = Places::new(report);
            for diagnostic in &report.diagnostics {
                if tallies.entry(diagnostic.code).or_default().is_shown(report, diagnostic.rest) {
                    text.push_str(&shown(&renderer, &report.source, &places, diagnostic));
                    text.push_str("\n\n");
                }
            }
        }
        for (code, tally) in tallies.iter().filter(|(_, tally)| tally.hidden > 0) {
            let (hidden, files) = (grouped(tally.hidden), counted(tally.files.len(), "file"));
            let _ = writeln!(text, "{hidden} more {code} ({}) in {files} are not shown", code.summary());
        }
        text + &closing(reports)
    }
}

/// Returns the numbers of diagnostics, files and certain fixes. Empty without diagnostics.
fn closing(reports: &[Report]) -> String {
    let (errors, warnings) = (count(reports, Severity::Error), count(reports, Severity::Warning));
    let parts: Vec<String> = [(errors, "error"), (warnings, "warning")]
        .into_iter()
        .filter(|(number, _)| *number > 0)
        .map(|(number, what)| counted(number, what))
        .collect();
    if parts.is_empty() {
        return String::new();
    }
    let files: BTreeSet<&str> = reports.iter().map(|report| report.source.path.as_str()).collect();
    let mut text = parts.join(" and ");
    let files = files.iter().filter(|path| !path.is_empty()).count();
    if files > 0 {
        let _ = write!(text, " in {}", counted(files, "file"));
    }
    let fixable = reports.iter().flat_map(|report| &report.diagnostics).flat_map(Diagnostic::fixes).count();
    if fixable > 0 {
        let _ = write!(text, "; {} fixable", grouped(fixable));
    }
    text + "\n"
}

/// Returns a number with commas: 1,234,567.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let first = digits.len() % 3;
    let group = |(place, digit)| (place > 0 && place % 3 == first).then_some(',').into_iter().chain([digit]);
    digits.chars().enumerate().flat_map(group).collect()
}

/// Returns `1 file` or `2 files`.
fn counted(number: usize, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {what}{plural}", grouped(number))
}

/// The diagnostics of one code.
#[derive(Default)]
struct Tally<'r> {
    shown: usize,
    hidden: usize,
    /// Paths of the files with hidden diagnostics.
    files: BTreeSet<&'r str>,
}

impl<'r> Tally<'r> {
    /// Counts a diagnostic in the file of `report`, and returns whether to show it.
    fn is_shown(&mut self, report: &'r Report, rest: usize) -> bool {
        let is_shown = self.shown < SHOWN_PER_CODE && rest == 0;
        if is_shown {
            self.shown += 1;
        } else {
            self.hidden += rest.max(1);
            self.files.insert(&report.source.path);
        }
        is_shown
    }
}

/// Returns the diagnostic in full.
fn shown(renderer: &Renderer, source: &Source, places: &Places, diagnostic: &Diagnostic) -> String {
    let title = match diagnostic.severity {
        Severity::Error => Title::ERROR,
        Severity::Warning => Title::WARNING,
    };
    let path = escape::text(&source.path);
    let mut message = escape::text(&diagnostic.message);
    if diagnostic.fix.as_ref().is_some_and(crate::Fix::is_certain) {
        message += " [fixable]";
    }
    let mut group = Group::with_title(title.primary_title(message).id(diagnostic.code.number()));
    let mut counted_wrongly = Vec::new();
    let visible = VisibleText::new(&source.text, diagnostic);
    for excerpt in excerpts(&source.text, places, diagnostic) {
        let mark = excerpt.marks.first().filter(|_| visible.replaces(excerpt.text));
        let place = excerpt.place.or_else(|| mark.map(|(_, label, _)| places.ends(label.span)[0]));
        let path = match place {
            None => path.clone().into_owned(),
            Some(place) => format!("{path}:{}:{}", place.line, place.column),
        };
        counted_wrongly.extend(place.map(|_| path.clone()));
        group = group.element(snippet(path, excerpt, &visible));
    }
    if diagnostic.primary.is_none() && !path.is_empty() {
        group = group.element(Origin::path(path.as_ref()));
    }
    for note in &diagnostic.notes {
        group = group.element(Title::NOTE.message(escape::text(note)));
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Title::HELP.message(escape::text(help)));
    }
    let text = visible.restored(renderer.render(&[group]));
    counted_wrongly.iter().fold(text, |text, place| without_count(&text, place))
}

fn snippet<'r>(
    path: String,
    excerpt: Excerpt<'r>,
    visible: &VisibleText,
) -> Snippet<'r, annotate_snippets::Annotation<'r>> {
    let text = visible.text(excerpt.text);
    let mut snippet = Snippet::source(text).line_start(excerpt.first_line).path(path);
    for (kind, label, place) in excerpt.marks {
        let place = visible.place(excerpt.text, place);
        let annotation = if kind == Mark::Primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = annotation.span(place);
        snippet = snippet.annotation(if label.text.is_empty() {
            annotation
        } else {
            annotation.label(escape::text(&label.text))
        });
    }
    snippet
}

/// Returns the text without the renderer's own line and column, which follow the correct ones.
fn without_count(text: &str, place: &str) -> String {
    let Some((before, behind)) = text.split_once(&format!("{place}:")) else { return text.to_owned() };
    format!("{before}{place}{}", behind.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_places_do_not_stop_any_renderer() {
        let text = "\u{feff}é\n灯\u{1a}x";
        for start in 0..14 {
            for end in 0..14 {
                let span = crate::Span { start, end };
                let diagnostic = Diagnostic::at(Code::JsonSyntax, span, "m").also(span, "l").fix(span, "f");
                let reports = [Report::new(Source::new("a", text), vec![diagnostic])];
                assert!(human(&reports).contains("error[LZ0101]: m"));
                #[cfg(feature = "json")]
                {
                    crate::render::json(&reports);
                    crate::render::sarif(&reports, true);
                }
                crate::render::github(&reports);
                crate::render::cargo(&reports);
            }
        }
    }

    #[test]
    fn numbers_have_commas() {
        let shown = [0, 12, 999, 1_000, 54_321, 123_456, 1_234_567].map(grouped);
        assert_eq!(shown, ["0", "12", "999", "1,000", "54,321", "123,456", "1,234,567"]);
    }
}
