//! Conversion of a part of a key to an identifier: its words, and the conventions of languages for joining them.
//!
//! The crate `heck` does this for ASCII identifiers. It drops the combining marks that many languages need, so that
//! this module finds the words itself.

use std::iter;
use unicode_ident::{is_xid_continue, is_xid_start};
use unicode_normalization::UnicodeNormalization;

/// Returns the words of a part of a key: runs of characters that Unicode allows in identifiers (Unicode Standard Annex
/// 31), divided where a capital starts a new word. A part without any becomes one word, with its characters as numbers.
pub(super) fn words(part: &str) -> Vec<String> {
    let composed: Vec<char> = part.nfc().collect();
    let mut words = Vec::new();
    let mut word = String::new();
    for (index, &c) in composed.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| composed[before]);
        let starts = before.is_some_and(|before| starts_word(before, c, composed.get(index + 1).copied()));
        if (starts || !is_word(c)) && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        if is_word(c) {
            word.push(c);
        }
    }
    if !word.is_empty() {
        words.push(word);
    }
    if composed.is_empty() {
        words.push("Empty".to_owned()); // for `//`, in the key of a bank that lipz did not make
    } else if words.is_empty() {
        words.push(composed.into_iter().map(number).collect());
    }
    words
}

/// Whether languages allow the character within an identifier, and it does not separate words.
fn is_word(c: char) -> bool {
    is_xid_continue(c) && !matches!(c, '_' | '·')
}

/// Whether `c` is the capital of a new word: `mara|Hello`, `act1|Hello`, `HTTP|Server`.
fn starts_word(before: char, c: char, after: Option<char>) -> bool {
    c.is_uppercase()
        && (before.is_lowercase()
            || before.is_numeric()
            || before.is_uppercase() && after.is_some_and(char::is_lowercase))
}

/// Returns the character as letters and digits that every language allows: `U1F600`.
fn number(c: char) -> String {
    format!("U{:04X}", u32::from(c))
}

/// Returns `MARA_GOOD_EVENING`.
pub(super) fn upper_snake(words: &[String]) -> String {
    finished(&words.iter().map(|word| word.to_uppercase()).collect::<Vec<_>>().join("_"))
}

/// Returns `mara_good_evening`.
pub(super) fn snake(words: &[String]) -> String {
    finished(&words.iter().map(|word| word.to_lowercase()).collect::<Vec<_>>().join("_"))
}

/// Returns `MaraGoodEvening`.
pub(super) fn pascal(words: &[String]) -> String {
    finished(&humped(String::new(), words))
}

/// Returns `maraGoodEvening`.
pub(super) fn camel(words: &[String]) -> String {
    match words {
        [first, rest @ ..] => finished(&humped(first.to_lowercase(), rest)),
        [] => String::new(),
    }
}

/// Appends the words, each with a capital. Adjacent digits are separated: `take-1-12` differs from `take-11-2`.
fn humped(mut name: String, words: &[String]) -> String {
    for word in words {
        if name.ends_with(char::is_numeric) && word.starts_with(char::is_numeric) {
            name.push('_');
        }
        let mut chars = word.chars();
        name.extend(chars.next().into_iter().flat_map(char::to_uppercase));
        name.push_str(&chars.as_str().to_lowercase());
    }
    name
}

/// Returns the name, with `_` before it if it cannot start an identifier; composed, because compilers compare names in
/// this form (UAX 31, NFC).
fn finished(name: &str) -> String {
    let name: String = name.nfc().collect();
    if name.starts_with(is_xid_start) { name } else { format!("_{name}") }
}

/// Returns the word in ASCII: letters lose their accents, other characters are replaced by their numbers.
pub(super) fn ascii(word: &str) -> String {
    spelled(word, |c| {
        let plain: String = iter::once(c).nfkd().filter(char::is_ascii_alphanumeric).collect();
        if plain.is_empty() { number(c) } else { plain }
    })
}

/// Returns the word with the characters beyond U+FFFF, which C# does not allow, replaced by their numbers.
pub(super) fn basic_plane(word: &str) -> String {
    spelled(word, |c| if c > '\u{FFFF}' { number(c) } else { c.to_string() })
}

fn spelled(word: &str, of: impl Fn(char) -> String) -> String {
    word.chars().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(part: &str) -> String {
        words(part).join(" ")
    }

    #[test]
    fn words_are_divided_by_punctuation_and_capitals() {
        for (part, expected) in [
            ("mara-good-evening", "mara good evening"),
            ("mara good..evening_", "mara good evening"),
            ("maraGoodEvening", "mara Good Evening"),
            ("HTTPServer", "HTTP Server"),
            ("act1Hello", "act1 Hello"),
            ("take-1-12", "take 1 12"),
            ("col·lecció", "col lecció"),
            ("नमस्ते-दुनिया", "नमस्ते दुनिया"),
            ("はい、船長", "はい 船長"),
            ("A\u{308}rger", "\u{c4}rger"),
            ("🎉!", "U1F389U0021"),
        ] {
            assert_eq!(joined(part), expected, "{part:?}");
        }
    }

    #[test]
    fn identifiers_start_as_languages_ask_for() {
        assert_eq!(upper_snake(&words("2nd take")), "_2ND_TAKE");
        assert_eq!(camel(&words("2nd take")), "_2ndTake");
        assert_eq!(snake(&words("straßeÄrger")), "straße_ärger");
        assert_eq!(upper_snake(&words("straße")), "STRASSE");
    }

    fn is_identifier(name: &str) -> bool {
        let mut chars = name.chars();
        chars.next().is_some_and(|c| c == '_' || is_xid_start(c)) && chars.all(is_xid_continue)
    }

    proptest::proptest! {
        #[test]
        fn whatever_a_part_contains_it_becomes_an_identifier(part in "\\PC{1,12}|[a-zA-Z0-9_ .!ßÄéǆŉİ·ः-]{1,12}") {
            let words = words(&part);
            for join in [upper_snake, snake, pascal, camel] {
                let name = join(&words);
                proptest::prop_assert!(is_identifier(&name) && name != "_", "{part:?}: {name:?}");
                let plain: Vec<String> = words.iter().map(|word| ascii(word)).collect();
                proptest::prop_assert!(is_identifier(&join(&plain)) && join(&plain).is_ascii(), "{part:?}: {plain:?}");
            }
        }
    }

    #[test]
    fn digits_that_meet_stay_apart() {
        assert_eq!(pascal(&words("take-1-12")), "Take1_12");
        assert_eq!(camel(&words("take-11-2")), "take11_2");
    }

    #[test]
    fn ascii_keeps_what_can_be_read() {
        assert_eq!(ascii("Ärger"), "Arger");
        assert_eq!(ascii("Ⅷﬁ"), "VIIIfi");
        assert_eq!(ascii("はi"), "U306Fi");
        assert_eq!(basic_plane("は𐐀"), "はU10400");
    }
}
