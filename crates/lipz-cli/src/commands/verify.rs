//! `lipz verify`: the full check of banks.

use crate::args::Verify;
use crate::bank_file::BankFile;
use crate::{Outcome, console};

pub(crate) fn run(arguments: &Verify) -> Outcome {
    let mut worst = Outcome::Clean;
    for path in &arguments.banks {
        let outcome = match BankFile::map(path) {
            Ok(file) => verify(&file, arguments.quiet),
            Err(outcome) => outcome,
        };
        worst = match (worst, outcome) {
            (Outcome::Failed, _) | (_, Outcome::Failed) => Outcome::Failed,
            (Outcome::Findings, _) | (_, Outcome::Findings) => Outcome::Findings,
            _ => Outcome::Clean,
        };
    }
    worst
}

fn verify(file: &BankFile, quiet: bool) -> Outcome {
    match file.verified() {
        Ok(_) if quiet => Outcome::Clean,
        Ok(bank) => {
            let clips = console::counted(bank.clip_count(), "clip");
            let bytes = console::grouped(bank.length_bytes());
            console::print(&format!("{}: no fault ({clips}, {bytes} bytes)\n", file.path()))
        }
        Err(outcome) => outcome,
    }
}
