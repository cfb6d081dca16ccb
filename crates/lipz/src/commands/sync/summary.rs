//! What a run of `lipz sync` did, for people.

use crate::console;
use crate::console::counted;
use lipz_diagnostics::escape;
use lipz_sync::{Kept, Synced};
use std::fmt::Write;
use std::path::Path;
use unicode_width::UnicodeWidthStr;

/// Lines of one kind that are shown.
const SHOWN: usize = 50;

/// What was done, and what somebody should look at. `without` is how many clips have no recording.
pub(super) fn summary(synced: &Synced, without: usize, place: &Path) -> String {
    let counts = [
        (synced.unchanged, "unchanged"),
        (synced.kept.len(), "kept"),
        (synced.refused, "refused"),
        (without, "without a recording"),
    ];
    let others = counts.into_iter().filter(|(count, _)| *count > 0);
    let others: String = others.map(|(count, what)| format!(", {} {what}", console::grouped(count))).collect();
    let mut out = format!("{} synced{others}, in {}\n", counted(synced.made.len(), "clip"), console::path(place));
    let kept: Vec<String> = (synced.kept.iter())
        .map(|(key, kept)| match kept {
            Kept::Changed => format!("{}  changed by hand", escape::text(key)),
            Kept::ByHand => format!("{}  not made by `lipz sync`", escape::text(key)),
        })
        .collect();
    list(&mut out, "kept mouths (--force replaces them)", &kept);
    let new_texts: Vec<String> = synced.with_new_text.iter().map(|key| escape::text(key).into_owned()).collect();
    list(&mut out, "recordings older than their texts (record these lines again if the words are others)", &new_texts);
    let width = synced.doubtful.iter().map(|word| escape::text(&word.key).width()).max().unwrap_or(0);
    let doubtful: Vec<String> = (synced.doubtful.iter())
        .map(|word| {
            let key = escape::text(&word.key);
            let blanks = " ".repeat(width - key.width());
            format!("{key}{blanks}  {:>7.2} s  {}", word.start_us as f64 / 1e6, escape::text(&word.word))
        })
        .collect();
    list(&mut out, "doubtful words (listen there)", &doubtful);
    let guessed: Vec<String> = synced.guessed.iter().map(|line| escape::text(line).into_owned()).collect();
    list(&mut out, "words pronounced by rules (correct them in the lexicon)", &guessed);
    out
}

/// All that somebody should look at, of clips that did not change, too: rows of a string table.
pub(super) fn table(synced: &Synced) -> String {
    let mut rows = vec!["what,clip,seconds,word".to_owned()];
    let mut add = |what: &str, clip: &str, seconds: &str, word: &str| {
        rows.push([what, clip, seconds, word].map(field).join(","));
    };
    synced.kept.iter().for_each(|(key, _)| add("kept", key, "", ""));
    synced.with_new_text.iter().for_each(|key| add("older than its text", key, "", ""));
    let mut doubtful: Vec<_> = synced.doubtful.iter().chain(&synced.doubtful_before).collect();
    doubtful.sort_by_key(|word| (&word.key, word.start_us));
    doubtful.iter().for_each(|word| {
        add("doubtful", &word.key, &format!("{:.3}", word.start_us as f64 / 1e6), &word.word);
    });
    let mut guessed: Vec<_> = synced.guessed.iter().chain(&synced.guessed_before).collect();
    guessed.sort();
    guessed.iter().for_each(|line| add("by rules", "", "", line));
    rows.join("\n") + "\n"
}

/// A field of a table, in quotes if it needs them.
fn field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A heading, and the lines below it.
fn list(out: &mut String, heading: &str, lines: &[String]) {
    if lines.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n{heading}");
    for line in lines.iter().take(SHOWN) {
        let _ = writeln!(out, "  {line}");
    }
    if let Some(hidden) = lines.len().checked_sub(SHOWN).filter(|hidden| *hidden > 0) {
        let _ = writeln!(out, "  … and {} more: --list FILE has all", console::grouped(hidden));
    }
}
