//! The outline of a file: its elements, and the segments of its texts.

use crate::document::Document;
use crate::place::PositionWalk;
use crate::timing::Timing;
use crate::{convert, project};
use lipz_diagnostics::Span;
use lipz_file::locale::text_name;
use lipz_file::{Element, Value, text};
use lsp_types::{DocumentSymbol, Range, SymbolKind};

/// The greatest length of a value in an outline, in characters.
const SHOWN_CHARACTERS: usize = 60;

/// The most entries of a text. Editors request outlines while you type, and a megabyte has 24,000 segments.
const MOST_ENTRIES: usize = 500;

/// Returns the elements of a file, in order.
pub(crate) fn symbols(document: &Document, known: &project::KnownProject) -> Vec<DocumentSymbol> {
    let parsed = lipz_file::parse(document.text.as_bytes());
    let read = parsed.document.or(parsed.fragment.map(|fragment| fragment.document)).unwrap_or_default();
    let timing = Timing::of(&read, known.project.settings.options.get_default_fps());
    read.elements.iter().map(|element| symbol(document, element, timing.as_ref())).collect()
}

fn symbol(document: &Document, element: &Element<'_>, timing: Option<&Timing>) -> DocumentSymbol {
    let name = element.name.text.as_ref();
    let (kind, detail) = match &element.value {
        Value::String(string) => (SymbolKind::STRING, shortened(&string.text)),
        Value::Number(raw) => (SymbolKind::NUMBER, raw.text.clone().into_owned()),
        Value::Other(_) => (SymbolKind::OBJECT, String::new()),
    };
    let (start, end) = (element.name.span().start, element.value.span().end);
    let whole = Span { start, end: end.max(element.name.span().end) };
    let children = (name == "events" || text_name(name).is_some()).then(|| segments(document, element, timing));
    let range = |span| convert::range(&document.rope, span, document.mark_bytes());
    let ranges = (range(whole), range(element.name.span()));
    made(if name.is_empty() { "\"\"" } else { name }, detail, kind, ranges, children)
}

/// Returns the segments of a text with more than one. A text with very many is divided into groups of equal size.
fn segments(document: &Document, element: &Element<'_>, timing: Option<&Timing>) -> Vec<DocumentSymbol> {
    let Value::String(string) = &element.value else { return Vec::new() };
    let count = text::segment_count(&string.text);
    if count < 2 {
        return Vec::new();
    }
    let shift = document.mark_bytes();
    let ranges: Vec<_> = text::segments(&string.text).collect();
    let groups: Vec<_> = ranges.chunks(count.div_ceil(MOST_ENTRIES)).collect();
    let wholes = groups.iter().map(|group| group[0].start..group[group.len() - 1].end);
    let mut walk = PositionWalk::new(&document.rope, &document.text, string.span().start as usize + shift);
    let mut first = 0;
    let one = |(group, span): (&&[std::ops::Range<usize>], Span)| {
        let said = shortened(text::trim(string.text.get(group[0].clone()).unwrap_or_default()));
        let time = timing.and_then(|timing| timing.shown(first..first + group.len())).unwrap_or_default();
        let name = match group.len() {
            1 if said.is_empty() => format!("segment {}", first + 1),
            1 => said,
            more => format!("segments {}–{}: {said}", first + 1, first + more).trim_end_matches(": ").to_owned(),
        };
        first += group.len();
        let [start, end] = [span.start, span.end].map(|place| walk.position(place as usize + shift));
        let range = Range::new(start, end);
        made(&name, time, SymbolKind::STRING, (range, range), None)
    };
    groups.iter().zip(string.spans_of(wholes)).map(one).collect()
}

#[allow(deprecated, reason = "the type has a field that is deprecated")]
fn made(
    name: &str,
    detail: String,
    kind: SymbolKind,
    (range, selection_range): (Range, Range),
    children: Option<Vec<DocumentSymbol>>,
) -> DocumentSymbol {
    DocumentSymbol {
        name: name.to_owned(),
        detail: Some(detail),
        kind,
        tags: None,
        deprecated: None,
        range,
        selection_range,
        children,
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(SHOWN_CHARACTERS) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::project::KnownProject;
    use lsp_types::Uri;
    use std::str::FromStr;

    /// Returns the entries of an outline for a text.
    fn listed(text: &str, visemes: &str) -> Vec<DocumentSymbol> {
        let text = format!("{{ \"fps\": 10, \"visemes\": \"{visemes}\", \"text_en-us\": \"{text}\" }}");
        let document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text);
        symbols(&document, &KnownProject::default()).pop().and_then(|symbol| symbol.children).unwrap()
    }

    #[test]
    fn all_of_a_long_text_is_listed_in_groups() {
        let count = 2 * MOST_ENTRIES + 1;
        let children = listed(&vec!["aü"; count].join("|"), &vec!["AA"; count].join("|"));
        assert_eq!(children.len(), count.div_ceil(3));
        let shown = |index: usize| (children[index].name.as_str(), children[index].detail.as_deref().unwrap());
        assert_eq!(shown(1), ("segments 4–6: aü", "frames 6–12, 0.600 s–1.200 s"));
        assert_eq!(shown(children.len() - 1), ("segments 1000–1001: aü", "frames 1998–2002, 199.800 s–200.200 s"));
        // The visemes have fewer segments than the text. The last group has the time of those that exist.
        let shorter = listed(&vec!["aü"; count].join("|"), &vec!["AA"; count - 1].join("|"));
        assert_eq!(shorter[shorter.len() - 1].detail.as_deref(), Some("frames 1998–2000, 199.800 s–200.000 s"));
        for (one, next) in children.iter().zip(&children[1..]) {
            assert_eq!(one.range.end.character + 1, next.range.start.character, "nothing between them but a delimiter");
        }
        assert_eq!(listed(&"|".repeat(count), "A")[0].name, "segments 1–3");
        assert_eq!(listed(&vec!["a"; MOST_ENTRIES].join("|"), "A").len(), MOST_ENTRIES);
    }

    #[test]
    fn segments_behind_escapes_are_listed_at_their_places() {
        let children = listed(r#"\"Ah\", \u00fc|\t|so\n|"#, "A");
        let names: Vec<&str> = children.iter().map(|child| child.name.as_str()).collect();
        assert_eq!(names, ["\"Ah\", ü", "segment 2", "so", "segment 4"]);
        let places: Vec<_> =
            children.iter().map(|child| (child.range.start.character, child.range.end.character)).collect();
        let start = u32::try_from(r#"{ "fps": 10, "visemes": "A", "text_en-us": ""#.len()).unwrap();
        assert_eq!(places, [(0, 14), (15, 17), (18, 22), (23, 23)].map(|(from, to)| (start + from, start + to)));
    }

    #[test]
    fn elements_and_segments_are_listed_also_of_broken_files() {
        let text = "{ \"visemes\": \"MA|EO\",, \"text_en-us\": \"Ma|yor\", \"fps\": 10, \"x\": [] ".to_owned();
        let document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text);
        let symbols = symbols(&document, &KnownProject::default());
        let names: Vec<&str> = symbols.iter().map(|symbol| symbol.name.as_str()).collect();
        assert_eq!(names, ["visemes", "text_en-us", "fps", "x"]);
        let children = symbols[1].children.as_ref().unwrap();
        assert_eq!(children[1].name, "yor");
        assert_eq!(children[1].detail.as_deref(), Some("frames 2–4, 0.200 s–0.400 s"));
        assert!(symbols.iter().all(|symbol| symbol.range.start <= symbol.selection_range.start));
    }
}
