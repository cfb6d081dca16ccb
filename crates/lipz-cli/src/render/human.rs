//! Findings as text for people: headline, place, caret, notes, help.
//!
//! Keys, paths and texts come from anybody: nothing in them reaches the terminal as a control
//! character.

use crate::console;
use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level as Title, Origin, Renderer, Snippet};
use lipz::diagnostic::show;
use lipz::{Code, Diagnostic, Level, Source};
use lipz_compiler::{Report, count};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, IsTerminal};

/// Findings of one code that a run shows in full; the others are counted.
const SHOWN_PER_CODE: usize = 100;

/// Prints findings, what was left out of them, and a closing count.
pub(super) fn print(reports: &[Report]) {
    let renderer = Renderer::styled().decor_style(DecorStyle::Ascii).term_width(console::width());
    let mut tallies: BTreeMap<Code, Tally<'_>> = BTreeMap::new();
    for report in reports {
        let mut text = String::new();
        let source = &printable(&report.source);
        for diagnostic in &report.diagnostics {
            if tallies.entry(diagnostic.code).or_default().is_shown(report) {
                text.push_str(&renderer.render(&[group(source, diagnostic)]));
                text.push_str("\n\n");
            }
        }
        console::remark(&text);
    }
    for (code, tally) in tallies.iter().filter(|(_, tally)| tally.hidden > 0) {
        let (hidden, files) = (console::grouped(tally.hidden), console::counted(tally.files.len(), "file"));
        console::remark(&format!("{hidden} more {code} ({}) in {files} are not shown\n", code.summary()));
    }
    console::remark(&closing(reports));
}

/// How much was found, in how many files; nothing if nothing was.
fn closing(reports: &[Report]) -> String {
    let (errors, warnings) = (count(reports, Level::Error), count(reports, Level::Warning));
    let parts: Vec<String> = [(errors, "error"), (warnings, "warning")]
        .into_iter()
        .filter(|(number, _)| *number > 0)
        .map(|(number, what)| console::counted(number, what))
        .collect();
    if parts.is_empty() {
        return String::new();
    }
    let files: BTreeSet<&str> = reports.iter().map(|report| report.source.path.as_str()).collect();
    match files.iter().filter(|path| !path.is_empty()).count() {
        0 => format!("{}\n", parts.join(" and ")),
        files => format!("{} in {}\n", parts.join(" and "), console::counted(files, "file")),
    }
}

/// Tells people at a terminal where more about a code is. Logs of builds go without.
pub(super) fn hint(code: Code) {
    if io::stderr().is_terminal() {
        console::remark(&format!("for more about a finding: lipz explain {code}\n"));
    }
}

/// The findings of one code.
#[derive(Default)]
struct Tally<'r> {
    shown: usize,
    hidden: usize,
    /// Paths of the files with hidden findings.
    files: BTreeSet<&'r str>,
}

impl<'r> Tally<'r> {
    /// Counts a finding in the file of `report` and says whether it is one of those that are shown.
    fn is_shown(&mut self, report: &'r Report) -> bool {
        let is_shown = self.shown < SHOWN_PER_CODE;
        if is_shown {
            self.shown += 1;
        } else {
            self.hidden += 1;
            self.files.insert(&report.source.path);
        }
        is_shown
    }
}

/// The file without the control characters U+0080 to U+009F, which the renderer does not replace as it
/// does the others; a terminal may take U+009B for the start of a command. Their stand-in has as many
/// bytes, so that every place stays where it is.
fn printable(source: &Source) -> Cow<'_, Source> {
    let steers = |c: char| matches!(c, '\u{80}'..='\u{9F}');
    if !source.text.contains(steers) {
        return Cow::Borrowed(source);
    }
    Cow::Owned(Source { path: source.path.clone(), text: source.text.replace(steers, "·") })
}

/// The finding as the renderer wants it.
fn group<'r>(source: &'r Source, diagnostic: &'r Diagnostic) -> Group<'r> {
    let title = match diagnostic.level {
        Level::Error => Title::ERROR,
        Level::Warning => Title::WARNING,
    };
    let mut group =
        Group::with_title(title.primary_title(show::text(&diagnostic.headline)).id(diagnostic.code.number()));
    match &diagnostic.primary {
        Some(_) => group = group.element(snippet(source, diagnostic)),
        None if !source.path.is_empty() => group = group.element(Origin::path(show::text(&source.path))),
        None => {}
    }
    for note in &diagnostic.notes {
        group = group.element(Title::NOTE.message(show::text(note)));
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Title::HELP.message(show::text(help)));
    }
    group
}

fn snippet<'r>(source: &'r Source, diagnostic: &'r Diagnostic) -> Snippet<'r, annotate_snippets::Annotation<'r>> {
    let mut snippet = Snippet::source(source.text.as_str()).path(show::text(&source.path));
    let labels = diagnostic.primary.iter().map(|label| (AnnotationKind::Primary, label));
    let others = diagnostic.secondary.iter().map(|label| (AnnotationKind::Context, label));
    for (kind, label) in labels.chain(others) {
        let end = (label.span.end as usize).min(source.text.len());
        let start = (label.span.start as usize).min(end);
        let annotation = kind.span(start..end);
        snippet = snippet.annotation(if label.text.is_empty() {
            annotation
        } else {
            annotation.label(show::text(&label.text))
        });
    }
    snippet
}
