//! Conversion of a source text: edits only the codes and the name of their viseme type.

use crate::check::convert::Conversion;
use lipz_diagnostics::{Fix, Span};
use lipz_file::text::is_white_space;
use lipz_file::{Document, Element, Value, literal};

const BYTE_ORDER_MARK: &str = "\u{FEFF}";

/// Returns the converted text of the file that `document` was read from. `None` if it is not UTF-8.
pub(super) fn apply(bytes: &[u8], document: &Document<'_>, conversion: &Conversion) -> Option<String> {
    let text = std::str::from_utf8(bytes).ok()?;
    let (mark, text) = match text.strip_prefix(BYTE_ORDER_MARK) {
        Some(text) => (BYTE_ORDER_MARK, text),
        None => ("", text),
    };
    let viseme_type = literal(conversion.to.name());
    let mut edits = Vec::new();
    let visemes = document.get("visemes");
    if let Some(Element { value: Value::String(string), .. }) = visemes {
        edits.push(Fix::new(string.span(), literal(&conversion.visemes(&string.text))));
    }
    match (document.get("viseme_type"), visemes) {
        (Some(element), _) => edits.push(Fix::new(element.value.span(), viseme_type)),
        // The project's default would be the type of the old codes.
        (None, Some(visemes)) => edits.push(insertion(text, visemes, &viseme_type)?),
        (None, None) => {}
    }
    let edits: Vec<&Fix> = edits.iter().collect();
    Some(mark.to_owned() + &Fix::apply_all(text, &edits).text)
}

/// Returns the insertion of a new element `viseme_type` after the element `visemes`, with the same separation as before
/// that.
fn insertion(text: &str, visemes: &Element<'_>, viseme_type: &str) -> Option<Fix> {
    let (name, value) = (visemes.name.span().range(), visemes.value.span().range());
    let before = text.get(..name.start)?;
    let white_space = before.get(before.trim_end_matches(is_white_space).len()..)?;
    let colon = text.get(name.end..value.start)?;
    let replacement = format!(",{white_space}\"viseme_type\"{colon}{viseme_type}");
    Some(Fix::new(Span::new(value.end, value.end), replacement))
}
