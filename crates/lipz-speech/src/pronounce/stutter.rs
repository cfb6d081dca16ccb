//! Pronunciation of stutters.

use super::Pronouncer;
use super::variants::MOST;
use crate::{Phone, Pronunciation};

/// Returns the pronunciations of the start of a word that is said again: its first consonants, also with a short vowel
/// and with its own; a single letter also its first consonant alone; and at last the start read as a word.
pub(super) fn pronounce(pronouncer: &Pronouncer, start: &str, whole: &str) -> Vec<Pronunciation> {
    let mut all: Vec<Pronunciation> = Vec::new();
    let mut add = |phones: &[Phone], vowel: Option<Phone>, of: &Pronunciation| {
        let phones: Vec<Phone> = phones.iter().copied().chain(vowel).collect();
        if all.len() < MOST && !phones.is_empty() && all.iter().all(|known| known.phones != phones) {
            all.push(Pronunciation { phones, origin: of.origin });
        }
    };
    let is_letter = start.chars().count() == 1;
    for whole in &pronouncer.pronounce(whole) {
        let count = whole.phones.iter().take_while(|phone| !phone.is_vowel()).count();
        let (consonants, rest) = whole.phones.split_at(count);
        let first = if is_letter { &consonants[..count.min(1)] } else { consonants };
        for consonants in [first, consonants] {
            add(consonants, (!consonants.is_empty()).then_some(Phone::Ah), whole);
            add(consonants, None, whole);
        }
        add(consonants, rest.first().copied(), whole);
    }
    for read in &pronouncer.pronounce(start) {
        add(&read.phones, None, read);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Language;

    fn said(text: &str) -> Vec<Vec<String>> {
        let join = |phones: &[Phone]| phones.iter().map(|phone| phone.name()).collect::<Vec<_>>().join(" ");
        let script = Pronouncer::new(Language::ENGLISH).script(text);
        script.words.iter().map(|word| word.pronunciations.iter().map(|way| join(&way.phones)).collect()).collect()
    }

    #[test]
    fn starts_of_words_are_said_again() {
        let wait = said("W-w-wait!");
        assert_eq!(wait[0], ["W AH", "W", "W EY", "D AH B AH L Y UW"]);
        assert_eq!(wait[0], wait[1]);
        assert_eq!(said("P-please")[0][..4], ["P AH", "P", "P L AH", "P L"]);
        assert_eq!(said("th-the")[0][..2], ["DH AH", "DH"]);
        assert_eq!(said("wha-what")[0][..2], ["W AH", "W"]);
        for text in ["b\u{2014}but", "b\u{2014} but", "B... but", "b-- but"] {
            assert_eq!(said(text)[0][..2], ["B AH", "B"], "{text}");
        }
    }

    #[test]
    fn cut_words_are_said_as_far_as_they_are_written() {
        assert_eq!(said("I th\u{2014}")[1][..2], ["DH AH", "DH"]);
        assert_eq!(said("Str\u{2014}")[0][..2], ["S T R AH", "S T R"]);
        assert_eq!(said("I'm s\u{2014}")[1][..2], ["S AH", "S"]);
        assert_eq!(said("I sugg\u{2014}")[1], ["S AH G"]);
        for text in ["the TV\u{2014}", "plan B\u{2014}", "Mr.\u{2014}", "Hmm\u{2014}"] {
            assert_eq!(said(text).last(), said(&text.replace('\u{2014}', "")).last(), "{text}");
        }
    }

    #[test]
    fn whole_words_and_compounds_are_no_stutters() {
        for text in ["no-no", "I-I", "T-shirt", "so-so", "ex-wife", "co-op", "well, w w"] {
            assert!(said(text)[0].iter().all(|way| !way.ends_with(" AH")), "{text}");
        }
    }
}
