//! The outline of a file: its elements, and the segments of its texts.

use crate::document::Document;
use crate::place::Walk;
use crate::timing::Timing;
use crate::{convert, project};
use lipz_diagnostics::Span;
use lipz_file::locale::text_name;
use lipz_file::{Element, Value, text};
use lsp_types::{DocumentSymbol, Range, SymbolKind};

/// The longest value that an outline shows.
const SHOWN_CHARACTERS: usize = 60;

/// The most segments of a text that an outline lists: nobody reads more there, and editors ask for it while somebody types.
const MOST_SEGMENTS: usize = 200;

/// The elements of a file, in its order.
pub(crate) fn symbols(document: &Document, known: &project::Known) -> Vec<DocumentSymbol> {
    let parsed = lipz_file::parse(document.text.as_bytes());
    let read = parsed.document.or(parsed.fragment.map(|fragment| fragment.document)).unwrap_or_default();
    let timing = Timing::of(&read, known.project.settings.options.default_fps);
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

/// The segments of a text with more than one.
fn segments(document: &Document, element: &Element<'_>, timing: Option<&Timing>) -> Vec<DocumentSymbol> {
    let Value::String(string) = &element.value else { return Vec::new() };
    if text::segment_count(&string.text) < 2 || string.span().range().len() != string.text.len() + 2 {
        // Where characters stand is found quickly only without escapes; an outline is not worth more.
        return Vec::new();
    }
    let (shift, count) = (document.mark_bytes(), text::segment_count(&string.text));
    let mut walk = Walk::new(&document.rope, &document.text, string.span().start as usize + shift);
    let one = |(index, range): (usize, std::ops::Range<usize>)| {
        let said = shortened(text::trim(string.text.get(range.clone()).unwrap_or_default()));
        let name = if said.is_empty() { format!("segment {}", index + 1) } else { said };
        let time = timing.and_then(|timing| timing.shown(index)).unwrap_or_default();
        let span = string.span_of(range);
        let [start, end] = [span.start, span.end].map(|place| walk.position(place as usize + shift));
        let range = Range::new(start, end);
        made(&name, time, SymbolKind::STRING, (range, range), None)
    };
    let mut listed: Vec<DocumentSymbol> =
        text::segments(&string.text).take(MOST_SEGMENTS).enumerate().map(one).collect();
    if let Some(last) = listed.last().filter(|_| count > MOST_SEGMENTS) {
        let name = format!("and {} more segments", count - MOST_SEGMENTS);
        let range = (last.range, last.selection_range);
        listed.push(made(&name, String::new(), SymbolKind::STRING, range, None));
    }
    listed
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
    use crate::project::Known;
    use lsp_types::Uri;
    use std::str::FromStr;

    #[test]
    fn long_texts_are_listed_from_their_start() {
        let text = format!("{{ \"text_en-us\": \"{}\" }}", vec!["a"; MOST_SEGMENTS + 3].join("|"));
        let document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text);
        let symbols = symbols(&document, &Known::default());
        let children = symbols[0].children.as_ref().unwrap();
        assert_eq!((children.len(), children[MOST_SEGMENTS].name.as_str()), (MOST_SEGMENTS + 1, "and 3 more segments"));
        assert_eq!(children[1].range.start.character, 19);
    }

    #[test]
    fn elements_and_segments_are_listed_also_of_broken_files() {
        let text = "{ \"visemes\": \"MA|EO\",, \"text_en-us\": \"Ma|yor\", \"fps\": 10, \"x\": [] ".to_owned();
        let document = Document::new(Uri::from_str("untitled:a").unwrap(), 1, text);
        let symbols = symbols(&document, &Known::default());
        let names: Vec<&str> = symbols.iter().map(|symbol| symbol.name.as_str()).collect();
        assert_eq!(names, ["visemes", "text_en-us", "fps", "x"]);
        let children = symbols[1].children.as_ref().unwrap();
        assert_eq!(children[1].name, "yor");
        assert_eq!(children[1].detail.as_deref(), Some("frames 2–4, 0.200 s–0.400 s"));
        assert!(symbols.iter().all(|symbol| symbol.range.start <= symbol.selection_range.start));
    }
}
