//! `lipz verify`: the full check of banks.

use crate::bank_file::BankFile;
use crate::reporter::Reporter;
use crate::sources::usage_error;
use crate::text_banks::TextBanks;
use crate::{Ended, Outcome, console, patterns};
use clap::Args;
use clap::error::ErrorKind;
use lipz_bank::Bank;
use lipz_diagnostics::escape;
use std::path::{Path, PathBuf};

/// Check every byte and every reference of banks.
///
/// Text banks are checked against the bank that they belong to.
#[derive(Args, Debug)]
#[command(override_usage = "lipz verify <BANK>... [OPTIONS]")]
#[command(after_help = "Examples:
  lipz verify dialogue.lipzbank
  lipz verify dialogue.lipzbank --texts dialogue.*.lipztexts")]
pub(crate) struct Verify {
    /// The banks to check; `-` reads one from standard input
    #[arg(value_name = "BANK", required = true)]
    pub(crate) banks: Vec<PathBuf>,

    #[command(flatten)]
    texts: TextBanks,

    /// Print nothing about banks without fault
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

pub(crate) fn run(arguments: &Verify, reporter: &mut Reporter) -> Ended {
    let banks = patterns::files(&arguments.banks);
    if !arguments.texts.texts.is_empty() && banks.len() > 1 {
        let tip = "name the one bank that they belong to";
        return Err(usage_error(ErrorKind::ArgumentConflict, "text banks belong to one bank", tip));
    }
    // One that is damaged keeps none of the others from being checked.
    let outcomes = banks.iter().map(|path| verify(path, arguments, reporter));
    Ok(worst(outcomes))
}

fn verify(path: &Path, arguments: &Verify, reporter: &mut Reporter) -> Ended {
    let file = BankFile::open(path, reporter)?;
    let bank = file.bank(reporter)?;
    let clips = console::counted(bank.clip_count(), "clip");
    let told = tell(&file.name, &clips, bank.length_bytes(), arguments, reporter);
    let texts = patterns::files(&arguments.texts.texts);
    let texts = texts.iter().map(|path| verify_texts(path, &bank, arguments, reporter));
    Ok(worst(std::iter::once(Ok(told)).chain(texts)))
}

fn verify_texts(path: &Path, bank: &Bank<'_>, arguments: &Verify, reporter: &mut Reporter) -> Ended {
    let file = BankFile::open(path, reporter)?;
    let texts = file.texts(bank, reporter)?;
    let tags: Vec<_> = texts.locales().map(|locale| escape::text(locale.tag())).collect();
    Ok(tell(&file.name, &format!("texts in {}", tags.join(", ")), texts.length_bytes(), arguments, reporter))
}

/// Says that a file has no fault.
fn tell(name: &str, what: &str, length_bytes: usize, arguments: &Verify, reporter: &Reporter) -> Outcome {
    if arguments.quiet {
        return Outcome::Clean;
    }
    reporter.summary(&format!("{name}: no fault ({what}, {} bytes)\n", console::grouped(length_bytes)))
}

fn worst(outcomes: impl Iterator<Item = Ended>) -> Outcome {
    outcomes.map(|ended| ended.unwrap_or_else(|outcome| outcome)).max().unwrap_or(Outcome::Clean)
}
