//! What a run of `lipz sync` did and what somebody should look at, for programs: JSON, and a CSV table.

use lipz_sync::{DoubtfulWord, Kept, Synced};
use lipz_texts::defused;
use serde::Serialize;
use std::collections::BTreeSet;

/// What a JSON document has as `sync`.
#[derive(Serialize)]
pub(super) struct Table<'s> {
    /// Keys of the clips that got a mouth.
    synced: &'s [String],
    unchanged: usize,
    kept: Vec<KeptMouth<'s>>,
    refused: usize,
    without_recording: usize,
    /// Keys of clips whose recording may not say their new text.
    older_than_text: &'s [String],
    /// Locales whose languages have no rules.
    read_by_letters: &'s BTreeSet<String>,
    /// Words that are not clearly heard, those of unchanged clips too.
    doubtful: Vec<Doubtful<'s>>,
    /// Words that are pronounced by rules, each once.
    by_rules: Vec<ByRules<'s>>,
}

#[derive(Serialize)]
struct KeptMouth<'s> {
    clip: &'s str,
    why: &'static str,
}

#[derive(Serialize)]
struct Doubtful<'s> {
    clip: &'s str,
    start_us: u64,
    word: &'s str,
}

#[derive(Serialize)]
struct ByRules<'s> {
    word: &'s str,
    pronunciation: &'s str,
}

impl<'s> Table<'s> {
    /// What a run did. `without` is how many clips have no recording.
    pub(super) fn new(synced: &'s Synced, without: usize) -> Table<'s> {
        let kept = synced.kept.iter().map(|(clip, kept)| KeptMouth { clip, why: why(*kept) });
        let doubtful = doubtful(synced).into_iter();
        let guessed = guessed(synced).into_iter().map(|line| line.split_once("  ").unwrap_or((line, "")));
        Table {
            synced: &synced.made,
            unchanged: synced.unchanged,
            kept: kept.collect(),
            refused: synced.refused,
            without_recording: without,
            older_than_text: &synced.with_new_text,
            read_by_letters: &synced.read_by_letters,
            doubtful: doubtful
                .map(|found| Doubtful { clip: &found.key, start_us: found.start_us, word: &found.word })
                .collect(),
            by_rules: guessed.map(|(word, pronunciation)| ByRules { word, pronunciation }).collect(),
        }
    }
}

/// Why a mouth was kept.
pub(super) fn why(kept: Kept) -> &'static str {
    match kept {
        Kept::Changed => "changed by hand",
        Kept::ByHand => "not made by `lipz sync`",
        Kept::Corrected => "made from a corrected TextGrid (--textgrids names their folder)",
    }
}

/// All that somebody should look at, of clips that did not change, too, as CSV: a row each. No cell is a formula.
pub(super) fn csv(synced: &Synced) -> String {
    let mut rows = vec!["what,clip,seconds,word".to_owned()];
    let mut add = |what: &str, clip: &str, seconds: &str, word: &str| {
        rows.push([what, clip, seconds, word].map(|cell| field(&defused(cell))).join(","));
    };
    synced.kept.iter().for_each(|(key, _)| add("kept", key, "", ""));
    synced.with_new_text.iter().for_each(|key| add("older than its text", key, "", ""));
    doubtful(synced).iter().for_each(|word| {
        add("doubtful", &word.key, &format!("{:.3}", word.start_us as f64 / 1e6), &word.word);
    });
    guessed(synced).iter().for_each(|line| add("by rules", "", "", line));
    rows.join("\n") + "\n"
}

/// The doubtful words, clip by clip.
fn doubtful(synced: &Synced) -> Vec<&DoubtfulWord> {
    let mut doubtful: Vec<_> = synced.doubtful.iter().chain(&synced.doubtful_before).collect();
    doubtful.sort_by_key(|word| (&word.key, word.start_us));
    doubtful
}

/// The words that are pronounced by rules, as lines of a lexicon.
fn guessed(synced: &Synced) -> Vec<&str> {
    let mut guessed: Vec<&str> = synced.guessed.iter().chain(&synced.guessed_before).map(String::as_str).collect();
    guessed.sort_unstable();
    guessed
}

/// A field of a table, in quotes if it needs them.
fn field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}
