//! `lipz print man`: writes manual pages.

use crate::CommandResult;
use crate::args::Arguments;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::output_file;
use crate::shared::run_flags::QuietFlag;
use crate::{Outcome, console};
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io;
use std::path::PathBuf;

/// Write manual pages, one for lipz and one for each command.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz print man -o ~/.local/share/man/man1")]
pub(crate) struct ManPages {
    /// Folder to write into; created if needed
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for ManPages {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let pages = pages().map_err(|error| {
            let message = format!("the manual pages cannot be created: {error}");
            reporter.fail(Report::about("", Diagnostic::new(Code::OutputFailed, message)))
        })?;
        for (name, page) in &pages {
            output_file::write(&self.output.join(name), page, reporter)?;
        }
        if self.quiet.is_set() {
            return Ok(Outcome::Clean);
        }
        let count = console::counted(pages.len(), "page");
        reporter.summary(&format!("{count} written into {}\n", console::path(&self.output)))?;
        Ok(Outcome::Clean)
    }
}

/// Returns the pages with their file names.
fn pages() -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut lipz = Arguments::command().disable_help_subcommand(true);
    // Sets the full names of the commands and the common options.
    lipz.build();
    with_subcommands(&lipz).into_iter().map(page).collect()
}

/// Returns the command and all commands below it.
fn with_subcommands(command: &Command) -> Vec<Command> {
    std::iter::once(command.clone()).chain(command.get_subcommands().flat_map(with_subcommands)).collect()
}

fn page(command: Command) -> io::Result<(String, Vec<u8>)> {
    let man = Man::new(command);
    let mut page = Vec::new();
    man.render(&mut page)?;
    Ok((man.get_filename(), page))
}
