//! What readers of XML share: where elements and mistakes stand in the text.

use lipz_diagnostics::{Span, escape};
use roxmltree::{Error, Node};

/// An element with all that is in it.
pub(crate) fn whole(node: Node<'_, '_>) -> Span {
    let range = node.range();
    Span::new(range.start, range.end)
}

/// What is wrong with the syntax, and the character at which it is.
pub(crate) fn mistake(text: &str, error: &Error) -> (String, Span) {
    let place = error.pos();
    let lines = text.split_inclusive('\n').take((place.row as usize).saturating_sub(1));
    let before: usize = lines.map(str::len).sum();
    let line = text.get(before..).unwrap_or_default();
    // Columns count characters, from 1.
    let column = line.char_indices().nth((place.col as usize).saturating_sub(1)).map_or(line.len(), |(at, _)| at);
    let at = (before + column).min(text.len());
    let length = text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    // The message ends with the place, which the caret shows.
    let message = error.to_string();
    let what = message.split(" at ").next().unwrap_or(&message);
    (escape::text(what).into_owned(), Span::new(at, at + length))
}
