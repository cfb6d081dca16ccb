//! `lipz lsp`: runs a language server on standard input and output, for editors.

use crate::commands::Run;
use crate::commands::check::checked;
use crate::reporter::Reporter;
use crate::shared::settings_file::Project;
use crate::{CommandResult, Outcome};
use clap::Args;
use lipz_diagnostics::{Code, Report};
use lipz_lsp::{CheckedProject, serve};
use std::collections::HashMap;
use std::io::{self, BufReader, IsTerminal};

/// Run the language server for editors.
///
/// Editors start this command and use the Language Server Protocol. It offers diagnostics, fixes, completion, hover, formatting
/// and rename, and finds projects as `lipz check` does. docs/guides/editors.md sets up Visual Studio Code, Neovim and others.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz lsp")]
pub(crate) struct Lsp {
    /// Use standard input and output, which is the default
    #[arg(long, hide = true)]
    stdio: bool,
}

impl Run for Lsp {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if !self.stdio && io::stdin().is_terminal() {
            let tip = "set up an editor (docs/guides/editors.md), or run `lipz check`";
            return Err(reporter.usage("`lipz lsp` communicates with an editor, but standard input is a terminal", tip));
        }
        match serve(BufReader::new(io::stdin()), io::stdout().lock(), check) {
            // The protocol requires 0 after a `shutdown` request, otherwise 1.
            Ok(is_orderly) => Ok(if is_orderly { Outcome::Clean } else { Outcome::Errors }),
            Err(error) => {
                let message = format!("the connection to the editor failed: {error}");
                let help = "restart the language server in the editor";
                Err(reporter.fail(Report::failure("", Code::UnreadableFile, message, help)))
            }
        }
    }
}

/// Returns the reports of `lipz check` about a project.
fn check(project: &lipz_lsp::Project, unsaved: &HashMap<String, String>) -> CheckedProject {
    let mut settings = project.settings.clone();
    // The contents of recordings matter only for a bank.
    settings.audio.in_bank = false;
    let (run, _) = checked(&Project::found_by_editor(settings, project.file.clone()), unsaved, None, true);
    CheckedProject { inputs: run.inputs.into_owned(), reports: run.reports }
}
