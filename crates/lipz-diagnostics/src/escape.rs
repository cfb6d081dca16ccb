//! Text from files for use in messages: it cannot control the terminal, and contains nothing invisible.

use std::borrow::Cow;
use std::fmt::Write;

/// The most characters of a name in a message.
const NAME_SHOWN: usize = 60;

/// Returns the text with control characters and direction marks in JSON's spelling.
///
/// ```
/// use lipz_diagnostics::escape;
/// assert_eq!(escape::text("灯台\u{1b}[31m\n"), "灯台\\u001B[31m\\n");
/// ```
pub fn text(text: &str) -> Cow<'_, str> {
    if !text.contains(steers) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            '\n' => shown.push_str("\\n"),
            '\r' => shown.push_str("\\r"),
            '\t' => shown.push_str("\\t"),
            c if steers(c) => {
                let _ = write!(shown, "\\u{:04X}", u32::from(c));
            }
            c => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

/// Returns a name between backquotes, cut off after a reasonable length.
///
/// ```
/// use lipz_diagnostics::escape;
/// assert_eq!(escape::quoted("act1/mayor\n"), "`act1/mayor\\n`");
/// assert_eq!(escape::quoted(&"a".repeat(100)).chars().count(), 63);
/// ```
pub fn quoted(name: &str) -> String {
    match name.char_indices().nth(NAME_SHOWN) {
        Some((end, _)) => format!("`{}…`", text(&name[..end])),
        None => format!("`{}`", text(name)),
    }
}

/// Returns one character between backquotes, or its number if it is not visible on its own.
///
/// ```
/// use lipz_diagnostics::escape;
/// assert_eq!(escape::character('Z'), "`Z`");
/// assert_eq!(escape::character('\u{a0}'), "U+00A0");
/// ```
pub fn character(c: char) -> String {
    if has_shape(c) { format!("`{c}`") } else { code_point(c) }
}

/// The same, with the number of each character outside ASCII, because many of them look like others.
///
/// ```
/// use lipz_diagnostics::escape;
/// assert_eq!(escape::numbered('А'), "`А` (U+0410)");
/// assert_eq!(escape::numbered('A'), "`A`");
/// ```
pub fn numbered(c: char) -> String {
    if c.is_ascii() || !has_shape(c) { character(c) } else { format!("`{c}` ({})", code_point(c)) }
}

/// Whether a character is visible on its own.
pub fn has_shape(c: char) -> bool {
    // Rust also escapes some visible characters. All others that it escapes are not visible on their own: control
    // characters, whitespace, combining marks, code points without a character.
    matches!(c, '\'' | '"' | '\\') || c.escape_debug().len() == 1
}

/// Returns the number of the character: `U+001B`.
pub fn code_point(c: char) -> String {
    format!("U+{:04X}", u32::from(c))
}

/// Whether a terminal interprets the character instead of showing it.
pub(crate) fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61C}' | '\u{200E}' | '\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_steers_the_terminal() {
        let hostile = "\u{1b}]0;title\u{7} \u{9b}31m \u{202e}cba\u{2028} \u{7f}";
        assert_eq!(text(hostile), "\\u001B]0;title\\u0007 \\u009B31m \\u202Ecba\\u2028 \\u007F");
        assert!(matches!(text("née 👩‍🚀 שלום"), Cow::Borrowed(_)), "what people write stays");
    }

    #[test]
    fn characters_that_cannot_be_seen_have_numbers() {
        for c in ['\0', '\u{a0}', '\u{ad}', '\u{308}', '\u{200b}', '\u{feff}'] {
            assert!(character(c).starts_with("U+"), "{c:?}");
        }
        for c in ['Z', '"', '\'', '\\', 'Ä', '｜', '😀'] {
            assert_eq!(character(c), format!("`{c}`"));
        }
    }

    #[test]
    fn long_names_are_cut() {
        assert_eq!(quoted("x\n"), "`x\\n`");
        assert_eq!(quoted(&"ü".repeat(60)), format!("`{}`", "ü".repeat(60)));
        assert_eq!(quoted(&"ü".repeat(61)), format!("`{}…`", "ü".repeat(60)));
    }
}
