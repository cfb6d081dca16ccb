//! `lipz print`: prints files that a project needs once.

mod babble;
mod completions;
mod man;
mod maps;
mod schema;
mod settings;

use crate::commands::Run;
use crate::reporter::{CommandResult, Reporter};
use clap::{Args, Subcommand};

/// Print settings, mapping tables, the JSON Schema, completions or manual pages.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz print settings
  lipz print maps papagayo > our-rig.toml
  lipz print schema > lipz.schema.json
  lipz print completions zsh > ~/.zfunc/_lipz
  lipz print man -o ~/.local/share/man/man1")]
pub(crate) struct Print {
    #[command(subcommand)]
    kind: PrintKind,
}

#[derive(Subcommand, Debug)]
enum PrintKind {
    Settings(settings::PrintSettings),
    Maps(maps::Maps),
    Schema(schema::Schema),
    Babble(babble::BabbleArguments),
    Completions(completions::Completions),
    Man(man::ManPages),
}

impl Print {
    fn task(&self) -> &dyn Run {
        match &self.kind {
            PrintKind::Settings(settings) => settings,
            PrintKind::Maps(maps) => maps,
            PrintKind::Schema(schema) => schema,
            PrintKind::Babble(babble) => babble,
            PrintKind::Completions(completions) => completions,
            PrintKind::Man(man) => man,
        }
    }
}

impl Run for Print {
    fn prints_result(&self) -> bool {
        self.task().prints_result()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.task().run(reporter)
    }
}
