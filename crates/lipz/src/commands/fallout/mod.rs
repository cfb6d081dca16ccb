//! `lipz fallout`: what belongs to the talking heads of Fallout 2, beside their LIP files.

mod heads;

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::{Args, Subcommand};

/// Check files of Fallout 2's talking heads.
///
/// `lipz import fallout` converts LIP files to Lipz files, `lipz export fallout` the other way.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz fallout heads data/art/heads")]
pub(crate) struct Fallout {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand, Debug)]
enum Task {
    Heads(heads::Heads),
}

impl Run for Fallout {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        match &self.task {
            Task::Heads(heads) => heads::run(heads, reporter),
        }
    }
}
