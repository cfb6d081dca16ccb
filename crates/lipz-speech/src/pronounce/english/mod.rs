//! English words: looked up in the dictionary, then derived from its words, then from rules.

pub(crate) mod letters;
mod names;
mod scripted;
pub(crate) mod words;

use super::variants::{add, sequence};
use crate::{Origin, Phone, Pronunciation};

/// The least length of a part of a compound. Shorter parts match too many words.
const SHORTEST_PART: usize = 4;
/// Longer words are not searched for parts. No English word is longer.
const LONGEST_COMPOUND: usize = 32;
/// Unknown words in capitals up to this length may be spelled letter by letter.
const LONGEST_ACRONYM: usize = 5;

/// Returns the pronunciations of a word of Latin letters without accents, and apostrophes. `spelling` is the word as
/// written.
pub(super) fn pronounce(word: &str, spelling: &str) -> Vec<Pronunciation> {
    let with = |all: Vec<Vec<Phone>>, origin| {
        all.into_iter().map(|phones| Pronunciation { phones, origin }).collect::<Vec<_>>()
    };
    let known = known(word, spelling.starts_with(char::is_uppercase));
    if !known.is_empty() {
        return with(known, Origin::Dictionary);
    }
    let letters: usize = word.bytes().filter(u8::is_ascii_lowercase).count();
    if letters == 0 {
        return Vec::new();
    }
    let mut all = Vec::new();
    let capitals = spelling.chars().filter(|c| c.is_uppercase()).count();
    if letters == 1 || capitals > 1 && capitals == letters && letters <= LONGEST_ACRONYM {
        all.extend(with(vec![names::spelled(word)], Origin::Letters));
    }
    let stem = word.strip_suffix("'s").unwrap_or(word);
    let mut rules = compound(stem);
    add(&mut rules, letters::phones(stem));
    if stem.len() < word.len() {
        rules = rules.into_iter().map(with_s).collect();
    }
    all.extend(with(rules, Origin::Rules));
    // Rules may return no phones.
    all.retain(|pronunciation| !pronunciation.phones.is_empty());
    all
}

/// Whether the dictionary contains the word as it is.
pub(super) fn knows(word: &str) -> bool {
    !words::find(word).is_empty()
}

/// Returns the dictionary's pronunciations of the word, or of the word without an ending or drawn-out letters.
fn known(word: &str, is_capital: bool) -> Vec<Vec<Phone>> {
    let found = scripted::find(word, is_capital);
    if !found.is_empty() {
        return found;
    }
    if let Some(stem) = word.strip_suffix("'s").or_else(|| word.strip_suffix("s'").filter(|stem| stem.len() > 1)) {
        let whole = if word.ends_with("s'") { words::find(&word[..word.len() - 1]) } else { Vec::new() };
        return match whole.is_empty() {
            true => words::find(stem).into_iter().map(with_s).collect(),
            false => whole,
        };
    }
    if word.ends_with("in'") {
        let mut found = words::find(&word.replace('\'', "g"));
        for phones in &mut found {
            if let Some(last @ Phone::Ng) = phones.last_mut() {
                *last = Phone::N;
            }
        }
        return found;
    }
    drawn_out(word).iter().flat_map(|word| scripted::find(word, is_capital)).fold(Vec::new(), |mut all, phones| {
        add(&mut all, phones);
        all
    })
}

/// Adds the ending of the plural and of *'s*.
fn with_s(mut phones: Vec<Phone>) -> Vec<Phone> {
    use Phone::{Ch, F, Ih, Jh, K, P, S, Sh, T, Th, Z, Zh};
    match phones.last() {
        Some(S | Z | Sh | Zh | Ch | Jh) => phones.extend([Ih, Z]),
        Some(P | T | K | F | Th) => phones.push(S),
        _ => phones.push(Z),
    }
    phones
}

/// Returns a drawn-out word (`Nooooo`, `gooood`) with each letter that occurs three times or more reduced to one, and
/// to two. The more likely comes first: one at the end of a word, two inside.
fn drawn_out(word: &str) -> Vec<String> {
    let with = |count: usize| {
        let runs = word.as_bytes().chunk_by(|one, two| one == two);
        let kept = runs.flat_map(|run| &run[..if run.len() > 2 { count } else { run.len() }]);
        kept.map(|byte| char::from(*byte)).collect::<String>()
    };
    let twice = with(2);
    if twice.len() == word.len() || !word.is_ascii() {
        return Vec::new();
    }
    let at_end = word.as_bytes().iter().rev().take_while(|byte| word.as_bytes().last() == Some(byte)).count() > 2;
    if at_end { vec![with(1), twice] } else { vec![twice, with(1)] }
}

/// Splits the word into two words of the dictionary, such as `moon` and `stone`, of the most similar lengths.
fn compound(word: &str) -> Vec<Vec<Phone>> {
    let length = word.len();
    if !(2 * SHORTEST_PART..=LONGEST_COMPOUND).contains(&length) || !word.is_ascii() {
        return Vec::new();
    }
    let mut places: Vec<usize> = (SHORTEST_PART..=length - SHORTEST_PART).collect();
    places.sort_by_key(|place| (2 * place).abs_diff(length));
    for place in places {
        let (one, two) = word.split_at(place);
        let two = words::find(two);
        let one = if two.is_empty() { Vec::new() } else { words::find(one) };
        if !one.is_empty() {
            return sequence(&[one, two]);
        }
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(word: &str) -> Vec<(String, Origin)> {
        let join = |phones: &[Phone]| phones.iter().map(|phone| phone.name()).collect::<Vec<_>>().join(" ");
        let all = pronounce(&word.to_lowercase(), word);
        all.iter().map(|pronunciation| (join(&pronunciation.phones), pronunciation.origin)).collect()
    }

    fn first(word: &str) -> (String, Origin) {
        said(word).into_iter().next().expect(word)
    }

    #[test]
    fn words_come_from_the_dictionary_where_they_can() {
        let cases = [
            ("Hello", "HH AH L OW", Origin::Dictionary),
            ("soooo", "S OW", Origin::Dictionary),
            ("gooood", "G UH D", Origin::Dictionary),
            ("Nooo", "N OW", Origin::Dictionary),
            ("lich's", "L IH CH IH Z", Origin::Dictionary),
            ("axolotl's", "AE K S AA L AA T AH L Z", Origin::Rules),
            ("elves'", "EH L V Z", Origin::Dictionary),
            ("gloamin'", "G L OW M IH N", Origin::Dictionary),
            ("walkin'", "W AO K IH N", Origin::Dictionary),
            ("moonforge", "M UW N F AO R JH", Origin::Rules),
            ("NPC", "EH N P IY S IY", Origin::Letters),
            ("R", "AA R", Origin::Dictionary),
            ("Capt", "K AE P T AH N", Origin::Dictionary),
            ("Rev", "R EH V ER AH N D", Origin::Dictionary),
            ("rev", "R EH V", Origin::Dictionary),
            ("vs", "V ER S AH S", Origin::Dictionary),
            ("M'lord", "M AH L AO R D", Origin::Dictionary),
            ("Psssst", "P S T", Origin::Dictionary),
            ("Brrrr", "B R", Origin::Dictionary),
        ];
        for (word, phones, origin) in cases {
            assert_eq!(first(word), (phones.to_owned(), origin), "{word}");
        }
        assert_eq!(said("NPC").len(), 2, "as a word, too");
        assert_eq!(said("''"), []);
    }
}
