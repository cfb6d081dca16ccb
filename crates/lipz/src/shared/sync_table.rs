//! The result of `lipz sync` and the items to check, for programs: JSON, and a CSV table.

use lipz_sync::{DoubtfulWord, KeepReason, SyncResults};
use lipz_texts::defused;
use serde::Serialize;
use std::collections::BTreeSet;

/// The value of `sync` in a JSON document.
#[derive(Serialize)]
pub(crate) struct SyncDocument<'s> {
    /// Keys of the clips with new visemes.
    synced: &'s [String],
    unchanged: usize,
    kept: Vec<KeptMouth<'s>>,
    /// Old and new paths of renamed Lipz files.
    renamed: &'s [(String, String)],
    refused: usize,
    without_recording: usize,
    /// Keys of clips whose recording may not match their new text.
    older_than_text: &'s [String],
    /// Locales whose languages have no letter-to-sound rules.
    read_by_letters: &'s BTreeSet<String>,
    /// Words that are unclear in the recording, including those of unchanged clips.
    doubtful: Vec<DoubtfulWordRow<'s>>,
    /// Words whose pronunciation comes from rules, each once.
    by_rules: Vec<ByRules<'s>>,
}

#[derive(Serialize)]
struct KeptMouth<'s> {
    clip: &'s str,
    why: &'static str,
}

#[derive(Serialize)]
struct DoubtfulWordRow<'s> {
    clip: &'s str,
    start_us: u64,
    word: &'s str,
}

#[derive(Serialize)]
struct ByRules<'s> {
    word: &'s str,
    pronunciation: &'s str,
}

impl<'s> SyncDocument<'s> {
    /// Creates the result of a run. `without` is the number of clips without a recording.
    pub(crate) fn new(synced: &'s SyncResults, without: usize) -> SyncDocument<'s> {
        let kept = synced.kept.iter().map(|(clip, kept)| KeptMouth { clip, why: why(*kept) });
        let doubtful = doubtful(synced).into_iter();
        let guessed = guessed(synced).into_iter().map(|line| line.split_once("  ").unwrap_or((line, "")));
        SyncDocument {
            synced: &synced.made,
            unchanged: synced.unchanged,
            kept: kept.collect(),
            renamed: &synced.renamed,
            refused: synced.refused,
            without_recording: without,
            older_than_text: &synced.with_new_text,
            read_by_letters: &synced.read_by_letters,
            doubtful: doubtful
                .map(|found| DoubtfulWordRow { clip: &found.key, start_us: found.start_us, word: &found.word })
                .collect(),
            by_rules: guessed.map(|(word, pronunciation)| ByRules { word, pronunciation }).collect(),
        }
    }
}

/// Returns the reason for keeping existing visemes.
pub(super) fn why(kept: KeepReason) -> &'static str {
    match kept {
        KeepReason::Changed => "changed by hand",
        KeepReason::ByHand => "not made by `lipz sync`",
        KeepReason::Corrected => "made from a corrected TextGrid (in `textgrids` of [sync])",
    }
}

/// Returns all items to check as CSV, one per row, including those of unchanged clips. No cell is a formula.
pub(crate) fn csv(synced: &SyncResults) -> String {
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

/// Returns the doubtful words, clip by clip.
fn doubtful(synced: &SyncResults) -> Vec<&DoubtfulWord> {
    let mut doubtful: Vec<_> = synced.doubtful.iter().chain(&synced.doubtful_before).collect();
    doubtful.sort_by_key(|word| (&word.key, word.start_us));
    doubtful
}

/// Returns the words whose pronunciation comes from rules, as lines of a lexicon.
fn guessed(synced: &SyncResults) -> Vec<&str> {
    let mut guessed: Vec<&str> = synced.guessed.iter().chain(&synced.guessed_before).map(String::as_str).collect();
    guessed.sort_unstable();
    guessed
}

/// Returns a field of a table, in quotes if necessary.
fn field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}
