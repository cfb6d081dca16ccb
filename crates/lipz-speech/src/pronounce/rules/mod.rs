//! Letter-to-sound rules of a language: a table in `data/languages`, described in its `README.md`.

mod stress;
mod table;

use super::variants::{MOST, add, sequence};
use super::{Origin, Pronunciation, latin};
use crate::Phone;
use std::collections::HashMap;
use std::sync::LazyLock;
use table::Rule;
pub(super) use table::RuleTable;
use unicode_normalization::UnicodeNormalization;

macro_rules! tables {
    ($($code:literal)*) => {
        /// The tables by the codes of their languages; `und` is for all others.
        static TABLES: LazyLock<HashMap<&str, LazyLock<RuleTable>>> = LazyLock::new(|| {
            let mut tables: HashMap<&str, LazyLock<RuleTable>> = HashMap::new();
            $(tables.insert($code, LazyLock::new(|| {
                RuleTable::parse(include_str!(concat!("../../../data/languages/", $code, ".txt"))).0
            }));)*
            tables
        });

        #[cfg(test)]
        const SOURCES: &[(&str, &str)] =
            &[$(($code, include_str!(concat!("../../../data/languages/", $code, ".txt")))),*];
    };
}

tables! { "bg" "ca" "cs" "de" "es" "fi" "fr" "it" "nl" "pl" "pt" "ru" "tr" "uk" "und" }

/// Returns the table of a language, if it has one.
pub(super) fn table(code: &str) -> Option<&'static RuleTable> {
    TABLES.get(code).map(|table| &**table)
}

/// Unknown words in capitals up to this length may be spelled letter by letter.
const LONGEST_ACRONYM: usize = 5;

impl RuleTable {
    /// Returns all pronunciations of a word with this spelling.
    pub(super) fn pronounce(&self, spelling: &str, origin: Origin) -> Vec<Pronunciation> {
        let word: String = spelling.nfc().flat_map(|c| self.lower(c)).collect();
        let mut all: Vec<Pronunciation> = Vec::new();
        let with = |phones: Vec<Phone>, origin| Pronunciation { phones, origin };
        if let Some(own) = self.words.get(&word) {
            return own.iter().map(|phones| with(phones.clone(), origin)).collect();
        }
        let letters = word.chars().filter(|c| c.is_alphabetic()).count();
        let capitals = spelling.chars().filter(|c| c.is_uppercase()).count();
        let is_consonant = |c: char| c.is_alphabetic() && !self.vowels.contains(&c);
        if letters == 1 && word.chars().all(is_consonant)
            || capitals > 1 && capitals == letters && letters <= LONGEST_ACRONYM
        {
            all.extend(self.spelled(&word).map(|phones| with(phones, Origin::Letters)));
        }
        for phones in self.parts(&word) {
            if all.iter().all(|known| known.phones != phones) {
                all.push(with(phones, origin));
            }
        }
        all.retain(|pronunciation| !pronunciation.phones.is_empty());
        all
    }

    /// Reads the parts of a word between apostrophes: `c'est`.
    fn parts(&self, word: &str) -> Vec<Vec<Phone>> {
        if !word.contains('\'') {
            return self.read(word);
        }
        let parts =
            word.split_inclusive('\'').map(|part| self.words.get(part).cloned().unwrap_or_else(|| self.read(part)));
        sequence(&parts.collect::<Vec<_>>())
    }

    /// Converts a character to lower case by the rules of the language. Turkish has two kinds of `i`.
    fn lower(&self, c: char) -> Vec<char> {
        match c {
            '’' | 'ʼ' => vec!['\''],
            'I' if self.dotless => vec!['ı'],
            'İ' if self.dotless => vec!['i'],
            c => c.to_lowercase().collect(),
        }
    }

    /// Returns the names of the word's letters, if all have one.
    fn spelled(&self, word: &str) -> Option<Vec<Phone>> {
        let names: Option<Vec<_>> = word.chars().filter(|c| c.is_alphabetic()).map(|c| self.names.get(&c)).collect();
        let parts: Vec<Vec<Vec<Phone>>> = names?.into_iter().map(|name| self.read(name)).collect();
        sequence(&parts).into_iter().next().filter(|phones| !phones.is_empty())
    }

    /// Applies the rules to a word in lower case. Returns one pronunciation per alternative, and per stressed vowel if
    /// the stress is unknown.
    fn read(&self, word: &str) -> Vec<Vec<Phone>> {
        let letters = self.letters(word);
        let mut all = Vec::new();
        for stress in self.stress.places(self, &letters) {
            let (mut alternative, mut alternatives) = (0, 1);
            while alternative < alternatives && all.len() < MOST {
                let (phones, count) = self.apply(&letters, stress, alternative);
                alternatives = count;
                add(&mut all, phones);
                alternative += 1;
            }
        }
        all
    }

    /// Returns the characters of a word, without accents where rules only have the plain letter. A letter that occurs
    /// three times or more in a row is drawn out, and counts twice.
    fn letters(&self, word: &str) -> Vec<char> {
        let mut letters: Vec<char> = Vec::with_capacity(word.len());
        let mut push = |c: char| {
            if !(letters.len() > 1 && letters.ends_with(&[c, c])) {
                letters.push(c);
            }
        };
        for c in word.chars() {
            match self.rules.contains_key(&c) || !c.is_alphabetic() {
                true => push(c),
                false => latin::plain(c.encode_utf8(&mut [0; 4])).chars().for_each(&mut push),
            }
        }
        letters
    }

    /// Applies the rules once, with these alternatives. Also returns the number of alternatives.
    fn apply(&self, letters: &[char], stress: Option<usize>, alternative: usize) -> (Vec<Phone>, usize) {
        let mut phones = Vec::with_capacity(letters.len());
        let (mut at, mut alternatives) = (0, 1);
        while let Some(first) = letters.get(at) {
            let rules = self.rules.get(first).map_or(&[][..], Vec::as_slice);
            let Some(rule) = rules.iter().find(|rule| self.fits(rule, letters, at)) else {
                at += 1;
                continue;
            };
            let end = at + rule.letters.len();
            alternatives = alternatives.max(rule.sounds.len());
            if let Some(sounds) = rule.sounds.get(alternative).or(rule.sounds.last()) {
                let stressed = stress.is_none_or(|stress| (at..end).contains(&stress));
                phones.extend_from_slice(if stressed { &sounds.stressed } else { &sounds.unstressed });
            }
            at = end;
        }
        (phones, alternatives)
    }

    fn fits(&self, rule: &Rule, letters: &[char], at: usize) -> bool {
        let end = at + rule.letters.len();
        letters.get(at..end) == Some(rule.letters.as_slice())
            && rule.after.iter().enumerate().all(|(distance, item)| item.fits(letters.get(end + distance)))
            && rule.before.iter().enumerate().all(|(distance, item)| {
                let place = at.checked_sub(distance + 1);
                item.fits(place.and_then(|place| letters.get(place)))
            })
    }
}

#[cfg(test)]
mod tests;
