//! `lipz merge`: one bank of a base and its layers.

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::set_file::SetFile;
use crate::shared::text_banks::TextBanks;
use crate::shared::{output_file, patterns, stack, stdio};
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::{Bank, Dialogue};
use lipz_compiler::Stack;
use std::io::{self, IsTerminal};
use std::path::PathBuf;

/// Make one bank of a base, the layers over it and its text banks, or of a set.
///
/// The bank is that of the changed sources, byte for byte, as if it had been packed in one go.
#[derive(Args, Debug)]
#[command(override_usage = "lipz merge <BASE> <LAYER>... --output <BANK> [OPTIONS]")]
#[command(after_help = "Examples:
  lipz merge dialogue.lipzbank patch-1.1.lipzbank patch-1.2.lipzbank -o whole.lipzbank
  lipz merge dialogue.lipzset patch-1.1.lipzbank -o whole.lipzbank")]
pub(crate) struct Merge {
    /// The base, a bank or a set, then its layers, each over those before it
    #[arg(value_name = "BANK", required = true, num_args = 1..)]
    banks: Vec<PathBuf>,

    /// The bank to write; `-` writes it to standard output
    #[arg(short, long, value_name = "BANK")]
    output: PathBuf,

    #[command(flatten)]
    texts: TextBanks,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

impl Run for Merge {
    fn prints_result(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let banks: Vec<PathBuf> = patterns::files(&self.banks).iter().flat_map(|path| stack::paths(path)).collect();
        let is_set = matches!(banks.as_slice(), [path] if SetFile::open(path, reporter)?.is_some());
        if banks.len() < 2 && !is_set && self.texts.texts.is_empty() {
            return Err(reporter.usage("one bank is merged with nothing", "name the base, then its layers"));
        }
        let is_printed = stdio::is_meant(&self.output);
        if is_printed && io::stdout().is_terminal() {
            return Err(reporter.usage("a bank is not for a terminal", "name a file, or send standard output to one"));
        }
        output_file::refuse_source(&self.output, reporter)?;
        let named = DialogueFiles::open_all(&banks, reporter)?.with_texts(&self.texts.texts, reporter)?;
        if !is_printed {
            named.refuse_output(("a bank to be merged", "the output"), &self.output, reporter)?;
        }
        let files = named.verified(reporter)?;
        let dialogue = named.dialogue(&files, reporter)?;
        let whole = Stack::of(&named.name, &dialogue).map_err(|report| reporter.refuse(vec![report]))?.into_bank();
        if is_printed {
            reporter.print_bytes(&whole)?;
            return Ok(Outcome::Clean);
        }
        output_file::write(&self.output, &whole, reporter)?;
        if self.quiet {
            return Ok(Outcome::Clean);
        }
        let clips = console::counted(Bank::open(&whole).map_or(0, |bank| bank.clip_count()), "clip");
        let (merged, bytes) = (console::counted(count_banks(&dialogue), "bank"), console::grouped(whole.len()));
        reporter
            .summary(&format!("{merged} merged into {} ({clips}, {bytes} bytes)\n", console::path(&self.output)))?;
        Ok(Outcome::Clean)
    }
}

/// The number of banks, those of a set among them.
fn count_banks(dialogue: &Dialogue<'_>) -> usize {
    (0..dialogue.file_count()).filter(|number| dialogue.bank(*number).is_some()).count()
}
