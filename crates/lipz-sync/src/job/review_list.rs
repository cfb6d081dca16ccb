//! The words of a clip that a person should check.

use crate::job::SyncResults;
use crate::record::{DoubtfulWord, RecordLine};
use lipz_compiler::WordTime;
use lipz_speech::Script;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The words of a clip that a person should check.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReviewList {
    /// The unclear words, with their starts in microseconds.
    pub(crate) doubtful: Vec<(u64, String)>,
    /// The words with guessed pronunciations, with their lines of a lexicon.
    pub(crate) guessed: Vec<(String, String)>,
}

/// The words of many clips that a person should check.
#[derive(Default)]
pub(crate) struct ReviewLists {
    doubtful: Vec<DoubtfulWord>,
    doubtful_before: Vec<DoubtfulWord>,
    guessed: BTreeMap<String, String>,
    guessed_before: BTreeMap<String, String>,
}

impl ReviewLists {
    /// Adds the words of a clip with new visemes.
    pub(crate) fn made(&mut self, key: &str, listed: ReviewList) {
        self.doubtful.extend(doubtful(key, listed.doubtful));
        self.guessed.extend(listed.guessed);
    }

    /// Adds the words of a clip whose visemes are up to date.
    pub(crate) fn unchanged(&mut self, key: &str, listed: ReviewList) {
        self.doubtful_before.extend(doubtful(key, listed.doubtful));
        self.guessed_before.extend(listed.guessed);
    }

    /// Moves all words to the results.
    pub(super) fn tell(mut self, synced: &mut SyncResults) {
        self.guessed_before.retain(|word, _| !self.guessed.contains_key(word));
        synced.doubtful = self.doubtful;
        synced.doubtful_before = self.doubtful_before;
        synced.guessed = self.guessed.into_values().collect();
        synced.guessed_before = self.guessed_before.into_values().collect();
    }
}

fn doubtful(key: &str, words: Vec<(u64, String)>) -> impl Iterator<Item = DoubtfulWord> {
    words.into_iter().map(move |(start_us, word)| DoubtfulWord { key: key.to_owned(), start_us, word })
}

impl ReviewList {
    pub(super) fn new(script: &Script, doubtful: Vec<(u64, String)>) -> ReviewList {
        let guessed = script.guessed().map(|word| (word.text.to_lowercase(), word.to_string())).collect();
        ReviewList { doubtful, guessed }
    }

    /// Returns the information of a line in the record about the words of `text`.
    pub(super) fn remembered(line: &RecordLine, script: &Script, text: &str) -> ReviewList {
        let words = line.words.as_ref().map(|words| words.of_text(text)).unwrap_or_default();
        let doubtful = words.into_iter().filter(|word| word.is_doubtful);
        let word = |word: WordTime| Some((u64::from(word.start_ms) * 1000, text.get(word.range)?.to_owned()));
        ReviewList::new(script, doubtful.filter_map(word).collect())
    }
}
