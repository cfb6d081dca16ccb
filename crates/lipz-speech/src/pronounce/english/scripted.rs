//! Words of scripts that dictionaries lack: abbreviations of ranks and titles, and sounds that are not words.

use super::words;
use crate::Phone;

/// Abbreviations and their words. Some are also words, such as *rev*, so the recording decides.
const ABBREVIATIONS: &[(&str, &str)] = &[
    ("adm", "admiral"),
    ("approx", "approximately"),
    ("capt", "captain"),
    ("cdr", "commander"),
    ("cmdr", "commander"),
    ("col", "colonel"),
    ("cpl", "corporal"),
    ("cpt", "captain"),
    ("dept", "department"),
    ("det", "detective"),
    ("esq", "esquire"),
    ("gen", "general"),
    ("gov", "governor"),
    ("hon", "honorable"),
    ("insp", "inspector"),
    ("lt", "lieutenant"),
    ("maj", "major"),
    ("pfc", "private"),
    ("prof", "professor"),
    ("pvt", "private"),
    ("rep", "representative"),
    ("rev", "reverend"),
    ("sen", "senator"),
    ("sgt", "sergeant"),
    ("supt", "superintendent"),
    ("vs", "versus"),
];

/// Sounds, and words of old-fashioned servants, with their pronunciations.
const SOUNDS: &[(&str, &[&str])] = &[
    ("argh", &["AA R", "AA R G"]),
    ("brr", &["B R", "B ER"]),
    ("eek", &["IY K"]),
    ("grr", &["G R", "G ER"]),
    ("m'ladies", &["M AH L EY D IY Z", "M L EY D IY Z"]),
    ("m'lady", &["M AH L EY D IY", "M L EY D IY"]),
    ("m'lord", &["M AH L AO R D", "M L AO R D"]),
    ("m'lords", &["M AH L AO R D Z", "M L AO R D Z"]),
    ("pah", &["P AA"]),
    ("psst", &["P S T"]),
    ("pst", &["P S T"]),
    ("rr", &["R", "ER"]),
    ("zz", &["Z"]),
    ("zzz", &["Z"]),
];

/// Returns all pronunciations of a word in lower case that scripts or the dictionary contain. A word whose first letter
/// `is_capital` is more likely an abbreviation.
pub(super) fn find(word: &str, is_capital: bool) -> Vec<Vec<Phone>> {
    let mut all = Vec::new();
    let sounds = SOUNDS.iter().find(|(sound, _)| *sound == word).map_or(&[][..], |(_, sounds)| sounds);
    all.extend(sounds.iter().map(|phones| phones.split(' ').filter_map(|phone| phone.parse().ok()).collect()));
    let known = words::find(word);
    let long = ABBREVIATIONS.iter().find(|(short, _)| *short == word);
    let long = long.map(|(_, long)| words::find(long)).unwrap_or_default();
    // The dictionary spells out what has no vowel.
    let is_word = !is_capital && word.contains(['a', 'e', 'i', 'o', 'u']) && !known.is_empty();
    let (first, second) = if is_word { (known, long) } else { (long, known) };
    for phones in first.into_iter().chain(second) {
        super::add(&mut all, phones);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_sorted_and_have_pronunciations() {
        assert!(ABBREVIATIONS.is_sorted() && SOUNDS.is_sorted());
        for (short, long) in ABBREVIATIONS {
            assert!(!words::find(long).is_empty(), "{short}");
        }
        for (sound, all) in SOUNDS {
            for phones in *all {
                assert!(phones.split(' ').all(|phone| phone.parse::<Phone>().is_ok()), "{sound}");
            }
        }
    }
}
