//! Stutters and cut words: `W-w-wait`, `P-please`, `wha-what`, `s… so`, `I th—`.

use super::tokens::{Token, TokenKind};

/// The most letters of a stutter.
const LONGEST: usize = 4;

/// The vowels of the Latin alphabet.
const VOWELS: [char; 6] = ['a', 'e', 'i', 'o', 'u', 'y'];

/// Signs between the start of a word and the word, without a blank behind them.
const HYPHENS: [&str; 3] = ["-", "\u{2010}", "\u{2011}"];

/// The same, perhaps with a blank behind them.
const BREAKS: [&str; 5] = ["\u{2013}", "\u{2014}", "--", "\u{2026}", "..."];

/// Signs behind a word that is cut off.
const DASHES: [&str; 3] = ["\u{2013}", "\u{2014}", "--"];

/// The consonants that words begin with, of two letters or more.
const ONSETS: [&str; 35] = [
    "bl", "br", "ch", "cl", "cr", "dr", "fl", "fr", "gl", "gr", "kn", "kr", "ph", "pl", "pr", "sch", "scr", "sh", "sk",
    "sl", "sm", "sn", "sp", "spl", "spr", "st", "str", "sw", "th", "thr", "tr", "tw", "wh", "wr", "zw",
];

/// Marks the words of a text that are the start of the word after them. A `known` word is one only if it has no vowel:
/// in `no-no` and `I-I`, the whole word is said twice. Then marks the first consonants of words that are cut off.
pub(super) fn mark(text: &str, words: &mut [Token], known: &dyn Fn(&str) -> bool) {
    for at in (1..words.len()).rev() {
        let (before, after) = words.split_at_mut(at);
        let (Some(word), Some(next)) = (before.last_mut(), after.first()) else { continue };
        let whole = match &next.kind {
            TokenKind::Word => &next.text,
            TokenKind::Stutter(whole) => whole,
            _ => continue,
        };
        let Some(letters) = short(word) else { continue };
        let between = text.get(word.range.start + letters.len()..next.range.start).unwrap_or_default();
        let is_apart = HYPHENS.contains(&between) || BREAKS.contains(&between.trim_end());
        let start = letters.to_lowercase();
        let is_start = whole.to_lowercase().starts_with(&start) && whole.chars().count() > start.chars().count();
        if is_apart && is_start && (!start.contains(VOWELS) || !known(letters)) {
            word.kind = TokenKind::Stutter(whole.clone());
        }
    }
    for word in words {
        let after = text.get(word.range.end..).unwrap_or_default();
        let Some(letters) = short(word).filter(|_| DASHES.iter().any(|dash| after.starts_with(dash))) else { continue };
        // Single capital letters are names: `plan B—`.
        let is_letter = letters.chars().all(|letter| letter.is_lowercase() && !VOWELS.contains(&letter));
        let is_onset = match letters.chars().count() {
            1 => is_letter,
            _ => ONSETS.contains(&letters.to_lowercase().as_str()) && letters.ends_with(char::is_lowercase),
        };
        if is_onset {
            // Any vowel does: only a hint of it can be said.
            word.kind = TokenKind::Stutter(format!("{letters}a"));
        }
    }
}

/// Returns the letters of a short word, without full stops.
fn short(word: &Token) -> Option<&str> {
    let letters = word.text.trim_end_matches('.');
    let is_short = letters.chars().count() <= LONGEST && letters.chars().all(char::is_alphabetic);
    (is_short && word.kind == TokenKind::Word).then_some(letters)
}
