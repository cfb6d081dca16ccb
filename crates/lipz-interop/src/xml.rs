//! The common parts of XML readers: the positions of elements and errors in the text.

use lipz_diagnostics::{LineColumn, Span, escape};
use roxmltree::{Error, Node};

/// Returns the span of an element with its content.
pub(crate) fn whole(node: Node<'_, '_>) -> Span {
    let range = node.range();
    Span::new(range.start, range.end)
}

/// Returns the syntax error, and the position of the character that causes it.
pub(crate) fn mistake(text: &str, error: &Error) -> (String, Span) {
    let place = error.pos();
    // The message ends with the position, which the caret already shows.
    let message = error.to_string();
    let what = message.split(" at ").next().unwrap_or(&message);
    let span = Span::of_character(text, LineColumn { line: place.row, column: place.col });
    (escape::text(what).into_owned(), span)
}
