//! The stressed syllable of a word, as far as its spelling shows it.

use super::super::variants::MOST;
use super::RuleTable;

/// A language's rule for the stress.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) enum Stress {
    /// The stress does not affect the phones, or rules derive it from the neighbouring letters.
    #[default]
    None,
    /// Any vowel may be stressed, unless the word contains a letter that is always stressed.
    Anywhere {
        /// `ё`.
        always: Vec<char>,
    },
    /// The vowel with an accent is stressed. Without accents, it is the last but one after weak endings, otherwise the
    /// last.
    Accents { accents: Vec<char>, weak: Vec<String> },
}

impl Stress {
    /// Parses `anywhere ё`, or `accents áé… weak a as …`.
    pub(super) fn parse(text: &str) -> Option<Stress> {
        let mut fields = text.split_whitespace();
        match fields.next()? {
            "anywhere" => Some(Stress::Anywhere { always: fields.next().unwrap_or_default().chars().collect() }),
            "accents" => {
                let accents = fields.next()?.chars().collect();
                (fields.next()? == "weak")
                    .then(|| Stress::Accents { accents, weak: fields.map(str::to_owned).collect() })
            }
            _ => None,
        }
    }

    /// Returns the indices of the stressed vowel, the most likely first; `None` if all vowels are read as stressed.
    pub(super) fn places(&self, table: &RuleTable, letters: &[char]) -> Vec<Option<usize>> {
        let vowels = || (0..letters.len()).filter(|at| letters.get(*at).is_some_and(|c| table.vowels.contains(c)));
        match self {
            Stress::None => vec![None],
            Stress::Anywhere { always } => {
                if let Some(at) = letters.iter().position(|c| always.contains(c)) {
                    return vec![Some(at)];
                }
                let mut places: Vec<usize> = vowels().collect();
                // The middle of a word is more likely than its ends.
                let middle = places.len() / 2;
                if let Some(likeliest) = (middle < places.len()).then(|| places.remove(middle)) {
                    places.insert(0, likeliest);
                }
                places.truncate(MOST / 2);
                if places.is_empty() { vec![None] } else { places.into_iter().map(Some).collect() }
            }
            Stress::Accents { accents, weak } => {
                if let Some(at) = letters.iter().position(|c| accents.contains(c)) {
                    return vec![Some(at)];
                }
                let nuclei: Vec<usize> = vowels().filter(|at| !is_glide(table, letters, *at)).collect();
                let tail: String = letters.iter().rev().take(3).rev().collect();
                let is_weak = weak.iter().any(|ending| tail.ends_with(ending.as_str()));
                let from_end = if is_weak && nuclei.len() > 1 { 2 } else { 1 };
                vec![nuclei.len().checked_sub(from_end).and_then(|at| nuclei.get(at)).copied()]
            }
        }
    }
}

/// Whether a vowel does not form a syllable: `i` and `u` after another vowel, and `u` in `gua` and `qua`.
fn is_glide(table: &RuleTable, letters: &[char], at: usize) -> bool {
    let is_vowel = |at: usize| letters.get(at).is_some_and(|c| table.vowels.contains(c));
    let before = at.checked_sub(1).and_then(|before| letters.get(before));
    match letters.get(at) {
        Some('u') if matches!(before, Some('g' | 'q')) && is_vowel(at + 1) => true,
        Some('i' | 'u') => before.is_some_and(|before| table.vowels.contains(before) && !matches!(before, 'i' | 'u')),
        _ => false,
    }
}
