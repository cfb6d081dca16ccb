//! The common parts of XML readers: the positions of elements and errors in the text.

use lipz_diagnostics::{Code, Diagnostic, LineColumn, Span, escape};
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

/// Returns the diagnostic for a file that would take a parser minutes.
pub(crate) fn too_costly(text: &str, code: Code) -> Option<Diagnostic> {
    let tag = lipz_file::costly_xml_tag(text)?;
    let most = lipz_file::MOST_XML_ATTRIBUTES;
    let message = format!("a tag has more than {most} attributes, or the file declares too many namespaces");
    Some(Diagnostic::at(code, Span::new(tag.start, tag.end), message))
}
