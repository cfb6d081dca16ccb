//! Mistakes inside of strings and at their ends: quotation marks, control characters, escapes.

use super::place::{Place, WHITE_SPACE, starts_element, starts_inside_name};
use super::{Expected, Mistake, Then};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// A control character as it is, once or several times.
pub(in crate::parse) fn control_character(at: &Place<'_>) -> Diagnostic {
    let character = at.character().unwrap_or_default();
    let span = at.span_of(at.rest().len() - at.rest().trim_start_matches(character).len());
    match character {
        '\n' | '\r' => line_break(at),
        '\t' => Diagnostic::at(Code::ControlCharacter, span, "a tab inside a string")
            .help("write \\t if it belongs to the string, otherwise delete it"),
        _ => {
            let message = format!("{} inside a string", escape::code_point(character));
            Diagnostic::at(Code::ControlCharacter, span, message)
                .help(format!("delete it, or write \\u{:04X}", u32::from(character)))
        }
    }
}

fn line_break(at: &Place<'_>) -> Diagnostic {
    // It is marked behind the last character of its line, not across two lines.
    let diagnostic = Diagnostic::at(Code::ControlCharacter, at.span_of(0), "a line break inside a string");
    let next_line = at.rest().trim_start_matches(WHITE_SPACE);
    if next_line.is_empty() {
        return diagnostic.help("the closing `\"` is missing, or the file was cut off while it was copied");
    }
    if starts_element(next_line) || next_line.starts_with('}') {
        return diagnostic
            .help("write \\n if it belongs to the string, otherwise join the lines; or is the closing `\"` missing?");
    }
    diagnostic
        .note("files copied from a printed page often have lines broken where the page was too narrow")
        .help("write \\n if it belongs to the string, otherwise join the lines")
}

/// A quotation mark that ends a text before its author wanted: the text goes on behind it.
pub(super) fn quotation_mark(at: &Place<'_>, expected: Expected) -> Option<Mistake> {
    let (mark, '"') = at.before()? else { return None };
    if expected != Expected::Comma || matches!(at.character()?, ':' | ';' | '{' | '[' | ']') {
        return None;
    }
    Some(Then::Lost(at.offset()).after(if starts_inside_name(at.rest()) {
        Diagnostic::at(Code::JsonSyntax, mark, "the text ends at this quotation mark, and a name follows")
            .help("is the closing `\"` of the text missing before it?")
    } else {
        Diagnostic::at(Code::JsonSyntax, mark, "the text ends at this quotation mark")
            .help("write \\\" for a quotation mark inside a text, or use “ ”")
    }))
}

/// An escape that JSON does not have, which starts at the place.
pub(in crate::parse) fn escape(at: &Place<'_>) -> Diagnostic {
    // An escape that is too short ends where its string does.
    let is_part = |c: &char| !matches!(c, '"' | '\\') && !c.is_control();
    let mut rest = at.rest().chars().skip(1);
    let letter = rest.next();
    let digits = if letter == Some('u') { 4 } else { 0 };
    let length: usize =
        1 + letter.into_iter().chain(rest.take(digits).take_while(is_part)).map(char::len_utf8).sum::<usize>();
    let span = at.span_of(length);
    let escape = at.text_of(span).unwrap_or_default();
    Diagnostic::at(Code::BadEscape, span, format!("`{}` is not an escape that JSON knows", escape::text(escape))).help(
        "JSON knows \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\u with four hexadecimal digits; write \\\\ for a backslash",
    )
}

/// The diagnostic for an escape that stands for no character: half of a surrogate pair. The literal's
/// escapes are well formed.
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
    Diagnostic::at(Code::BadEscape, span, format!("the escape `{spelled}` is half of a character"))
        .note("characters above U+FFFF are written as two \\u escapes, \\uD83D\\uDE00, or as they are")
        .help("write the character itself: the file is UTF-8")
}
