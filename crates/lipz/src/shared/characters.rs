//! The characters in the events and in the key of a clip.

use lipz_bank::{Clip, EventName};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Returns the characters that the events of a clip name.
pub(crate) fn in_events<'data>(clip: &Clip<'data>) -> BTreeSet<&'data str> {
    let of_segment = |segment: lipz_bank::Segment<'data>| segment.events().collect::<Vec<_>>();
    clip.segments().flat_map(of_segment).filter_map(|event| event.character.map(EventName::as_str)).collect()
}

/// The first spelling found of each name: `Mara` in a text is `mara` in the events.
#[derive(Clone, Default)]
pub(crate) struct Spellings(BTreeMap<String, String>);

impl Spellings {
    /// Returns the spelling of a name, which is this one if it is new.
    pub(crate) fn of(&mut self, name: &str) -> String {
        self.0.entry(name.to_lowercase()).or_insert_with(|| name.to_owned()).clone()
    }

    /// Returns the first spelling of a name, or the name itself.
    pub(crate) fn known<'n>(&'n self, name: &'n str) -> &'n str {
        self.0.get(&name.to_lowercase()).map_or(name, String::as_str)
    }

    /// Returns all names by their number of words, and by these words.
    pub(crate) fn by_words(&self) -> ByWords<'_> {
        let mut names = ByWords::new();
        for name in self.0.values() {
            let words = words(name);
            if !words.is_empty() {
                names.entry(words.len()).or_default().entry(words).or_default().push(name);
            }
        }
        names
    }
}

/// Names by their number of words, and by these words. Several names can have the same words: `Old_Man` and `old-man`.
pub(crate) type ByWords<'s> = BTreeMap<usize, HashMap<Vec<String>, Vec<&'s String>>>;

/// Returns the names whose words occur next to each other in a key: `Old_Man` is in `act1/old-man-hello`. Comparing
/// each name with each key would take minutes for large numbers of both.
pub(crate) fn in_key(key: &str, names: &ByWords<'_>) -> BTreeSet<String> {
    let key = words(key);
    let mut found = BTreeSet::new();
    for (word_count, names) in names {
        let of_words = key.windows(*word_count).filter_map(|words| names.get(words));
        found.extend(of_words.flatten().map(|name| (*name).clone()));
    }
    found
}

/// Returns the name whose words occur first in a key, the longest of those at the same place.
pub(crate) fn first_in_key(key: &str, names: &ByWords<'_>) -> Option<String> {
    let key = words(key);
    let starting_at = |at: usize| {
        let of_words = |(word_count, names): (&usize, &HashMap<Vec<String>, Vec<&String>>)| {
            names.get(key.get(at..at + word_count)?)?.first().map(|name| (*name).clone())
        };
        names.iter().rev().find_map(of_words)
    };
    (0..key.len()).find_map(starting_at)
}

/// Returns the words of a key or name in lower case: `act1`, `mara`, `good` and `evening` of `act1/Mara-good_evening`.
fn words(key: &str) -> Vec<String> {
    key.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).map(str::to_lowercase).collect()
}
