//! The spelling of the characters of a segment.

use crate::JsonString;
use crate::text::{DELIMITER, is_white_space};
use lipz_diagnostics::escape;
use std::borrow::Cow;

/// Returns the segments of a string as spelled inside a JSON string. With `trims`, omits the whitespace at their ends,
/// which is not displayed.
pub(super) fn segments(string: &JsonString<'_>, trims: bool) -> Vec<String> {
    let mut segments = vec![String::new()];
    // Whitespace that belongs to the segment if something follows.
    let mut white_space = String::new();
    for (character, spelled) in string.characters() {
        if character == DELIMITER {
            white_space.clear();
            segments.push(String::new());
        } else if let Some(segment) = segments.last_mut() {
            if trims && is_white_space(character) {
                if !segment.is_empty() {
                    white_space.push_str(&canonical(character, spelled));
                }
            } else {
                segment.push_str(&white_space);
                white_space.clear();
                segment.push_str(&canonical(character, spelled));
            }
        }
    }
    segments
}

/// Returns the canonical spelling. Visible characters stand for themselves. Invisible ones (U+00A0, U+200B, direction
/// marks) are unchanged, so that an escape that makes them visible is kept.
fn canonical(character: char, spelled: &str) -> Cow<'_, str> {
    match character {
        '"' => Cow::Borrowed("\\\""),
        '\\' => Cow::Borrowed("\\\\"),
        _ if spelled.starts_with('\\') && (character == ' ' || escape::has_shape(character)) => {
            Cow::Owned(character.to_string())
        }
        // The case of a document that was not read from a file.
        '\0'..='\x1F' if !spelled.starts_with('\\') => Cow::Owned(crate::literal(spelled).trim_matches('"').to_owned()),
        _ => Cow::Borrowed(spelled),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spelled(literal: &str, trims: bool) -> String {
        let file = format!("{{\"x\": {literal}}}");
        let document = crate::parse(file.as_bytes()).document.unwrap();
        let crate::Value::String(string) = &document.get("x").unwrap().value else { return String::new() };
        segments(string, trims).join("|")
    }

    #[test]
    fn escapes_are_kept_where_they_are_needed() {
        assert_eq!(spelled(r#""T\u00e1 \u007c \ud83d\ude00 \/ \u0022\u005C""#, true), r#"Tá|😀 / \"\\"#);
        assert_eq!(
            spelled(r#""a\u00a0b\u200Bc\u202ed\ne\u0000\u000a.""#, true),
            r"a\u00a0b\u200Bc\u202ed\ne\u0000\u000a."
        );
        assert_eq!(spelled("\"a\u{a0}b\u{200b}c e\u{301}\"", true), "a\u{a0}b\u{200b}c e\u{301}");
    }

    #[test]
    fn white_space_at_the_ends() {
        assert_eq!(spelled(r#"" \n a\t b \u0020| \t |{x} c""#, true), r"a\t b||{x} c");
        assert_eq!(spelled(r#"" A B\t|\n""#, false), r" A B\t|\n");
        assert_eq!(spelled("\"\u{a0}a\u{3000}\"", true), "\u{a0}a\u{3000}", "not white space to the format");
    }

    #[test]
    fn strings_that_are_not_from_a_file() {
        let string = JsonString::from(Cow::Borrowed(" \"a\"\n\\ \0b| c "));
        assert_eq!(segments(&string, true).join("|"), r#"\"a\"\n\\ \u0000b|c"#);
    }
}
