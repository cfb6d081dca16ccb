//! `lipz merge`: merges a base and its layers into one bank, or three versions of a Lipz file.

mod versions;

use crate::CommandResult;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::run_flags::QuietFlag;
use crate::shared::set_file::SetFile;
use crate::shared::{output_file, patterns, stack, stdio};
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::{Bank, Dialogue};
use lipz_compiler::Stack;
use std::path::PathBuf;

/// Merge a bank and its patches, or three versions of a Lipz file.
///
/// The base may also be a set, and text banks may follow it. The result has the same bytes as a bank that was packed from
/// the patched sources at once. With --versions, the command merges the changes of two branches in a Lipz file: by element,
/// and texts and events by segment. `lipz init` prints the command that makes Git use it.
#[derive(Args, Debug)]
#[command(override_usage = "lipz merge <BANK> <PATCH|TEXTS>... --output <BANK> [OPTIONS]
       lipz merge --versions <BASE> <OURS> <THEIRS> --output <FILE> [--name <PATH>]")]
#[command(after_help = "Examples:
  lipz merge dialogue.lipzbank patch-1.1.lipzbank patch-1.2.lipzbank -o whole.lipzbank
  lipz merge dialogue.lipzbank dialogue.*.lipztexts -o whole.lipzbank
  lipz merge dialogue.lipzset patch-1.1.lipzbank -o whole.lipzbank
  git config merge.lipz.driver 'lipz merge --versions %O %A %B -o %A --name %P'

Exit codes: 0 merged, 1 conflicts or other errors, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct Merge {
    /// Base (a bank or a set), then its patches and text banks in the order of their stack
    #[arg(value_name = "BANK", required_unless_present = "versions", num_args = 1..)]
    banks: Vec<PathBuf>,

    /// Merge versions of a Lipz file: the common ancestor, our version, and that of the other branch
    #[arg(long, value_names = ["BASE", "OURS", "THEIRS"], num_args = 3, conflicts_with = "banks")]
    versions: Vec<PathBuf>,

    /// Path of the Lipz file in the project, for messages and settings [default: that of the output]
    #[arg(long, value_name = "PATH", requires = "versions")]
    name: Option<PathBuf>,

    /// Bank or Lipz file to write; `-` is standard output for a bank
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for Merge {
    fn prints_result(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if let Ok(versions) = versions::VersionPaths::try_from(self.versions.clone()) {
            return versions::run(&versions, &self.output, self.name.as_ref().unwrap_or(&self.output), reporter);
        }
        let banks: Vec<PathBuf> = patterns::files(&self.banks).iter().flat_map(|path| stack::paths(path)).collect();
        let is_set = matches!(banks.as_slice(), [path] if SetFile::open(path, reporter)?.is_some());
        if banks.len() < 2 && !is_set {
            return Err(reporter.usage("only one bank is named", "name the base, then its patches and text banks"));
        }
        let is_printed = stdio::is_meant(&self.output);
        if is_printed {
            stdio::refuse_terminal(reporter)?;
        }
        output_file::refuse_source(&self.output, reporter)?;
        let named = DialogueFiles::open_all(&banks, reporter)?;
        if !is_printed {
            named.refuse_output(("an input bank", "the output"), &self.output, reporter)?;
        }
        let files = named.verified(reporter)?;
        let dialogue = named.dialogue(&files, reporter)?;
        let whole = Stack::of(&named.name, &dialogue).map_err(|report| reporter.refuse(vec![report]))?.into_bank();
        if is_printed {
            reporter.print_bytes(&whole)?;
            return Ok(Outcome::Clean);
        }
        output_file::write(&self.output, &whole, reporter)?;
        if self.quiet.is_set() {
            return Ok(Outcome::Clean);
        }
        let clips = console::counted(Bank::open(&whole).map_or(0, |bank| bank.clip_count()), "clip");
        let (merged, bytes) = (console::counted(count_banks(&dialogue), "bank"), console::grouped(whole.len()));
        reporter
            .summary(&format!("{merged} merged into {} ({clips}, {bytes} bytes)\n", console::path(&self.output)))?;
        Ok(Outcome::Clean)
    }
}

/// Returns the number of banks, including those of a set.
fn count_banks(dialogue: &Dialogue<'_>) -> usize {
    (0..dialogue.file_count()).filter(|number| dialogue.bank(*number).is_some()).count()
}
