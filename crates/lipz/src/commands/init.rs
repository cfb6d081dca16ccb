//! `lipz init`: a settings file that explains itself.

use crate::reporter::Reporter;
use crate::{Ended, Outcome, console, output_file};
use clap::Args;
use lipz_compiler::settings::{FILE_NAME, template};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::PathBuf;

/// Write a lipz.toml with every setting, explained and commented out.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz init
  lipz init game/dialogue")]
pub(crate) struct Init {
    /// The folder of the project; it is made if it does not exist
    #[arg(value_name = "FOLDER", default_value = ".")]
    folder: PathBuf,

    /// Replace a file that exists
    #[arg(long)]
    force: bool,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn run(arguments: &Init, reporter: &mut Reporter) -> Ended {
    let is_here = arguments.folder.as_os_str() == ".";
    let file = if is_here { PathBuf::from(FILE_NAME) } else { arguments.folder.join(FILE_NAME) };
    let shown = console::path(&file);
    if !arguments.force && file.symlink_metadata().is_ok() {
        let finding = Diagnostic::new(Code::WouldOverwrite, format!("`{shown}` is there already"));
        let finding = finding.note("nothing was written").help("edit it, or replace it by a fresh one with --force");
        reporter.add(vec![Report::about(shown, finding)]);
        return Err(Outcome::Errors);
    }
    output_file::write(&file, template().as_bytes(), reporter)?;
    if arguments.quiet {
        return Ok(Outcome::Clean);
    }
    let next = "`lipz check` in its folder checks all Lipz files there and below";
    Ok(reporter.summary(&format!("{shown} written: {next}\n")))
}
