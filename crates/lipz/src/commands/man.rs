//! `lipz man`: manual pages.

use crate::Ended;
use crate::args::Arguments;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::output_file;
use crate::{Outcome, console};
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io;
use std::path::PathBuf;

/// Write manual pages: one about lipz, and one about each command.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz man -o ~/.local/share/man/man1")]
pub(crate) struct ManPages {
    /// The folder to write into; it is created if needed
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

impl Run for ManPages {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let pages = pages().map_err(|error| {
            let message = format!("the pages cannot be made: {error}");
            reporter.fail(Report::about("", Diagnostic::new(Code::OutputFailed, message)))
        })?;
        for (name, page) in &pages {
            output_file::write(&self.output.join(name), page, reporter)?;
        }
        if self.quiet {
            return Ok(Outcome::Clean);
        }
        let count = console::counted(pages.len(), "page");
        reporter.summary(&format!("{count} written into {}\n", console::path(&self.output)))?;
        Ok(Outcome::Clean)
    }
}

/// The pages with the names of their files.
fn pages() -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut lipz = Arguments::command();
    // Gives the commands their full names and the options that all have.
    lipz.build();
    let commands = lipz.get_subcommands().filter(|command| command.get_name() != "help").cloned();
    std::iter::once(lipz.clone()).chain(commands).map(page).collect()
}

fn page(command: Command) -> io::Result<(String, Vec<u8>)> {
    let man = Man::new(command);
    let mut page = Vec::new();
    man.render(&mut page)?;
    Ok((man.get_filename(), page))
}
