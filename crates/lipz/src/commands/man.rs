//! `lipz man`: manual pages.

use crate::args::Arguments;
use crate::reporter::Reporter;
use crate::{Ended, Outcome, console, output_file};
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use std::io;
use std::path::PathBuf;

/// Write manual pages: one about lipz, and one about each command.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz man -o ~/.local/share/man/man1")]
pub(crate) struct ManPages {
    /// The folder to write into; it is made if it does not exist
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn run(arguments: &ManPages, reporter: &mut Reporter) -> Ended {
    let pages = pages().map_err(|error| {
        console::remark(&format!("error: {error}\n"));
        Outcome::Failed
    })?;
    for (name, page) in &pages {
        output_file::write(&arguments.output.join(name), page, reporter)?;
    }
    if arguments.quiet {
        return Ok(Outcome::Clean);
    }
    let count = console::counted(pages.len(), "page");
    Ok(reporter.summary(&format!("{count} written into {}\n", console::path(&arguments.output))))
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
