//! Words of a clip that somebody should look at.

use super::Line;
use lipz_compiler::WordTime;
use lipz_speech::Script;

/// Words of a clip that somebody should look at.
#[derive(Default)]
pub(super) struct Listed {
    /// Those that are not clearly heard: their starts in microseconds.
    pub(super) doubtful: Vec<(u64, String)>,
    /// Those whose pronunciation is a guess, and lines of a lexicon with it.
    pub(super) guessed: Vec<(String, String)>,
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
