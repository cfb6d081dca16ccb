//! `lipz verify`: the full check of banks.

use crate::bank_file::with_bank;
use crate::render::Findings;
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::Bank;
use std::path::PathBuf;

/// Check every byte and every reference of banks.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz verify dialogue.lipzbank")]
pub(crate) struct Verify {
    /// The banks to check; `-` reads one from standard input
    #[arg(value_name = "BANK", required = true)]
    pub(crate) banks: Vec<PathBuf>,

    /// Print nothing about banks without fault
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

pub(crate) fn run(arguments: &Verify, findings: &mut Findings) -> Outcome {
    let mut worst = Outcome::Clean;
    for path in &arguments.banks {
        let outcome = with_bank(path, findings, |path, bank, findings| {
            if arguments.quiet { Outcome::Clean } else { findings.summary(&no_fault(path, bank)) }
        });
        worst = match (worst, outcome) {
            (Outcome::Failed, _) | (_, Outcome::Failed) => Outcome::Failed,
            (Outcome::Findings, _) | (_, Outcome::Findings) => Outcome::Findings,
            _ => Outcome::Clean,
        };
    }
    worst
}

fn no_fault(path: &str, bank: &Bank<'_>) -> String {
    let clips = console::counted(bank.clip_count(), "clip");
    let bytes = console::grouped(bank.length_bytes());
    format!("{path}: no fault ({clips}, {bytes} bytes)\n")
}
