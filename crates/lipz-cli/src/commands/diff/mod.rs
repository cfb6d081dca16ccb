//! `lipz diff`: what changes for a program between two banks, or the folders that they are made of.

mod json;
mod text;
mod words;

use super::either::bank_or_files;
use crate::render::Findings;
use crate::sources::ProjectArguments;
use crate::{Ended, Outcome, console};
use clap::Args;
use json::DifferenceJson;
use lipz_compiler::diff;
use std::path::PathBuf;

/// Compare banks, or the folders that banks are made of.
///
/// Compared is what a program sees: clips, frame rates, frames, segments, display texts, events. How
/// the files are spelled makes no difference. Folders are compiled in memory, with the same flags as
/// for `lipz pack`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz diff old.lipzbank new.lipzbank
  lipz diff dialogue.lipzbank voices --default-locale en-us
  lipz diff dialogue.lipzbank voices --json

Exit codes: 0 no difference, 1 differences, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct Diff {
    /// The old side: a bank, or a folder, file or pattern of Lipz files; `-` is a bank on standard input
    #[arg(value_name = "OLD")]
    old: PathBuf,

    /// The new side
    #[arg(value_name = "NEW")]
    new: PathBuf,

    #[command(flatten)]
    project: ProjectArguments,

    /// Show all differences, however many they are
    #[arg(long)]
    all: bool,

    /// Print JSON, always with all differences
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Diff, findings: &mut Findings) -> Ended {
    // A side that is not to be had leaves nothing to compare, for whatever reason.
    compare(arguments, findings).map_err(|_| Outcome::Failed)
}

fn compare(arguments: &Diff, findings: &mut Findings) -> Ended {
    let old = bank_or_files(Some(&arguments.old), &arguments.project, findings)?;
    let new = bank_or_files(Some(&arguments.new), &arguments.project, findings)?;
    let (old_bank, new_bank) = (old.bank(findings)?, new.bank(findings)?);
    let difference = diff::diff(&old_bank, &new_bank);
    let printed = if arguments.json {
        console::print_json(&DifferenceJson::of(&difference))
    } else if arguments.project.quiet && difference.is_empty() {
        Outcome::Clean
    } else {
        console::print(&text::text(&difference, (&old.name, &new.name), arguments.all))
    };
    Ok(match printed {
        Outcome::Clean if !difference.is_empty() => Outcome::Findings,
        printed => printed,
    })
}
