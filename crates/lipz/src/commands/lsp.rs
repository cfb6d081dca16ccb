//! `lipz lsp`: a language server on standard input and output, for editors.

use crate::commands::Run;
use crate::commands::check::checked;
use crate::reporter::Reporter;
use crate::shared::settings_file::Project;
use crate::{Ended, Outcome};
use clap::Args;
use lipz_diagnostics::{Code, Report};
use lipz_lsp::{Checked, serve};
use std::collections::HashMap;
use std::io::{self, BufReader, IsTerminal};

/// Serve an editor: diagnostics while you write, fixes, completion, hover, formatting, rename.
///
/// Editors start this command and talk with it by the Language Server Protocol. Projects and settings are found
/// beside and above the files that are open, as by `lipz check`. docs/guides/editors.md sets up Visual Studio Code, Neovim
/// and others.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz lsp
  lipz lsp --stdio")]
pub(crate) struct Lsp {
    /// Talk over standard input and output, as is done without it, too: some editors ask for it
    #[arg(long)]
    stdio: bool,
}

impl Run for Lsp {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        if !self.stdio && io::stdin().is_terminal() {
            let tip = "docs/guides/editors.md says how; `lipz check` is for people";
            return Err(reporter.usage("an editor starts `lipz lsp` and talks with it, and this is a terminal", tip));
        }
        match serve(BufReader::new(io::stdin()), io::stdout().lock(), check) {
            // The protocol: 0 if the editor has said goodbye, otherwise 1.
            Ok(is_orderly) => Ok(if is_orderly { Outcome::Clean } else { Outcome::Errors }),
            Err(error) => {
                let message = format!("the conversation with the editor broke off: {error}");
                let help = "start the server of the editor again";
                Err(reporter.fail(Report::failure("", Code::UnreadableFile, message, help)))
            }
        }
    }
}

/// What `lipz check` reports about a project.
fn check(project: &lipz_lsp::Project, unsaved: &HashMap<String, String>) -> Checked {
    let mut settings = project.settings.clone();
    // Only a bank has what is read of recordings for it.
    settings.audio.in_bank = false;
    let (run, _) = checked(&Project::found_by_editor(settings, project.file.clone()), unsaved, None, true);
    Checked { inputs: run.inputs.into_owned(), reports: run.reports }
}
