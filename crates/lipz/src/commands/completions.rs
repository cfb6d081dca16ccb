//! `lipz completions`: what shells need to complete the command line.

use crate::Ended;
use crate::Outcome;
use crate::args::Arguments;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print a script that completes the commands and options of lipz in a shell.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz completions bash > ~/.local/share/bash-completion/completions/lipz
  lipz completions zsh > ~/.zfunc/_lipz
  lipz completions fish > ~/.config/fish/completions/lipz.fish
  lipz completions powershell >> $PROFILE")]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub(crate) shell: Shell,
}

impl Run for Completions {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), "lipz", &mut script);
        reporter.print_bytes(&script).map(|()| Outcome::Clean)
    }
}
