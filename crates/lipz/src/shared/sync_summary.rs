//! The result of `lipz sync` for people.

use super::sync_table::why;
use crate::console;
use crate::console::counted;
use lipz_diagnostics::escape;
use lipz_sync::SyncResults;
use std::fmt::Write;
use std::path::Path;
use unicode_width::UnicodeWidthStr;

/// The most lines of one kind that are shown.
const SHOWN: usize = 50;

/// Returns the results, and the items to check. `without` is the number of clips without a recording.
pub(crate) fn summary(synced: &SyncResults, without: usize, place: &Path) -> String {
    let counts = [
        (synced.unchanged, "unchanged"),
        (synced.kept.len(), "kept"),
        (synced.refused, "refused"),
        (without, "without a recording"),
    ];
    let others = counts.into_iter().filter(|(count, _)| *count > 0);
    let others: String = others.map(|(count, what)| format!(", {} {what}", console::grouped(count))).collect();
    let mut out = format!("{} synced{others}, in {}\n", counted(synced.made.len(), "clip"), console::path(place));
    let kept: Vec<String> =
        (synced.kept.iter()).map(|(key, kept)| format!("{}  {}", escape::text(key), why(*kept))).collect();
    list(&mut out, "kept visemes (`lipz sync --discard-edits` replaces them)", &kept);
    let renamed: Vec<String> =
        synced.renamed.iter().map(|(old, new)| format!("{} -> {}", escape::text(old), escape::text(new))).collect();
    list(&mut out, "renamed files (the record follows them)", &renamed);
    let new_texts: Vec<String> = synced.with_new_text.iter().map(|key| escape::text(key).into_owned()).collect();
    list(&mut out, "recordings older than their texts (record these lines again, or `lipz approve` them)", &new_texts);
    let by_letters: Vec<String> =
        synced.read_by_letters.iter().map(|locale| escape::text(locale).into_owned()).collect();
    list(&mut out, "locales without letter-to-sound rules (their texts are read letter by letter)", &by_letters);
    let width = synced.doubtful.iter().map(|word| escape::text(&word.key).width()).max().unwrap_or(0);
    let doubtful: Vec<String> = (synced.doubtful.iter())
        .map(|word| {
            let key = escape::text(&word.key);
            let blanks = " ".repeat(width - key.width());
            format!("{key}{blanks}  {:>7.2} s  {}", word.start_us as f64 / 1e6, escape::text(&word.word))
        })
        .collect();
    list(&mut out, "uncertain words (listen and check)", &doubtful);
    let guessed: Vec<String> = synced.guessed.iter().map(|line| escape::text(line).into_owned()).collect();
    list(&mut out, "words pronounced by rules (correct them in the lexicon)", &guessed);
    out
}

/// Adds a heading with the lines below it.
fn list(out: &mut String, heading: &str, lines: &[String]) {
    if lines.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n{heading}");
    for line in lines.iter().take(SHOWN) {
        let _ = writeln!(out, "  {line}");
    }
    if let Some(hidden) = lines.len().checked_sub(SHOWN).filter(|hidden| *hidden > 0) {
        let _ = writeln!(out, "  … and {} more (`lipz sync --list FILE` writes all)", console::grouped(hidden));
    }
}
