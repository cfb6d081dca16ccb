//! `lipz verify`: checks banks completely.

use crate::Abort;
use crate::CommandResult;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_file::BankFile;
use crate::shared::dialogue_files::{DialogueFiles, tags_of, texts};
use crate::shared::patterns;
use crate::shared::run_flags::QuietFlag;
use crate::shared::set_file::SetFile;
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, ErrorKind};
use lipz_diagnostics::escape;
use lipz_host::FileBytes;
use std::path::{Path, PathBuf};

/// Check every byte and every reference of banks.
///
/// Text banks are checked against the bank before them. Name a set by its index; all of its banks are checked.
#[derive(Args, Debug)]
#[command(override_usage = "lipz verify <BANK>... [OPTIONS]")]
#[command(after_help = "Examples:
  lipz verify dialogue.lipzbank
  lipz verify dialogue.lipzset
  lipz verify dialogue.lipzbank dialogue.*.lipztexts")]
pub(crate) struct Verify {
    /// Banks, each with its text banks after it, or sets; `-` is a bank on standard input
    #[arg(value_name = "BANK", required = true)]
    pub(crate) banks: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) quiet: QuietFlag,
}

impl Run for Verify {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let mut groups: Vec<(PathBuf, Vec<PathBuf>)> = Vec::new();
        for path in patterns::files(&self.banks) {
            match groups.last_mut().filter(|_| is_text_bank(&path)) {
                Some((_, texts)) => texts.push(path),
                None => groups.push((path, Vec::new())),
            }
        }
        // A damaged bank does not prevent the check of the others.
        let outcomes = groups.iter().map(|(bank, texts)| verify(bank, texts, self, reporter));
        Ok(worst(outcomes))
    }
}

/// Whether the file at `path` is a text bank.
fn is_text_bank(path: &Path) -> bool {
    FileBytes::read(path).is_ok_and(|bytes| Bank::open(&bytes).is_err_and(|error| error.kind() == ErrorKind::TextsOnly))
}

fn verify(path: &Path, texts: &[PathBuf], arguments: &Verify, reporter: &mut Reporter) -> CommandResult {
    if let Some(set) = SetFile::open(path, reporter)? {
        if !texts.is_empty() {
            return Err(reporter.usage(
                "text banks do not belong to a set, but to one of its banks",
                "name that bank instead of the set",
            ));
        }
        return verify_set(&set, arguments, reporter);
    }
    let named = DialogueFiles::open(path, reporter)?;
    let files = named.verified(reporter)?;
    let dialogue = named.dialogue(&files, reporter)?;
    let clips = console::counted(dialogue.clip_count(), "clip");
    let length_bytes = files.iter().map(DialogueFile::length_bytes).sum();
    print_verified(&named.name, &clips, length_bytes, arguments, reporter)?;
    let texts = texts.iter().map(|path| verify_texts(path, &files, arguments, reporter));
    Ok(worst(texts))
}

/// Verifies the banks of a set one at a time, and that each clip is in the bank that the index implies.
fn verify_set(set: &SetFile, arguments: &Verify, reporter: &mut Reporter) -> CommandResult {
    let index = set.index(reporter)?;
    let mut length_bytes = index.length_bytes();
    for number in 0..index.bank_count() {
        let file = set.bank(number, reporter)?;
        set.verify_bank(number, &file, reporter)?;
        length_bytes += file.bytes().len();
    }
    let clips = console::counted(usize::try_from(index.clip_count()).unwrap_or(usize::MAX), "clip");
    let banks = console::counted(index.bank_count(), "bank");
    print_verified(set.name(), &format!("{banks}, {clips}"), length_bytes, arguments, reporter)?;
    Ok(Outcome::Clean)
}

fn verify_texts(path: &Path, banks: &[DialogueFile<'_>], arguments: &Verify, reporter: &mut Reporter) -> CommandResult {
    let file = BankFile::read(path, reporter)?;
    texts(&file, banks, banks.len()).map_err(|report| reporter.refuse(vec![report]))?;
    let tags = tags_of(&file, banks);
    let tags: Vec<_> = tags.iter().map(|tag| escape::text(tag)).collect();
    print_verified(&file.name, &format!("texts in {}", tags.join(", ")), file.bytes().len(), arguments, reporter)?;
    Ok(Outcome::Clean)
}

/// Prints that a file is not damaged.
fn print_verified(
    name: &str,
    what: &str,
    length_bytes: usize,
    arguments: &Verify,
    reporter: &mut Reporter,
) -> Result<(), Abort> {
    if arguments.quiet.is_set() {
        return Ok(());
    }
    reporter.summary(&format!("{name}: no fault ({what}, {} bytes)\n", console::grouped(length_bytes)))
}

fn worst(outcomes: impl Iterator<Item = CommandResult>) -> Outcome {
    outcomes.map(|ended| ended.unwrap_or_else(Abort::outcome)).max().unwrap_or(Outcome::Clean)
}
