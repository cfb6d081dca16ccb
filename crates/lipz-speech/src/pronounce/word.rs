//! Pronunciation of one word: its parts by script, each read by a suitable language.

use super::{english, hangul, kana, latin, mandarin, rules, variants};
use crate::text::{WritingSystem, numbers, writing};
use crate::{Language, Origin, Phone, Pronunciation, Reliance};
use any_ascii::any_ascii;

/// Whether the dictionary of the language contains the word as it is.
pub(super) fn knows(language: Language, word: &str) -> bool {
    language == Language::ENGLISH && english::knows(&latin::plain(word))
}

/// Whether the pronunciation of the word is only a guess.
pub(super) fn needs_reading(pronouncer: &super::Pronouncer, word: &str, pronunciations: &[Pronunciation]) -> bool {
    let guessed = pronunciations.iter().all(|pronunciation| pronunciation.origin == Origin::Letters);
    pronouncer.language().code() == "ja" && guessed && word.chars().any(|c| writing(c) == WritingSystem::Han)
}

/// Returns all pronunciations of a word.
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

/// Splits a word into stretches of the same script. Characters without a script belong to the stretch before them.
fn parts(word: &str) -> Vec<(WritingSystem, &str)> {
    let mut parts: Vec<(WritingSystem, usize, usize)> = Vec::new();
    for (at, c) in word.char_indices() {
        let end = at + c.len_utf8();
        match (parts.last_mut(), writing(c)) {
            (Some(last), next) if next == last.0 || next == WritingSystem::None || c == 'ー' => last.2 = end,
            (Some(last), next) if last.0 == WritingSystem::None => (last.0, last.2) = (next, end),
            (_, next) => parts.push((next, at, end)),
        }
    }
    parts.into_iter().filter_map(|(writing, start, end)| Some((writing, word.get(start..end)?))).collect()
}

/// Returns the pronunciations of a part of a word in one script.
fn part_of(language: Language, writing: WritingSystem, part: &str) -> Vec<Pronunciation> {
    let by_rules =
        |code: &str, part: &str, origin| rules::table(code).map_or(Vec::new(), |table| table.pronounce(part, origin));
    let own = language.code();
    match (writing, language.reliance()) {
        (WritingSystem::Digit, _) => digits(language, part),
        (WritingSystem::Latin, Reliance::Rules) if !matches!(own, "bg" | "ru" | "uk") => {
            by_rules(own, part, Origin::Rules)
        }
        (WritingSystem::Latin, Reliance::Letters) => by_rules("und", part, Origin::Letters),
        // English words in other scripts are English.
        (WritingSystem::Latin, _) => english::pronounce(&latin::plain(part), part),
        (WritingSystem::Hiragana | WritingSystem::Katakana, _) => kana::pronounce(part),
        (WritingSystem::Hangul, _) => hangul::pronounce(part),
        (WritingSystem::Han, Reliance::Kana) => kana::characters(part, |han| {
            by_rules("und", &any_ascii(han), Origin::Letters).into_iter().map(|way| way.phones).collect()
        }),
        (WritingSystem::Han, _) => {
            mandarin::pronounce(part).unwrap_or_else(|| by_rules("und", &any_ascii(part), Origin::Letters))
        }
        (WritingSystem::Cyrillic, _) => match own {
            "bg" | "ru" | "uk" => by_rules(own, part, Origin::Rules),
            "be" => by_rules("uk", part, Origin::Letters),
            "mk" | "sr" | "bs" => by_rules("bg", part, Origin::Letters),
            _ => by_rules("ru", part, Origin::Letters),
        },
        (WritingSystem::Consonantal, _) => with_vowels(by_rules("und", &any_ascii(part), Origin::Letters)),
        _ => by_rules("und", &any_ascii(part), Origin::Letters),
    }
}

/// Adds the unwritten vowels between consonants. Lips hardly show their quality.
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

/// Returns the pronunciations of digits inside a word, as in `R2D2`.
fn digits(language: Language, part: &str) -> Vec<Pronunciation> {
    let mut all = Vec::new();
    // `v2.0` has a decimal, not a row of digits.
    let decimal = numbers::spelled(language.code(), part, 0).filter(|_| part.contains(['.', ',']));
    let decimal = decimal.filter(|spelled| spelled.length == part.len()).map(|spelled| spelled.readings);
    for reading in decimal.unwrap_or_else(|| numbers::row(language.code(), part)) {
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
        assert_eq!(parts("'em"), [(WritingSystem::Latin, "'em")]);
        assert_eq!(parts(""), []);
        assert_eq!(parts("d'été"), [(WritingSystem::Latin, "d'été")]);
    }
}
