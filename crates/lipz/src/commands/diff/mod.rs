//! `lipz diff`: the changes that a program sees between two banks, or between the folders they are made from.

mod text;
mod words;

use crate::Abort;
use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::{bank_or_sources, names_lipz_files};
use crate::shared::sources::ProjectArguments;
use clap::Args;
use lipz_compiler::diff;
use std::path::PathBuf;

/// Compare two banks, sets or folders as programs see them.
///
/// Compares clips, frame rates, frames, segments, displayed texts, events, locales, babble and face profiles, and ignores
/// the layout of the files. Lipz files are packed in memory.
#[derive(Args, Debug)]
#[command(override_usage = "lipz diff <OLD> <NEW> [OPTIONS]")]
#[command(after_help = "Examples:
  lipz diff old.lipzbank new.lipzbank
  lipz diff dialogue.lipzbank voices
  lipz diff dialogue.lipzbank voices --output-format json
  lipz diff dialogue.lipzset dialogue.lipzset+patch.lipzbank
  lipz diff 'old/b.lipzbank+old/b.*.lipztexts' 'b.lipzbank+b.*.lipztexts'

Exit codes: 0 no differences, 1 differences, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct Diff {
    /// Old bank or set, also with patches and text banks, or Lipz files; `-` is a bank on standard input
    #[arg(value_name = "OLD")]
    old: PathBuf,

    /// New bank, set or Lipz files
    #[arg(value_name = "NEW")]
    new: PathBuf,

    #[command(flatten)]
    project: ProjectArguments,

    /// Show all differences; JSON always has all
    #[arg(long)]
    all: bool,
}

impl Run for Diff {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        // Without one of the sides, no comparison is possible, whatever the reason.
        compare(self, reporter).map_err(Abort::as_failure)
    }
}

fn compare(arguments: &Diff, reporter: &mut Reporter) -> CommandResult {
    if !names_lipz_files(&arguments.old) && !names_lipz_files(&arguments.new) {
        arguments.project.refuse_with_bank(&arguments.old, reporter)?;
    }
    let old = bank_or_sources(&arguments.old, &arguments.project, reporter)?;
    let new = bank_or_sources(&arguments.new, &arguments.project, reporter)?;
    let (old_files, new_files) = (old.verified(reporter)?, new.verified(reporter)?);
    let old_dialogue = old.bounded_dialogue(&old_files, reporter)?;
    let new_dialogue = new.bounded_dialogue(&new_files, reporter)?;
    let difference = diff::diff(&old_dialogue, &new_dialogue);
    if reporter.wants_json() {
        reporter.print_json(&difference)?;
    } else if !(arguments.project.quiet.is_set() && difference.is_empty()) {
        reporter.print(&text::text(&difference, (&old.name, &new.name), arguments.all))?;
    }
    Ok(if difference.is_empty() { Outcome::Clean } else { Outcome::Errors })
}
