//! The words that make people nod, shake their heads or shrug: `data/gestures.txt`.

use super::shapes::GestureKind;
use foldhash::{HashMap, HashMapExt}; // seeded differently in each process, so the order of entries is never used
use std::sync::LazyLock;

/// The lists of each language, by its code.
static ALL: LazyLock<HashMap<&'static str, Lists>> = LazyLock::new(|| all(include_str!("../../../data/gestures.txt")));

/// Codes of languages that share the words of another code.
const ALIASES: [(&str, &str); 5] = [("nb", "no"), ("cmn", "zh"), ("in", "id"), ("iw", "he"), ("tl", "fil")];

/// The wildcard for any number of further letters.
const ANY: char = '*';

/// The words of a language.
#[derive(Default)]
pub(super) struct Lists {
    /// Phrases by their first words.
    phrases: HashMap<&'static str, Vec<Phrase>>,
    /// Words with wildcards (`*`).
    patterns: Vec<Phrase>,
}

/// A word or phrase with its gesture.
struct Phrase {
    kind: GestureKind,
    words: Vec<&'static str>,
    /// The number of its letters. If several phrases match, the longest one counts.
    length: usize,
}

/// A phrase at the start of a list of words.
pub(super) struct FoundPhrase {
    pub(super) kind: GestureKind,
    /// The number of its words.
    pub(super) word_count: usize,
    /// The number of letters that the first word has before the phrase.
    pub(super) letters_before: usize,
}

impl Lists {
    /// Returns the words in the language of a locale, if there are any.
    pub(super) fn of(tag: &str) -> Option<&'static Lists> {
        let code = tag.split('-').next().unwrap_or_default();
        let code = ALIASES.iter().find(|(alias, _)| *alias == code).map_or(code, |(_, code)| code);
        ALL.get(code)
    }

    /// Returns the longest phrase at the start of `words`, which are in lower case.
    pub(super) fn longest(&self, words: &[String]) -> Option<FoundPhrase> {
        let (first, rest) = words.split_first()?;
        let is_there = |phrase: &&Phrase| {
            let behind = phrase.words.get(1..).unwrap_or_default();
            behind.len() <= rest.len() && behind.iter().zip(rest).all(|(word, written)| word == written)
        };
        let phrases = self.phrases.get(first.as_str()).into_iter().flatten().filter(is_there);
        let patterns = self.patterns.iter().filter_map(|phrase| {
            let start = place(phrase.words.first()?, first)?;
            Some((phrase, first.get(..start)?.chars().count()))
        });
        let all = phrases.map(|phrase| (phrase, 0)).chain(patterns);
        let (phrase, letters_before) = all.max_by_key(|(phrase, _)| phrase.length)?;
        Some(FoundPhrase { kind: phrase.kind, word_count: phrase.words.len(), letters_before })
    }
}

/// Returns the offset in bytes at which a word with wildcards starts in a written word, or `None` if they differ.
fn place(pattern: &str, written: &str) -> Option<usize> {
    let mut start = None;
    let mut at = 0;
    for (number, part) in pattern.split(ANY).enumerate().filter(|(_, part)| !part.is_empty()) {
        let found = at + written.get(at..)?.find(part)?;
        if number == 0 && found != 0 {
            return None;
        }
        start = start.or(Some(found));
        at = found + part.len();
    }
    (pattern.ends_with(ANY) || at == written.len()).then_some(start?)
}

/// Returns the lists of a table.
fn all(table: &'static str) -> HashMap<&'static str, Lists> {
    let mut all: HashMap<&'static str, Lists> = HashMap::new();
    for line in table.lines().filter(|line| !line.starts_with('#')) {
        let Some((head, words)) = line.split_once(": ") else { continue };
        let Some((code, gesture)) = head.split_once(' ') else { continue };
        let Some(kind) = GestureKind::of_list(gesture) else { continue };
        let lists = all.entry(code).or_default();
        for phrase in words.split(", ") {
            let length = phrase.chars().filter(|c| *c != ANY).count();
            let words: Vec<&str> = phrase.split(' ').collect();
            let list = match words.first().copied() {
                Some(first) if !phrase.contains(ANY) => lists.phrases.entry(first).or_default(),
                _ => &mut lists.patterns,
            };
            list.push(Phrase { kind, words, length });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn found(tag: &str, text: &str) -> Option<(GestureKind, usize, usize)> {
        let words: Vec<String> = text.split(' ').map(str::to_lowercase).collect();
        let found = Lists::of(tag)?.longest(&words)?;
        Some((found.kind, found.word_count, found.letters_before))
    }

    #[test]
    fn words_phrases_and_patterns() {
        assert_eq!(found("en-us", "Yes sir"), Some((GestureKind::Nod, 1, 0)));
        assert_eq!(found("en-us", "not sure at all"), Some((GestureKind::Shake, 2, 0)));
        assert_eq!(found("en-us", "of corse"), None);
        assert_eq!(found("en-us", "nobody"), None);
        assert_eq!(found("de-at", "auf keinen Fall"), Some((GestureKind::Shake, 3, 0)));
        assert_eq!(found("nb-no", "Ja"), Some((GestureKind::Nod, 1, 0)));
        assert_eq!(found("ja-jp", "はいはい"), Some((GestureKind::Nod, 1, 0)));
        assert_eq!(found("ja-jp", "絶対に行かない"), Some((GestureKind::Shake, 1, 0)));
        assert_eq!(found("zh-cn", "我不同意"), Some((GestureKind::Shake, 1, 1)), "the longest phrase in it");
        assert_eq!(found("tlh-tlh", "yes"), None);
    }

    /// Each line is valid and unique, and its words have the form in which texts are compared.
    #[test]
    fn the_table_is_sound() {
        let table = include_str!("../../../data/gestures.txt");
        let mut seen = BTreeSet::new();
        for line in table.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let (head, words) = line.split_once(": ").expect("a list");
            let (code, gesture) = head.split_once(' ').expect("a language and a gesture");
            assert!(GestureKind::of_list(gesture).is_some() && (2..=3).contains(&code.len()), "{line}");
            for phrase in words.split(", ") {
                assert!(seen.insert((code, phrase)), "{code}: {phrase} twice");
                assert_eq!(phrase.trim(), phrase, "{line}");
                assert!(phrase == phrase.to_lowercase() && !phrase.contains(['’', ',', '.', '/']), "{line}");
                assert!(!(phrase.contains(ANY) && phrase.contains(' ')), "{line}");
                let words: Vec<String> = phrase.split(' ').map(|word| word.replace(ANY, "")).collect();
                assert!(Lists::of(code).and_then(|lists| lists.longest(&words)).is_some(), "{code}: {phrase}");
            }
        }
    }
}
