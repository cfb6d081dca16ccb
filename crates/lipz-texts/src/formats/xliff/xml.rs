//! Writing and reading of XML characters.

use lipz_diagnostics::{LineColumn, Span, escape};
use roxmltree::{Error, Node};

/// Whether XML 1.0 allows the character (section 2.2, `Char`).
pub(super) fn has(character: char) -> bool {
    matches!(character, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..)
}

/// Appends a text, with references for markup characters. CR becomes a reference, because parsers would read it as LF.
/// `other` writes characters that XML does not allow.
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

/// Returns a text for people, or the value of an attribute: one line, in which characters that XML does not allow
/// become U+FFFD.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::new();
    push(&mut out, text, |_| "\u{FFFD}".to_owned());
    out.replace('\n', "&#10;").replace('\t', "&#9;")
}

/// Returns the span between the tags of an element.
pub(super) fn inner(node: Node<'_, '_>) -> Span {
    match (node.first_child(), node.last_child()) {
        (Some(first), Some(last)) => Span::new(first.range().start, last.range().end),
        _ => whole(node),
    }
}

/// Returns the span of an element with its tags.
pub(super) fn whole(node: Node<'_, '_>) -> Span {
    Span::new(node.range().start, node.range().end)
}

/// Returns the syntax error of a file that is not XML, and its position.
pub(super) fn mistake(text: &str, error: &Error) -> (String, Span) {
    let place = error.pos();
    // The message ends with the position, which the caret already shows.
    let message = error.to_string();
    let what = message.split(" at ").next().unwrap_or(&message);
    let span = Span::of_character(text, LineColumn { line: place.row, column: place.col });
    (escape::text(what).into_owned(), span)
}
