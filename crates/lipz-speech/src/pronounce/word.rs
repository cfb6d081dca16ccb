//! One word: its parts by their writing, each read by the language that can.

use super::{english, hangul, kana, latin, mandarin, rules, variants};
use crate::text::{Writing, numbers, writing};
use crate::{Language, Origin, Phone, Pronunciation, Reliance};
use any_ascii::any_ascii;

/// Whether the dictionary of the language has the word as it is.
pub(super) fn knows(language: Language, word: &str) -> bool {
    language == Language::ENGLISH && english::knows(&latin::plain(word))
}

/// Whether nothing but a guess tells how the word is read.
pub(super) fn needs_reading(pronouncer: &super::Pronouncer, word: &str, pronunciations: &[Pronunciation]) -> bool {
    let guessed = pronunciations.iter().all(|pronunciation| pronunciation.origin == Origin::Letters);
    pronouncer.language().code() == "ja" && guessed && word.chars().any(|c| writing(c) == Writing::Han)
}

/// All pronunciations of a word.
pub(super) fn pronounce(language: Language, word: &str) -> Vec<Pronunciation> {
    let parts = parts(word);
    if let [(writing, part)] = parts.as_slice() {
        let mut all = part_of(language, *writing, part);
        all.retain(|pronunciation| !pronunciation.phones.is_empty());
        return all;
    }
    // `R2D2`, `Tシャツ`: part by part.
    let all: Vec<Vec<Pronunciation>> = parts.iter().map(|(writing, part)| part_of(language, *writing, part)).collect();
    let origin = all.iter().flatten().map(|pronunciation| pronunciation.origin).max().unwrap_or(Origin::Letters);
    let ways = |all: &Vec<Pronunciation>| all.iter().map(|pronunciation| pronunciation.phones.clone()).collect();
    let phones: Vec<Vec<Vec<Phone>>> = all.iter().map(ways).collect();
    let mut whole = variants::sequence(&phones);
    whole.retain(|phones| !phones.is_empty());
    whole.into_iter().map(|phones| Pronunciation { phones, origin }).collect()
}

/// Stretches of a word in the same writing. Characters without one belong to what is before them.
fn parts(word: &str) -> Vec<(Writing, &str)> {
    let mut parts: Vec<(Writing, usize, usize)> = Vec::new();
    for (at, c) in word.char_indices() {
        let end = at + c.len_utf8();
        match (parts.last_mut(), writing(c)) {
            (Some(last), next) if next == last.0 || next == Writing::None || c == 'ー' => last.2 = end,
            (Some(last), next) if last.0 == Writing::None => (last.0, last.2) = (next, end),
            (_, next) => parts.push((next, at, end)),
        }
    }
    parts.into_iter().filter_map(|(writing, start, end)| Some((writing, word.get(start..end)?))).collect()
}

/// A part of a word that is all in one writing.
fn part_of(language: Language, writing: Writing, part: &str) -> Vec<Pronunciation> {
    let by_rules =
        |code: &str, part: &str, origin| rules::table(code).map_or(Vec::new(), |table| table.pronounce(part, origin));
    let own = language.code();
    match (writing, language.reliance()) {
        (Writing::Digit, _) => digits(language, part),
        (Writing::Latin, Reliance::Rules) if !matches!(own, "bg" | "ru" | "uk") => by_rules(own, part, Origin::Rules),
        (Writing::Latin, Reliance::Letters) => by_rules("und", part, Origin::Letters),
        // English words in other scripts are English.
        (Writing::Latin, _) => english::pronounce(&latin::plain(part), part),
        (Writing::Hiragana | Writing::Katakana, _) => kana::pronounce(part),
        (Writing::Hangul, _) => hangul::pronounce(part),
        (Writing::Han, Reliance::Kana) => kana::characters(part, |han| {
            by_rules("und", &any_ascii(han), Origin::Letters).into_iter().map(|way| way.phones).collect()
        }),
        (Writing::Han, _) => {
            mandarin::pronounce(part).unwrap_or_else(|| by_rules("und", &any_ascii(part), Origin::Letters))
        }
        (Writing::Cyrillic, _) => match own {
            "bg" | "ru" | "uk" => by_rules(own, part, Origin::Rules),
            "be" => by_rules("uk", part, Origin::Letters),
            "mk" | "sr" | "bs" => by_rules("bg", part, Origin::Letters),
            _ => by_rules("ru", part, Origin::Letters),
        },
        (Writing::Consonantal, _) => with_vowels(by_rules("und", &any_ascii(part), Origin::Letters)),
        _ => by_rules("und", &any_ascii(part), Origin::Letters),
    }
}

/// Between consonants somebody says a vowel that is not written: which one, lips hardly show.
fn with_vowels(mut all: Vec<Pronunciation>) -> Vec<Pronunciation> {
    for pronunciation in &mut all {
        let mut phones: Vec<Phone> = Vec::with_capacity(2 * pronunciation.phones.len());
        for phone in &pronunciation.phones {
            if phones.last().is_some_and(|last| !last.is_vowel()) && !phone.is_vowel() {
                phones.push(Phone::Ah);
            }
            phones.push(*phone);
        }
        pronunciation.phones = phones;
    }
    all
}

/// Digits inside of a word, as in `R2D2`.
fn digits(language: Language, part: &str) -> Vec<Pronunciation> {
    let mut all = Vec::new();
    for reading in numbers::row(language.code(), part) {
        let words = reading.split([' ', '-', '\u{ad}']).filter(|word| !word.is_empty());
        let ways = |word| pronounce(language, word).into_iter().map(|way| way.phones).collect();
        let ways: Vec<Vec<Vec<Phone>>> = words.map(ways).collect();
        for phones in variants::sequence(&ways) {
            variants::add(&mut all, phones);
        }
    }
    all.into_iter().map(|phones| Pronunciation { phones, origin: Origin::Rules }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_divided_where_the_writing_changes() {
        assert_eq!(parts("R2D2").len(), 4);
        assert_eq!(parts("らーめん").len(), 1);
        assert_eq!(parts("'em"), [(Writing::Latin, "'em")]);
        assert_eq!(parts(""), []);
        assert_eq!(parts("d'été"), [(Writing::Latin, "d'été")]);
    }
}
