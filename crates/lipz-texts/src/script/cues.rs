//! The cue sheet: the work of each character.

use super::RecordingScript;
use std::collections::BTreeMap;

/// The lines of a character in a script.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct CharacterCues {
    /// The names of the characters who speak, separated by `, `; empty for lines without a name.
    pub character: String,
    /// The number of lines.
    pub lines: usize,
    /// The number of words to speak.
    pub words: usize,
    /// The number of sessions.
    pub sessions: usize,
    /// The total length of the originals whose length is known, in microseconds; `None` if that of none is.
    pub original_us: Option<u64>,
}

impl RecordingScript {
    /// Returns the totals of each character, ordered by name.
    pub fn cues(&self) -> Vec<CharacterCues> {
        let mut all: BTreeMap<String, CharacterCues> = BTreeMap::new();
        for line in &self.lines {
            let cues = all.entry(line.character.clone()).or_default();
            cues.character.clone_from(&line.character);
            cues.lines += 1;
            cues.words += line.word_count();
            cues.sessions = cues.sessions.max(line.session);
            cues.original_us = match (cues.original_us, line.original_us) {
                (Some(sum), Some(own)) => Some(sum + own),
                (sum, own) => sum.or(own),
            };
        }
        all.into_values().collect()
    }
}
