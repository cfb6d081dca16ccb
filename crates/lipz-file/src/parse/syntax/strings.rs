//! Errors in strings and at their ends: quotation marks, control characters, escapes.

use super::error_position::{ErrorPosition, WHITE_SPACE, starts_element, starts_inside_name};
use super::{Continuation, ExpectedToken, Mistake};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// A literal control character, once or several times.
pub(in crate::parse) fn control_character(at: &ErrorPosition<'_>) -> Diagnostic {
    let character = at.character().unwrap_or_default();
    let span = at.span_of(at.rest().len() - at.rest().trim_start_matches(character).len());
    match character {
        '\n' | '\r' => line_break(at),
        '\t' => Diagnostic::at(Code::ControlCharacter, span, "a string contains a tab")
            .help("write \\t if it belongs to the string, otherwise delete it"),
        _ => {
            let message = format!("a string contains {}", escape::code_point(character));
            Diagnostic::at(Code::ControlCharacter, span, message)
                .help(format!("delete it, or write \\u{:04X}", u32::from(character)))
        }
    }
}

fn line_break(at: &ErrorPosition<'_>) -> Diagnostic {
    // The mark is after the last character of its line, because it cannot span two lines.
    let diagnostic = Diagnostic::at(Code::ControlCharacter, at.span_of(0), "a string contains a line break");
    let next_line = at.rest().trim_start_matches(WHITE_SPACE);
    if next_line.is_empty() {
        return diagnostic.help("add the closing `\"`, or copy the file again if it was cut off");
    }
    if starts_element(next_line) || next_line.starts_with('}') {
        return diagnostic
            .help("write \\n if it belongs to the string, otherwise join the lines, or add the closing `\"`");
    }
    diagnostic
        .note("files copied from a printed page often have extra line breaks where the page was too narrow")
        .help("write \\n if it belongs to the string, otherwise join the lines")
}

/// A quotation mark that ends a text too early: the text continues after it.
pub(super) fn quotation_mark(at: &ErrorPosition<'_>, expected: ExpectedToken) -> Option<Mistake> {
    let (mark, '"') = at.before()? else { return None };
    if expected != ExpectedToken::Comma || matches!(at.character()?, ':' | ';' | '{' | '[' | ']') {
        return None;
    }
    Some(Continuation::Lost(at.offset()).after(if starts_inside_name(at.rest()) {
        Diagnostic::at(Code::JsonSyntax, mark, "the text ends at this quotation mark, and a name follows")
            .help("add the closing `\"` of the text before it")
    } else {
        Diagnostic::at(Code::JsonSyntax, mark, "the text ends at this quotation mark")
            .help("write \\\" for a quotation mark inside a text, or use “ ”")
    }))
}

/// An escape at the position that is not valid in JSON.
pub(in crate::parse) fn escape(at: &ErrorPosition<'_>) -> Diagnostic {
    // An escape that is too short ends with its string.
    let is_part = |c: &char| !matches!(c, '"' | '\\') && !c.is_control();
    let mut rest = at.rest().chars().skip(1);
    let letter = rest.next();
    let digits = if letter == Some('u') { 4 } else { 0 };
    let length: usize =
        1 + letter.into_iter().chain(rest.take(digits).take_while(is_part)).map(char::len_utf8).sum::<usize>();
    let span = at.span_of(length);
    let escape = at.text_of(span).unwrap_or_default();
    Diagnostic::at(Code::BadEscape, span, format!("`{}` is not a JSON escape", escape::text(escape))).help(
        "write \\\\ for a backslash; the JSON escapes are \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\u with four \
            hexadecimal digits",
    )
}

/// Returns the diagnostic for an escape that is half of a surrogate pair and has no character. The literal's escapes
/// must be well formed.
pub(in crate::parse) fn half_of_a_pair(literal: &str, start: usize) -> Diagnostic {
    let mut at = 0;
    let unit = |at: usize| {
        let digits = literal.get(at..)?.strip_prefix("\\u")?.get(..4)?;
        u16::from_str_radix(digits, 16).ok()
    };
    while at < literal.len() {
        at += match unit(at) {
            Some(0xD800..=0xDBFF) if matches!(unit(at + 6), Some(0xDC00..=0xDFFF)) => 12,
            Some(0xD800..=0xDFFF) => break,
            Some(_) => 6,
            None if literal.as_bytes().get(at) == Some(&b'\\') => 2,
            None => 1,
        };
    }
    let span = Span::new(start + at, start + at + 6);
    let spelled = literal.get(at..at + 6).unwrap_or_default();
    Diagnostic::at(Code::BadEscape, span, format!("the escape `{spelled}` is half of a surrogate pair"))
        .note("a character above U+FFFF takes two \\u escapes, such as \\uD83D\\uDE00, or no escape at all")
        .help("write the character itself, without an escape")
}
