//! Every tool that takes a bank, on banks that may be forged.

use lipz_bank::Bank;
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::stats::Stats;
use lipz_compiler::{Documents, SplitBank, coverage, diff};

/// Uses a bank in all ways; whether it passes verification.
pub fn is_used(bytes: &[u8], original: &Bank<'_>) -> bool {
    let Ok(bank) = Bank::open(bytes).and_then(Bank::verify) else { return false };
    if let Ok(documents) = Documents::from_bank(&bank) {
        for (_, document) in documents.iter().flatten() {
            lipz_file::write(&document);
        }
    }
    coverage(&bank);
    Stats::from_bank(&bank);
    diff::diff(original, &bank);
    for language in Language::ALL {
        let _ = generate(&bank, language, None);
    }
    let split = SplitBank::from_bytes(bytes).unwrap();
    let base = Bank::open(&split.base).unwrap().verify().unwrap();
    for (_, texts) in &split.texts {
        base.open_texts(texts).unwrap().verify(&base).unwrap();
    }
    true
}
