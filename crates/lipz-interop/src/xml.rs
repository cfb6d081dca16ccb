//! What readers of XML share: where elements and mistakes stand in the text.

use lipz_diagnostics::{LineColumn, Span, escape};
use roxmltree::{Error, Node};

/// An element with all that is in it.
pub(crate) fn whole(node: Node<'_, '_>) -> Span {
    let range = node.range();
    Span::new(range.start, range.end)
}

/// What is wrong with the syntax, and the character at which it is.
pub(crate) fn mistake(text: &str, error: &Error) -> (String, Span) {
    let place = error.pos();
    // The message ends with the place, which the caret shows.
    let message = error.to_string();
    let what = message.split(" at ").next().unwrap_or(&message);
    let span = Span::of_character(text, LineColumn { line: place.row, column: place.col });
    (escape::text(what).into_owned(), span)
}
