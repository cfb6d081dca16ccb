//! `lipz unpack`: a bank to source files.

use crate::Ended;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::text_banks::TextBanks;
use crate::{Outcome, console, interrupt};
use clap::Args;
use lipz_compiler::unpack;
use lipz_diagnostics::Code;
use std::path::PathBuf;

/// Write the clips of a bank or a set as Lipz files.
///
/// Nothing is written outside the folder, and nothing at all if a key cannot be a file name. If the run
/// is interrupted, the files written so far remain, and all of them are complete.
#[derive(Args, Debug)]
#[command(override_usage = "lipz unpack <BANK> --output <FOLDER> [OPTIONS]")]
#[command(after_help = "Examples:
  lipz unpack dialogue.lipzbank -o voices
  lipz unpack dialogue.lipzset -o voices
  lipz unpack dialogue.lipzbank --texts dialogue.*.lipztexts -o voices")]
pub(crate) struct Unpack {
    /// The bank to read, or a set by its index; `-` reads a bank from standard input
    #[arg(value_name = "BANK")]
    pub(crate) bank: PathBuf,

    #[command(flatten)]
    texts: TextBanks,

    /// The folder to write into; it is created if needed
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,

    /// Replace files that exist; reports which of their texts and other elements the bank does not have
    #[arg(long)]
    pub(crate) force: bool,

    /// Show no progress and no summary
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

impl Run for Unpack {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let named = DialogueFiles::open(&self.bank, reporter)?.with_texts(&self.texts.texts, reporter)?;
        let opened = named.verified(reporter)?;
        let dialogue = named.dialogue(&opened, reporter)?;
        let bar = console::progress_bar(dialogue.clip_count(), self.quiet);
        let files = Files::new();
        let unpacked = interrupt::whole_files(|point| {
            let progress = |count| {
                bar.inc(count);
                point();
            };
            unpack(&dialogue, &self.output, self.force, files.waiting(), &progress)
        });
        bar.finish_and_clear();
        match unpacked {
            Ok(unpacked) => {
                reporter.add(unpacked.lost);
                if self.quiet {
                    return Ok(Outcome::Clean);
                }
                let form = match unpacked.is_exact {
                    true => "",
                    false if dialogue.locales().next().is_none() => {
                        " (no texts: those of a split bank are in its text banks, --texts)"
                    }
                    false => " (display forms: the bank has no source section)",
                };
                let files = console::counted(unpacked.files, "file");
                reporter.summary(&format!("{files} unpacked into {}{form}\n", console::path(&self.output)))?;
                Ok(Outcome::Clean)
            }
            Err(mut reports) => {
                for report in &mut reports {
                    if report.source.path.is_empty() {
                        named.name.clone_into(&mut report.source.path);
                    }
                }
                let failed =
                    reports.iter().flat_map(|report| &report.diagnostics).any(|found| found.code == Code::OutputFailed);
                Err(reporter.abort(reports, if failed { Outcome::Failed } else { Outcome::Errors }))
            }
        }
    }
}
