//! The part of a file that shows a diagnostic. The renderer measures its whole input for each diagnostic again, and
//! shows every character between the marks of a line. For a whole long file, that would take seconds.

use super::places::Places;
use crate::{Diagnostic, Label, LineColumn};
use std::ops::Range;

/// The bytes of a line that are kept before its first mark and after its last one, which exceed the width of a
/// terminal.
const MARGIN_BYTES: usize = 4096;

/// The most bytes of a mark that are shown, more than a reader needs.
const MARK_BYTES: usize = 1024;

/// The greatest distance of marks that are shown together.
const NEAR_BYTES: usize = 1 << 16;

/// The kind of a mark.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Mark {
    /// The diagnostic.
    Primary,
    /// A position that belongs to the diagnostic.
    Other,
}

/// Lines with the marks of a diagnostic.
pub(super) struct Excerpt<'r> {
    /// The lines; only the parts around the marks if they are long.
    pub(super) text: &'r str,
    /// The number of the first line, from 1.
    pub(super) first_line: usize,
    /// The marks, with their ranges in `text`.
    pub(super) marks: Vec<(Mark, &'r Label, Range<usize>)>,
    /// The position of the first mark, if the text does not start at the start of a line, so that columns cannot be
    /// counted.
    pub(super) place: Option<LineColumn>,
}

/// Returns the excerpts for the marks of a diagnostic in `whole`. The first one has the primary mark.
pub(super) fn excerpts<'r>(whole: &'r str, places: &Places, diagnostic: &'r Diagnostic) -> Vec<Excerpt<'r>> {
    let Some(label) = &diagnostic.primary else { return Vec::new() };
    let primary = marked(whole, label);
    let others = diagnostic.labels.iter().map(|label| (Mark::Other, label, marked(whole, label)));
    let (near, far): (Vec<_>, Vec<_>) = others.partition(|(.., mark)| are_near(whole, &primary, mark));
    let first = std::iter::once((Mark::Primary, label, primary)).chain(near).collect();
    let groups = std::iter::once(first).chain(far.into_iter().map(|mark| vec![mark]));
    groups.map(|marks| Excerpt::new(whole, places, marks)).collect()
}

impl<'r> Excerpt<'r> {
    fn new(whole: &'r str, places: &Places, mut marks: Vec<(Mark, &'r Label, Range<usize>)>) -> Excerpt<'r> {
        let first = marks.iter().map(|(.., mark)| mark.start).min().unwrap_or_default();
        let last = marks.iter().map(|(.., mark)| mark.end).max().unwrap_or_default();
        let line = line_start(whole, first);
        let start = line.unwrap_or_else(|| whole.floor_char_boundary(first - MARGIN_BYTES));
        let tail = whole.ceil_char_boundary(last.saturating_add(MARGIN_BYTES));
        let end = whole[last..tail].find('\n').map_or(tail, |line_break| last + line_break + 1);
        let place_of = |label: &Label| places.ends(label.span)[0];
        let first_mark = marks.iter().min_by_key(|(.., mark)| mark.start).map(|(_, label, _)| place_of(label));
        let first_line = first_mark.map_or(1, |place| place.line as usize) - whole[start..first].matches('\n').count();
        let place = marks.first().filter(|_| line.is_none()).map(|(_, label, _)| place_of(label));
        marks.iter_mut().for_each(|(.., mark)| *mark = mark.start - start..mark.end - start);
        Excerpt { text: &whole[start..end], first_line, marks, place }
    }
}

/// Returns the start of the line with this position; `None` if that is too far before it.
fn line_start(whole: &str, at: usize) -> Option<usize> {
    // A mark after the last line break is shown in the line that ends there.
    let at = whole.floor_char_boundary(at.min(whole.len().saturating_sub(1)));
    let from = at.saturating_sub(MARGIN_BYTES);
    let line_break = whole.as_bytes()[from..at].iter().rposition(|&byte| byte == b'\n');
    line_break.map(|line_break| from + line_break + 1).or((from == 0).then_some(0))
}

/// Whether the renderer can show two marks at once: in whole lines, or close to each other in a shortened one.
fn are_near(whole: &str, one: &Range<usize>, other: &Range<usize>) -> bool {
    let (first, last) = if one.start <= other.start { (one, other) } else { (other, one) };
    if last.start - first.start > NEAR_BYTES {
        return false;
    }
    if whole[first.start..last.start].contains('\n') {
        return [first, last].iter().all(|mark| line_start(whole, mark.start).is_some());
    }
    last.start - first.start <= MARGIN_BYTES
}

