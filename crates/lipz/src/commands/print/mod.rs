//! `lipz print`: prints files that a project needs once.

mod babble;
mod completions;
mod man;
mod maps;
mod schema;
mod settings;

use clap::Args;

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

subcommands! {
    Print.kind: PrintKind {
        Settings(settings::PrintSettings),
        Maps(maps::Maps),
        Schema(schema::Schema),
        Babble(babble::BabbleArguments),
        Completions(completions::Completions),
        Man(man::ManPages),
    }
}
