//! `--stdin-filename`: the file whose text standard input carries.

use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::sources::PROJECT;
use crate::shared::stdio;
use clap::Args;
use std::path::PathBuf;

/// The option of commands that read standard input as a file of the project.
#[derive(Args, Debug)]
pub(crate) struct StdinFile {
    /// File name of standard input, for diagnostics and to find lipz.toml
    #[arg(long, value_name = "FILE", help_heading = PROJECT)]
    stdin_filename: Option<PathBuf>,
}

impl StdinFile {
    /// Sets the name of standard input, before the project is read. Refuses the option if standard input is not among
    /// the files that the command reads.
    pub(crate) fn apply(&self, files: &[PathBuf], reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(file) = &self.stdin_filename else { return Ok(()) };
        if !files.iter().any(|file| stdio::is_meant(file)) {
            let tip = "name `-` among the files, or leave out `--stdin-filename`";
            return Err(reporter.usage("`--stdin-filename` needs standard input, which is not read", tip));
        }
        stdio::is_text_of(file.clone());
        Ok(())
    }
}