/// Returns the marked range in whole characters, because the renderer panics if a range starts or ends inside one.
fn marked(text: &str, label: &Label) -> Range<usize> {
    let start = text.floor_char_boundary(label.span.start as usize);
    let end = text.ceil_char_boundary(label.span.end as usize).max(start);
    start..text.floor_char_boundary(end.min(start + MARK_BYTES))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Report, Source, Span, render};

    fn report(text: &str, spans: &[(usize, usize)]) -> Report {
        let mut diagnostic = Diagnostic::at(Code::JsonSyntax, Span::new(spans[0].0, spans[0].1), "wrong");
        for &(start, end) in &spans[1..] {
            diagnostic = diagnostic.also(Span::new(start, end), "other");
        }
        Report::new(Source::new("a.lipz", text), vec![diagnostic])
    }

    #[test]
    fn lines_with_marks_and_no_others() {
        let text = "one\ntwo\nthree\nfour\n";
        let shown = |spans: &[(usize, usize)]| {
            let report = report(text, spans);
            let mut all = excerpts(text, &Places::new(&report), &report.diagnostics[0]);
            assert_eq!(all.len(), 1);
            let Excerpt { text, first_line, marks, place } = all.remove(0);
            assert_eq!(place, None);
            (first_line, text.to_owned(), marks[0].2.clone())
        };
        assert_eq!(shown(&[(5, 6)]), (2, "two\n".into(), 1..2));
        assert_eq!(shown(&[(5, 8)]), (2, "two\nthree\n".into(), 1..4), "up to the next line");
        assert_eq!(shown(&[(9, 10), (1, 2)]), (1, "one\ntwo\nthree\n".into(), 9..10));
        assert_eq!(shown(&[(19, 99)]), (4, "four\n".into(), 5..5), "behind the end");
    }

    #[test]
    fn a_long_line_is_shown_as_if_it_were_shorter() {
        // The same mark, with more and more text around it.
        let shown = |before: usize, behind: usize| {
            let text = format!("\n\"{}Z{}\"\n", "é".repeat(before), "ü".repeat(behind));
            let at = text.find('Z').unwrap_or_default();
            let human = render::human(&[report(&text, &[(at, at + 1), (at - 10, at - 8)])]);
            let (head, rest) = human.split_once(" --> a.lipz:2:").unwrap_or_default();
            let (column, rest) = rest.split_once('\n').unwrap_or_default();
            assert_eq!((head, column), ("error[LZ0101]: wrong\n", (before + 2).to_string().as_str()));
            rest.to_owned()
        };
        let whole = shown(1_000, 1_000);
        assert!(whole.contains("...ééé") && whole.contains("ééZüü"), "{whole}");
        for (before, behind) in [(1_000, 100_000), (3_000, 3_000), (100_000, 1_000), (100_000, 100_000)] {
            assert_eq!(shown(before, behind), whole, "{before} {behind}");
        }
    }

    #[test]
    fn marks_far_apart_are_shown_one_after_the_other() {
        for between in [" ".repeat(500_000), "\n".repeat(500_000)] {
            let text = format!("\"fps\": 1,{between}\"fps\": 2");
            let again = text.len() - 8;
            let human = render::human(&[report(&text, &[(again, again + 5), (0, 5)])]);
            assert!(human.len() < 500, "{}", human.len());
            let place = if between.starts_with(' ') { "1:500010" } else { "500001:1" };
            let (again, first) = human.split_once(" ::: a.lipz:1:1\n").unwrap_or_default();
            assert!(again.contains(&format!("--> a.lipz:{place}\n")), "{human}");
            assert!(again.contains("^^^^^") && first.contains("----- other"), "{human}");
        }
    }

    #[test]
    fn of_a_long_mark_its_start_is_shown() {
        let text = format!("{{\"x\": \"{}\"}}", "a".repeat(100_000));
        let human = render::human(&[report(&text, &[(6, text.len() - 1)])]);
        assert!(human.len() < 10_000 && human.contains("--> a.lipz:1:7\n"), "{}", human.len());
    }
}
