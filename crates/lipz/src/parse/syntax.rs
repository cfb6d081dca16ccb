//! What is wrong with text that is not JSON, in words that help whoever wrote it.

use super::is_white_space;
use crate::{Code, Diagnostic, Span};
use serde_json::error::Category;

/// Explains why the root object could not be read.
pub(super) fn explain(text: &str, error: &serde_json::Error) -> Diagnostic {
    if error.classify() == Category::Data {
        return root_not_object(text);
    }
    let at = Place::of(text, error);
    if error.classify() == Category::Eof {
        return unfinished(text);
    }
    let message = error.to_string();
    if message.starts_with("control character") {
        return control_character(&at.next());
    }
    if message.starts_with("invalid escape") {
        return escape(&at).unwrap_or_else(|| other(&at, error));
    }
    trailing_comma(&at).or_else(|| comment(&at)).or_else(|| missing_comma(&at)).unwrap_or_else(|| other(&at, error))
}

/// Explains what follows the root object.
pub(super) fn explain_rest(text: &str, error: &serde_json::Error) -> Diagnostic {
    let at = Place::of(text, error);
    if let Some(comment) = comment(&at) {
        return comment;
    }
    let span = at.character_span();
    let after_comma = at.rest().trim_start_matches([',', ' ', '\t', '\r', '\n']);
    if after_comma.starts_with('{') {
        return Diagnostic::at(Code::JoinedObjects, span, "a second object follows the first")
            .label("the clip's object has ended before this")
            .note("one Lipz file describes one audio file")
            .help("put each object into a file of its own");
    }
    Diagnostic::at(Code::JoinedObjects, span, "text follows the closing brace of the root object")
        .help("delete everything after the last `}`; if it belongs to the clip, move it inside")
}

/// The finding for an escape that stands for no character: half of a surrogate pair. The literal's
/// escapes are well formed.
pub(super) fn bad_escape(literal: &str, start: usize) -> Diagnostic {
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

/// The place of a syntax error.
struct Place<'s> {
    text: &'s str,
    /// Byte offset of the character that serde_json did not expect.
    offset: usize,
}

impl<'s> Place<'s> {
    /// serde_json tells line and column (in bytes) just behind the byte that it did not expect.
    fn of(text: &'s str, error: &serde_json::Error) -> Place<'s> {
        let line_start = match error.line() {
            0 | 1 => 0,
            line => text.match_indices('\n').nth(line - 2).map_or(text.len(), |(at, _)| at + 1),
        };
        let mut offset = (line_start + error.column()).saturating_sub(1).min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        Place { text, offset }
    }

    /// The place of the next character. serde_json does not count the control character that it
    /// stopped at as read.
    fn next(&self) -> Place<'s> {
        Place { text: self.text, offset: self.character_span().end as usize }
    }

    fn rest(&self) -> &'s str {
        self.text.get(self.offset..).unwrap_or_default()
    }

    fn character(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn character_span(&self) -> Span {
        Span::new(self.offset, self.offset + self.character().map_or(0, char::len_utf8))
    }

    /// The last character before the place that is not white space, and its offset.
    fn before(&self) -> Option<(usize, char)> {
        let before = self.text.get(..self.offset)?.trim_end_matches([' ', '\t', '\r', '\n']);
        before.char_indices().next_back()
    }
}

fn root_not_object(text: &str) -> Diagnostic {
    let start = text.len() - text.trim_start().len();
    let found = match text.trim_start().as_bytes().first() {
        Some(b'[') => "an array",
        Some(b'"') => "a string",
        Some(b'-' | b'0'..=b'9') => "a number",
        _ => "a literal",
    };
    Diagnostic::at(Code::RootNotObject, Span::new(start, start + 1), format!("the root is {found}, not an object"))
        .help("a Lipz file is one object: { \"visemes\": \"…\", \"text_en-us\": \"…\" }")
}

/// The file ends inside of something: a string, or the object.
fn unfinished(text: &str) -> Diagnostic {
    let end = text.trim_end_matches(|c: char| c.is_ascii() && is_white_space(c as u8)).len();
    let span = Span::new(end, end);
    Diagnostic::at(Code::UnfinishedFile, span, "the file ends before its object does")
        .label("something is missing from here on")
        .help("is a closing `\"` or `}` missing, or was the file cut off while it was copied?")
}

