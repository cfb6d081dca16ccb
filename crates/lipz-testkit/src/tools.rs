//! Runs every tool that takes a bank on banks that may be forged.

use crate::dialogues::with;
use crate::texts::with_texts;
use lipz_bank::Bank;
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::stats::Stats;
use lipz_compiler::{Documents, SplitBank, coverage, diff};

/// Uses a bank in all ways. Returns whether it passes verification.
pub fn is_used(bytes: &[u8], original: &[u8]) -> bool {
    if Bank::open(bytes).and_then(Bank::verify).is_err() {
        return false;
    }
    with(&[bytes], |dialogue| {
        if let Ok(documents) = Documents::from_dialogue(dialogue) {
            for (_, document) in documents.iter().flatten() {
                lipz_file::write(&document);
            }
        }
        coverage(dialogue);
        Stats::from_dialogue(dialogue);
        with(&[original], |original| drop(diff::diff(original, dialogue)));
        for language in Language::ALL {
            let _ = generate(dialogue, language, None);
        }
    });
    let split = SplitBank::from_bytes(bytes).unwrap();
    let base = Bank::open(&split.base).unwrap().verify().unwrap();
    for (_, texts) in &split.texts {
        with_texts(&base, texts).unwrap();
    }
    true
}
