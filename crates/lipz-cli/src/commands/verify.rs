//! `lipz verify`: the full check of banks.

use crate::args::Verify;
use crate::bank_file::with_bank;
use crate::{Outcome, console};
use lipz_bank::Bank;

pub(crate) fn run(arguments: &Verify) -> Outcome {
    let mut worst = Outcome::Clean;
    for path in &arguments.banks {
        let outcome = with_bank(path, |path, bank| if arguments.quiet { Outcome::Clean } else { no_fault(path, bank) });
        worst = match (worst, outcome) {
            (Outcome::Failed, _) | (_, Outcome::Failed) => Outcome::Failed,
            (Outcome::Findings, _) | (_, Outcome::Findings) => Outcome::Findings,
            _ => Outcome::Clean,
        };
    }
    worst
}

fn no_fault(path: &str, bank: &Bank<'_>) -> Outcome {
    let clips = console::counted(bank.clip_count(), "clip");
    let bytes = console::grouped(bank.length_bytes());
    console::print(&format!("{path}: no fault ({clips}, {bytes} bytes)\n"))
}