fn trailing_comma(at: &Place<'_>) -> Option<Diagnostic> {
    let (comma, ',') = at.before()? else { return None };
    if !matches!(at.character()?, '}' | ']') {
        return None;
    }
    let span = Span::new(comma, comma + 1);
    Some(
        Diagnostic::at(Code::TrailingComma, span, "a comma stands after the last element")
            .help("delete the comma: JSON has commas only between elements")
            .fix(span, ""),
    )
}

fn comment(at: &Place<'_>) -> Option<Diagnostic> {
    let rest = at.rest();
    let length = if rest.starts_with("//") || rest.starts_with('#') {
        rest.lines().next()?.len()
    } else if rest.starts_with("/*") {
        rest.find("*/").map_or(2, |end| end + 2)
    } else {
        return None;
    };
    let span = Span::new(at.offset, at.offset + length);
    Some(
        Diagnostic::at(Code::Comment, span, "JSON has no comments")
            .help("delete the comment, or keep it in an element of its own: \"x_comment\": \"…\""),
    )
}

fn escape(at: &Place<'_>) -> Option<Diagnostic> {
    // A wrong letter is one character behind the backslash; for a wrong digit of \u, serde_json points
    // at the fourth.
    let before = at.text.get(..at.offset)?;
    let backslash = before.char_indices().rev().take(5).find(|&(_, character)| character == '\\')?.0;
    let escape = at.text.get(backslash..at.character_span().end as usize)?;
    // An escape that is too short ends where its string does.
    let escape = escape.strip_suffix('"').filter(|short| short.starts_with("\\u")).unwrap_or(escape);
    let span = Span::new(backslash, backslash + escape.len());
    let spelled: String = escape.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).collect();
    Some(Diagnostic::at(Code::BadEscape, span, format!("`{spelled}` is not an escape that JSON knows")).help(
        "JSON knows \\\" \\\\ \\/ \\b \\f \\n \\r \\t and \\u with four hexadecimal digits; write \\\\ for a backslash",
    ))
}

fn control_character(at: &Place<'_>) -> Diagnostic {
    let character = at.character().unwrap_or('\0');
    let (name, spelled) = match character {
        '\n' | '\r' => ("a line break", "\\n"),
        '\t' => ("a tab", "\\t"),
        _ => ("a control character", "\\u00XX"),
    };
    // A line break is marked behind the last character of its line, not across two lines.
    let span = if name == "a line break" { Span::new(at.offset, at.offset) } else { at.character_span() };
    let diagnostic = Diagnostic::at(Code::ControlCharacter, span, format!("{name} stands inside a string"))
        .help(format!("write {spelled} if it belongs to the string, otherwise join the lines"));
    if name == "a line break" {
        diagnostic.note("files copied from a printed page often have lines broken where the page was too narrow")
    } else {
        diagnostic
    }
}

fn missing_comma(at: &Place<'_>) -> Option<Diagnostic> {
    let (before, character) = at.before()?;
    let value_ended = matches!(character, '"' | '}' | ']' | 'e' | 'l' | '0'..='9');
    if at.character()? != '"' || !value_ended {
        return None;
    }
    let end = before + character.len_utf8();
    Some(
        Diagnostic::at(Code::JsonSyntax, Span::new(end, end), "a comma is missing between two elements")
            .also(at.character_span(), "the next element starts here")
            .help("write a comma after the value"),
    )
}

fn other(at: &Place<'_>, error: &serde_json::Error) -> Diagnostic {
    // serde_json's message, without its own line and column.
    let message = error.to_string();
    let message = message.rfind(" at line ").map_or(message.as_str(), |end| &message[..end]);
    let help = match at.character() {
        Some('\'' | '“' | '”' | '„' | '«' | '‘' | '’') => {
            "names and strings stand in straight double quotes: \"visemes\""
        }
        Some('N' | 'I' | 'u' | 'T' | 'F') => "JSON knows true, false and null; numbers are plain: 24, 23.976",
        Some('+' | '.' | '0'..='9' | '-') => "numbers are plain: 24, 0.5, 23.976, without leading zeros or plus",
        Some('=') => "a colon stands between name and value",
        _ => "a Lipz file looks like { \"visemes\": \"MAEO-\", \"text_en-us\": \"Hello\" }",
    };
    Diagnostic::at(Code::JsonSyntax, at.character_span(), format!("this is not JSON: {message}")).help(help)
}
