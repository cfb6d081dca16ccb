//! The command line: the list of commands. Each one's arguments and help stand beside its work.

use crate::commands::{check, completions, diff, inspect, man, pack, schema, stats, unpack, verify};
use clap::{Parser, Subcommand};
use colorchoice_clap::Color;
use std::ffi::OsString;

/// Spoken dialogue for games: packs Lipz files into banks.
///
/// A Lipz file holds one voice clip: a mouth shape per frame, subtitles per locale, events per
/// segment. A bank holds many clips in one file that games use in place.
#[derive(Parser, Debug)]
#[command(name = "lipz", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 nothing at error level, 1 findings at error level, 2 the tool could not run, \
                  130 interrupted.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) color: Color,

    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Arguments {
    /// The arguments in `words`, the first of which is the program's name.
    pub(crate) fn read(words: impl IntoIterator<Item = OsString>) -> Result<Arguments, clap::Error> {
        let arguments = Arguments::try_parse_from(words)?;
        match &arguments.command {
            Command::Pack(pack) => pack.sources.project.validate()?,
            Command::Check(check) => check.sources.project.validate()?,
            Command::Diff(diff) => diff.project.validate()?,
            Command::Stats(stats) => stats.project.validate()?,
            Command::Unpack(_)
            | Command::Verify(_)
            | Command::Inspect(_)
            | Command::Schema(_)
            | Command::Completions(_)
            | Command::Man(_) => {}
        }
        Ok(arguments)
    }
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Pack(pack::Pack),
    Check(check::Check),
    Unpack(unpack::Unpack),
    Verify(verify::Verify),
    Inspect(inspect::Inspect),
    Diff(diff::Diff),
    Stats(stats::Stats),
    Schema(schema::Schema),
    Completions(completions::Completions),
    Man(man::ManPages),
}
