//! Stutters: `W-w-wait`, `P-please`, `wha-what`.

use super::tokens::{Token, TokenKind};

/// The most letters of a stutter.
const LONGEST: usize = 4;

/// Marks the words of a text that are the start of the word after their hyphen. A `known` word is one only if it has no
/// vowel: in `no-no` and `I-I`, the whole word is said twice.
pub(super) fn mark(text: &str, words: &mut [Token], known: &dyn Fn(&str) -> bool) {
    for at in (1..words.len()).rev() {
        let (before, after) = words.split_at_mut(at);
        let (Some(word), Some(next)) = (before.last_mut(), after.first()) else { continue };
        let whole = match &next.kind {
            TokenKind::Word => &next.text,
            TokenKind::Stutter(whole) => whole,
            _ => continue,
        };
        let between = text.get(word.range.end..next.range.start);
        let letters = word.text.to_lowercase();
        let is_start = between.is_some_and(|between| matches!(between, "-" | "\u{2010}" | "\u{2011}"))
            && word.kind == TokenKind::Word
            && letters.chars().count() <= LONGEST
            && letters.chars().all(char::is_alphabetic)
            && whole.to_lowercase().starts_with(&letters)
            && whole.chars().count() > letters.chars().count();
        if is_start && (!letters.contains(['a', 'e', 'i', 'o', 'u', 'y']) || !known(&word.text)) {
            word.kind = TokenKind::Stutter(whole.clone());
        }
    }
}
