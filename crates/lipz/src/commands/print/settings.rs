//! `lipz print settings`: prints every setting of lipz.toml with its explanation.

use crate::Outcome;
use crate::commands::Run;
use crate::reporter::{CommandResult, Reporter};
use clap::Args;
use lipz_compiler::settings::template;

/// Print a lipz.toml with every setting, explained and commented out.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz print settings > lipz.toml")]
pub(crate) struct PrintSettings {}

impl Run for PrintSettings {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        reporter.print(&template(&[])).map(|()| Outcome::Clean)
    }
}
