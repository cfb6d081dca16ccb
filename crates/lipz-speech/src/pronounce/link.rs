//! Linking sounds between two words: French *les amis*.

use super::rules::RuleTable;
use crate::{Origin, Phone, Word};

/// Adds linked pronunciations to words before a vowel, if only spaces or a hyphen are in between.
pub(super) fn link(text: &str, words: &mut [Word], table: &RuleTable) {
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

/// Whether a word begins with a vowel, in spelling and in pronunciation. This excludes *oui* and *yaourt*, which are
/// not linked.
fn begins_with_vowel(word: &Word) -> bool {
    let first = word.pronunciations.first().and_then(|pronunciation| pronunciation.phones.first());
    let letter = word.text.chars().next().is_some_and(|c| !matches!(c.to_ascii_lowercase(), 'y' | 'w'));
    let said = |first: &Phone| first.is_vowel() || *first == Phone::W && !word.text.eq_ignore_ascii_case("oui");
    letter && first.is_some_and(said)
}
