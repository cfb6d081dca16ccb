//! `lipz init`: a settings file that explains itself.

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::output_file;
use crate::{Outcome, console};
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
    /// The folder of the project; it is created if needed
    #[arg(value_name = "FOLDER", default_value = ".")]
    folder: PathBuf,

    /// Replace a file that exists
    #[arg(long)]
    force: bool,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

impl Run for Init {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let is_here = self.folder.as_os_str() == ".";
        let file = if is_here { PathBuf::from(FILE_NAME) } else { self.folder.join(FILE_NAME) };
        let shown = console::path(&file);
        if !self.force && file.symlink_metadata().is_ok() {
            let diagnostic = Diagnostic::new(Code::WouldOverwrite, format!("`{shown}` exists already"));
            let diagnostic =
                diagnostic.note("nothing was written").help("edit it, or replace it by a fresh one with --force");
            return Err(reporter.refuse(vec![Report::about(shown, diagnostic)]));
        }
        output_file::write(&file, template().as_bytes(), reporter)?;
        if self.quiet {
            return Ok(Outcome::Clean);
        }
        let next = "`lipz check` in its folder checks all Lipz files there and below";
        reporter.summary(&format!("{shown} written: {next}\n"))?;
        Ok(Outcome::Clean)
    }
}
