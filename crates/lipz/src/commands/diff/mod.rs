//! `lipz diff`: what changes for a program between two banks, or the folders that they are made of.

mod text;
mod words;

use crate::Abort;
use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::bank_or_sources;
use crate::shared::sources::ProjectArguments;
use clap::Args;
use lipz_compiler::diff;
use std::path::PathBuf;

/// Compare banks or sets, or the folders that they are made of.
///
/// Compares what a program sees: clips, frame rates, frames, segments, display texts, events, locales,
/// babble and face profiles. The layout of the files makes no difference. Folders are compiled in memory, with the
/// flags of `lipz pack`.
#[derive(Args, Debug)]
#[command(override_usage = "lipz diff <OLD> <NEW> [OPTIONS]")]
#[command(after_help = "Examples:
  lipz diff old.lipzbank new.lipzbank
  lipz diff dialogue.lipzbank voices --default-locale en-us
  lipz diff dialogue.lipzbank voices --json
  lipz diff dialogue.lipzset dialogue.lipzset+patch.lipzbank
  lipz diff old/b.lipzbank b.lipzbank --old-texts old/b.*.lipztexts --new-texts b.*.lipztexts

Exit codes: 0 no difference, 1 differences, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct Diff {
    /// The old side: a bank or a set, or a folder, file or pattern of Lipz files; `-` is a bank on standard input
    #[arg(value_name = "OLD")]
    old: PathBuf,

    /// The new side
    #[arg(value_name = "NEW")]
    new: PathBuf,

    /// Text banks of the old bank
    #[arg(long, value_name = "FILE", num_args = 1..)]
    old_texts: Vec<PathBuf>,

    /// Text banks of the new bank
    #[arg(long, value_name = "FILE", num_args = 1..)]
    new_texts: Vec<PathBuf>,

    #[command(flatten)]
    project: ProjectArguments,

    /// Show all differences, however many
    #[arg(long)]
    all: bool,

    /// Print JSON, always with all differences
    #[arg(long)]
    json: bool,
}

impl Run for Diff {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        // Without one of the sides there is nothing to compare, whatever the reason.
        compare(self, reporter).map_err(Abort::as_failure)
    }
}

fn compare(arguments: &Diff, reporter: &mut Reporter) -> Ended {
    let old = bank_or_sources(Some(&arguments.old), &arguments.project, reporter)?;
    let new = bank_or_sources(Some(&arguments.new), &arguments.project, reporter)?;
    let old = old.with_texts(&arguments.old_texts, reporter)?;
    let new = new.with_texts(&arguments.new_texts, reporter)?;
    let (old_files, new_files) = (old.verified(reporter)?, new.verified(reporter)?);
    let (old_dialogue, new_dialogue) = (old.dialogue(&old_files, reporter)?, new.dialogue(&new_files, reporter)?);
    let difference = diff::diff(&old_dialogue, &new_dialogue);
    if reporter.wants_json(arguments.json) {
        reporter.print_json(&difference)?;
    } else if !(arguments.project.quiet && difference.is_empty()) {
        reporter.print(&text::text(&difference, (&old.name, &new.name), arguments.all))?;
    }
    Ok(if difference.is_empty() { Outcome::Clean } else { Outcome::Errors })
}
