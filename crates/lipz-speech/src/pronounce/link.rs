//! Sounds between two words: French *les amis*.

use super::rules::Table;
use crate::{Origin, Phone, Word};

/// Adds to words that link the pronunciations with which they do, where the next word begins with a vowel and nothing
/// but blanks or a hyphen is between them.
pub(super) fn link(text: &str, words: &mut [Word], table: &Table) {
    for at in 1..words.len() {
        let [.., word, next] = &mut words[..=at] else { continue };
        let sound = table.links.get(&word.text.to_lowercase().replace('’', "'"));
        let gap = text.get(word.range.end..next.range.start);
        if !gap.is_some_and(|gap| !gap.is_empty() && gap.chars().all(|c| c.is_whitespace() || c == '-'))
            || !begins_with_vowel(next)
        {
            continue;
        }
        let Some(sound) = sound.filter(|_| word.origin() == Some(Origin::Rules)) else { continue };
        let linked = word.pronunciations.iter().map(|pronunciation| {
            let mut linked = pronunciation.clone();
            linked.phones.push(*sound);
            linked
        });
        let plain = word.pronunciations.clone();
        word.pronunciations = linked.chain(plain).collect();
    }
}

/// Whether a word begins with a vowel, written and said. *oui* and *yaourt* do not: nobody links them.
fn begins_with_vowel(word: &Word) -> bool {
    let first = word.pronunciations.first().and_then(|pronunciation| pronunciation.phones.first());
    let letter = word.text.chars().next().is_some_and(|c| !matches!(c.to_ascii_lowercase(), 'y' | 'w'));
    let said = |first: &Phone| first.is_vowel() || *first == Phone::W && !word.text.eq_ignore_ascii_case("oui");
    letter && first.is_some_and(said)
}
