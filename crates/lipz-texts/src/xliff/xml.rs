//! Writing and reading characters of XML.

use lipz_diagnostics::{LineColumn, Span, escape};
use roxmltree::{Error, Node};

/// Whether XML 1.0 can have the character at all (section 2.2, `Char`).
pub(super) fn has(character: char) -> bool {
    matches!(character, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..)
}

/// Adds a text, with references for what is markup. Line ends of other systems would be read as LF. `other` writes
/// characters that XML does not have.
pub(super) fn push(out: &mut String, text: &str, mut other: impl FnMut(char) -> String) {
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\r' => out.push_str("&#13;"),
            _ if has(character) => out.push(character),
            _ => out.push_str(&other(character)),
        }
    }
}

/// A text for people, or a value of an attribute: one line, in which characters that XML does not have are U+FFFD.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::new();
    push(&mut out, text, |_| "\u{FFFD}".to_owned());
    out.replace('\n', "&#10;").replace('\t', "&#9;")
}

/// What is between the tags of an element.
pub(super) fn inner(node: Node<'_, '_>) -> Span {
    match (node.first_child(), node.last_child()) {
        (Some(first), Some(last)) => Span::new(first.range().start, last.range().end),
        _ => whole(node),
    }
}

/// An element with its tags.
pub(super) fn whole(node: Node<'_, '_>) -> Span {
    Span::new(node.range().start, node.range().end)
}

/// What is wrong with a file that is no XML, and where.
pub(super) fn mistake(text: &str, error: &Error) -> (String, Span) {
    let place = error.pos();
    // The message ends with the place, which the caret shows.
    let message = error.to_string();
    let what = message.split(" at ").next().unwrap_or(&message);
    let span = Span::of_character(text, LineColumn { line: place.row, column: place.col });
    (escape::text(what).into_owned(), span)
}
