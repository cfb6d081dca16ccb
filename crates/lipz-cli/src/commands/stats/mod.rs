//! `lipz stats`: how much of what is in a bank.

mod json;
mod text;

use super::either::bank_or_files;
use crate::render::Findings;
use crate::sources::ProjectArguments;
use crate::{Outcome, console};
use clap::Args;
use std::path::PathBuf;

/// Show how much is in a bank: clips, time, text, bytes, mouth shapes.
///
/// A folder is compiled in memory, with the same flags as for `lipz pack`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz stats dialogue.lipzbank
  lipz stats voices --json")]
pub(crate) struct Stats {
    /// A bank, or a folder, file or pattern of Lipz files; `-` is a bank on standard input
    #[arg(value_name = "BANK")]
    pub(crate) bank: PathBuf,

    #[command(flatten)]
    pub(crate) project: ProjectArguments,

    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

pub(crate) fn run(arguments: &Stats, findings: &mut Findings) -> Outcome {
    let shown = bank_or_files(&arguments.bank, &arguments.project, findings).and_then(|file| {
        let bank = file.bank(findings)?;
        let stats = lipz_compiler::stats::Stats::of(&bank);
        Ok(if arguments.json {
            console::print_json(&json::StatsJson::of(&stats))
        } else {
            console::print(&text::text(&file.name, &stats))
        })
    });
    shown.unwrap_or_else(|outcome| outcome)
}
