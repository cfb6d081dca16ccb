//! `lipz unpack`: restores source files from a bank.

use crate::CommandResult;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::run_flags::QuietFlag;
use crate::{Outcome, console, interrupt};
use clap::Args;
use lipz_compiler::unpack;
use lipz_diagnostics::Code;
use std::path::PathBuf;

/// Write the clips of a bank or a set as Lipz files.
///
/// lipz writes only inside the folder. It does not write any file if a key cannot be a file name. If you interrupt the run,
/// the files written so far remain, and are complete.
#[derive(Args, Debug)]
#[command(override_usage = "lipz unpack <BANK> --output <FOLDER> [OPTIONS]")]
#[command(after_help = "Examples:
  lipz unpack dialogue.lipzbank -o voices
  lipz unpack dialogue.lipzset -o voices
  lipz unpack 'dialogue.lipzbank+dialogue.*.lipztexts' -o voices")]
pub(crate) struct Unpack {
    /// Bank or set, also with patches and text banks (BANK+PATCH+TEXTS); `-` is a bank on standard input
    #[arg(value_name = "BANK")]
    pub(crate) bank: PathBuf,

    /// Folder to write into; created if needed
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,

    /// Replace existing files, and report the elements that the bank does not contain
    #[arg(long)]
    pub(crate) overwrite: bool,

    #[command(flatten)]
    pub(crate) quiet: QuietFlag,
}

impl Run for Unpack {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let named = DialogueFiles::open(&self.bank, reporter)?;
        let opened = named.verified(reporter)?;
        let dialogue = named.dialogue(&opened, reporter)?;
        let bar = console::progress_bar(dialogue.clip_count(), self.quiet.is_set());
        let files = Files::new();
        let unpacked = interrupt::whole_files(|point| {
            let progress = |count| {
                bar.inc(count);
                point();
            };
            unpack(&dialogue, &self.output, self.overwrite, files.waiting(), &progress)
        });
        bar.finish_and_clear();
        match unpacked {
            Ok(unpacked) => {
                reporter.add(unpacked.lost);
                if self.quiet.is_set() {
                    return Ok(Outcome::Clean);
                }
                let form = match unpacked.is_exact {
                    true => "",
                    false if dialogue.locales().next().is_none() => {
                        " (without texts; add the text banks of a split bank: BANK+TEXTS)"
                    }
                    false => " (display texts, because the bank does not contain source records)",
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
