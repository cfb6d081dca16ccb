//! `lipz verify`: the full check of banks.

use crate::bank_file::{BankFile, with_bank};
use crate::render::Findings;
use crate::sources::usage_error;
use crate::{Outcome, console};
use clap::Args;
use clap::error::ErrorKind;
use lipz::diagnostic::show;
use lipz_bank::Bank;
use std::path::{Path, PathBuf};

/// Check every byte and every reference of banks.
///
/// Text banks are checked against the bank that they belong to.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz verify dialogue.lipzbank
  lipz verify dialogue.lipzbank --texts dialogue.*.lipztexts")]
pub(crate) struct Verify {
    /// The banks to check; `-` reads one from standard input
    #[arg(value_name = "BANK", required = true)]
    pub(crate) banks: Vec<PathBuf>,

    /// Text banks of the bank, to be checked with it
    #[arg(long, value_name = "FILE", num_args = 1..)]
    texts: Vec<PathBuf>,

    /// Print nothing about banks without fault
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

pub(crate) fn run(arguments: &Verify, findings: &mut Findings) -> Outcome {
    if !arguments.texts.is_empty() && arguments.banks.len() > 1 {
        let tip = "name the one bank that they belong to";
        return usage_error(ErrorKind::ArgumentConflict, "text banks belong to one bank", tip);
    }
    let mut worst = Outcome::Clean;
    for path in &arguments.banks {
        let outcome = with_bank(path, findings, |path, bank, findings| {
            let clips = console::counted(bank.clip_count(), "clip");
            match tell(path, &clips, bank.length_bytes(), arguments, findings) {
                Outcome::Clean => arguments
                    .texts
                    .iter()
                    .map(|path| verify_texts(path, bank, arguments, findings))
                    .fold(Outcome::Clean, worse),
                failed => failed,
            }
        });
        worst = worse(worst, outcome);
    }
    worst
}

fn verify_texts(path: &Path, bank: &Bank<'_>, arguments: &Verify, findings: &mut Findings) -> Outcome {
    let verified = BankFile::open(path, findings).and_then(|file| {
        let texts = file.texts(bank, findings)?;
        let tags: Vec<_> = texts.locales().map(|locale| show::text(locale.tag())).collect();
        Ok(tell(&file.name, &format!("texts in {}", tags.join(", ")), texts.length_bytes(), arguments, findings))
    });
    verified.unwrap_or_else(|outcome| outcome)
}

/// Says that a file has no fault.
fn tell(name: &str, what: &str, length_bytes: usize, arguments: &Verify, findings: &Findings) -> Outcome {
    if arguments.quiet {
        return Outcome::Clean;
    }
    findings.summary(&format!("{name}: no fault ({what}, {} bytes)\n", console::grouped(length_bytes)))
}

fn worse(one: Outcome, other: Outcome) -> Outcome {
    match (one, other) {
        (Outcome::Failed, _) | (_, Outcome::Failed) => Outcome::Failed,
        (Outcome::Findings, _) | (_, Outcome::Findings) => Outcome::Findings,
        _ => Outcome::Clean,
    }
}
