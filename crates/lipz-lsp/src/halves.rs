//! Halves of surrogate pairs. Editors that count in UTF-16 may replace one half of a character, and send the other one as
//! `"\\ude01"`, which is neither JSON for Rust nor a part of a string in UTF-8.
//!
//! A half is kept as a character for private use, which has one UTF-16 unit, too, so that positions stay right. Where two
//! halves meet, they become the character again. Two such characters of an icon font would become one as well, which
//! changes no position, either.

use std::ops::RangeInclusive;

const HIGH: RangeInclusive<u32> = 0xD800..=0xDBFF;
const LOW: RangeInclusive<u32> = 0xDC00..=0xDFFF;
/// The distance from a half to its placeholder, from U+F000 to U+F7FF.
const DISTANCE: u32 = 0xF000 - 0xD800;

/// Returns the placeholder of a half.
fn placeholder(half: u32) -> char {
    char::from_u32(half + DISTANCE).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// Returns the halves of a character with two UTF-16 units, as placeholders.
pub(crate) fn of(character: char) -> Option<(char, char)> {
    let mut units = [0; 2];
    match *character.encode_utf16(&mut units) {
        [high, low] => Some((placeholder(high.into()), placeholder(low.into()))),
        _ => None,
    }
}

/// Whether a character is the placeholder of a half.
pub(crate) fn is_half(character: char) -> bool {
    let half = u32::from(character).checked_sub(DISTANCE);
    half.is_some_and(|half| HIGH.contains(&half) || LOW.contains(&half))
}

/// Returns the character of two placeholders.
fn join(first: char, second: char) -> Option<char> {
    let half = |placeholder: char| u32::from(placeholder).checked_sub(DISTANCE);
    let (high, low) = (half(first)?, half(second)?);
    let is_pair = HIGH.contains(&high) && LOW.contains(&low);
    is_pair.then(|| char::from_u32(0x1_0000 + ((high - HIGH.start()) << 10) + (low - LOW.start()))).flatten()
}

/// Returns a text with the halves before and after it, which become characters with the halves at its ends. Halves
/// within the text are left alone: JSON joins them, so they are characters of an icon font.
pub(crate) fn between(before: Option<char>, text: &str, after: Option<char>) -> String {
    let mut whole = String::from_iter(before);
    let mut rest = text.chars();
    rest.by_ref().take(1).for_each(|first| push(&mut whole, first));
    whole.push_str(rest.as_str());
    after.into_iter().for_each(|after| push(&mut whole, after));
    whole
}

/// Adds a character, which is joined with a half before it.
fn push(text: &mut String, character: char) {
    let joined = text.chars().next_back().and_then(|before| join(before, character));
    if joined.is_some() {
        text.pop();
    }
    text.push(joined.unwrap_or(character));
}

/// Returns JSON whose lone halves are placeholders; `None` if it has none.
pub(crate) fn replaced(json: &[u8]) -> Option<Vec<u8>> {
    let escape = |at: usize| {
        let digits = json.get(at..)?.strip_prefix(b"\\u")?.get(..4)?;
        u32::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()
    };
    let (mut replaced, mut at, mut has_halves) = (Vec::with_capacity(json.len()), 0, false);
    while let Some(&byte) = json.get(at) {
        let length = match (byte, escape(at)) {
            (b'\\', Some(high)) if HIGH.contains(&high) && escape(at + 6).is_some_and(|low| LOW.contains(&low)) => 12,
            (b'\\', Some(half)) if HIGH.contains(&half) || LOW.contains(&half) => {
                has_halves = true;
                replaced.extend_from_slice(placeholder(half).encode_utf8(&mut [0; 4]).as_bytes());
                at += 6;
                continue;
            }
            (b'\\', _) => 2,
            _ => 1,
        };
        replaced.extend_from_slice(json.get(at..at + length).or_else(|| json.get(at..)).unwrap_or_default());
        at += length;
    }
    has_halves.then_some(replaced)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn halves_in_json() {
        let of = |json: &str| replaced(json.as_bytes()).map(|json| String::from_utf8(json).unwrap());
        assert_eq!(of(r#""a\ude01b""#).as_deref(), Some("\"a\u{f601}b\""));
        assert_eq!(of(r#""\uD83D""#).as_deref(), Some("\"\u{f03d}\""));
        assert_eq!(of(r#""\ud83d\ud83d\ude01""#).as_deref(), Some("\"\u{f03d}\\ud83d\\ude01\""));
        for json in [r#""\ud83d\ude01""#, r#""\\ude01""#, r#""\n""#, "\"\\", "\"\\u12", ""] {
            assert_eq!(of(json), None, "{json}");
        }
    }

    #[test]
    fn two_halves_are_a_character() {
        let (high, low) = of('\u{1f600}').unwrap();
        assert_eq!(between(Some(high), &format!("{low}b{high}{low}c{high}"), Some(low)), {
            format!("\u{1f600}b{high}{low}c\u{1f600}")
        });
        assert_eq!(between(Some(high), "", Some(low)), "\u{1f600}");
        assert_eq!(between(Some(high), &low.to_string(), Some(low)), format!("\u{1f600}{low}"));
        assert_eq!(between(None, &high.to_string(), Some(low)), "\u{1f600}");
        assert_eq!(of('a'), None);
    }
}
