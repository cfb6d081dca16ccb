//! Words of a clip that somebody should look at.

use super::{DoubtfulWord, Line, Synced};
use lipz_compiler::WordTime;
use lipz_speech::Script;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Words of a clip that somebody should look at.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Listed {
    /// Those that are not clearly heard: their starts in microseconds.
    pub(crate) doubtful: Vec<(u64, String)>,
    /// Those whose pronunciation is a guess, and lines of a lexicon with it.
    pub(crate) guessed: Vec<(String, String)>,
}

/// Words of many clips that somebody should look at.
#[derive(Default)]
pub(crate) struct Listings {
    doubtful: Vec<DoubtfulWord>,
    doubtful_before: Vec<DoubtfulWord>,
    guessed: BTreeMap<String, String>,
    guessed_before: BTreeMap<String, String>,
}

impl Listings {
    /// Adds those of a clip that has got a mouth.
    pub(crate) fn made(&mut self, key: &str, listed: Listed) {
        self.doubtful.extend(doubtful(key, listed.doubtful));
        self.guessed.extend(listed.guessed);
    }

    /// Adds those of a clip whose mouth is what it would become.
    pub(crate) fn unchanged(&mut self, key: &str, listed: Listed) {
        self.doubtful_before.extend(doubtful(key, listed.doubtful));
        self.guessed_before.extend(listed.guessed);
    }

    /// Tells all of them.
    pub(super) fn tell(mut self, synced: &mut Synced) {
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

impl Listed {
    pub(super) fn new(script: &Script, doubtful: Vec<(u64, String)>) -> Listed {
        let guessed = script.guessed().map(|word| (word.text.to_lowercase(), word.to_string())).collect();
        Listed { doubtful, guessed }
    }

    /// What a line of the record knows of the words of `text`.
    pub(super) fn remembered(line: &Line, script: &Script, text: &str) -> Listed {
        let words = line.words.as_ref().map(|words| words.of_text(text)).unwrap_or_default();
        let doubtful = words.into_iter().filter(|word| word.is_doubtful);
        let word = |word: WordTime| Some((u64::from(word.start_ms) * 1000, text.get(word.range)?.to_owned()));
        Listed::new(script, doubtful.filter_map(word).collect())
    }
}
