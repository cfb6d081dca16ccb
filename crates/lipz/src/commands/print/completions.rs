//! `lipz print completions`: prints completion scripts for shells.

use crate::CommandResult;
use crate::Outcome;
use crate::args::Arguments;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print a script that completes commands and options in a shell.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz print completions bash > ~/.local/share/bash-completion/completions/lipz
  lipz print completions zsh > ~/.zfunc/_lipz
  lipz print completions fish > ~/.config/fish/completions/lipz.fish
  lipz print completions powershell >> $PROFILE")]
pub(crate) struct Completions {
    /// Shell
    #[arg(value_name = "SHELL")]
    pub(crate) shell: Shell,
}

impl Run for Completions {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), "lipz", &mut script);
        reporter.print_bytes(&script).map(|()| Outcome::Clean)
    }
}
