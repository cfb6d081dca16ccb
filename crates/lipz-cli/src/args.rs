//! The command line: the list of commands. Each one's arguments and help stand beside its work.

use crate::commands::{check, convert, fmt, inspect, pack, unpack, verify};
use clap::{Parser, Subcommand};
use std::ffi::OsString;

/// Spoken dialogue for games: packs Lipz files into banks.
///
/// A Lipz file holds one voice clip: a mouth shape per frame, subtitles per locale, events per
/// segment. A bank holds many clips in one file that games use in place.
#[derive(Parser, Debug)]
#[command(name = "lipz", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 nothing at error level, 1 findings at error level, 2 the tool could not run.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Arguments {
    /// The arguments in `words`, the first of which is the program's name.
    pub(crate) fn read(words: impl IntoIterator<Item = OsString>) -> Result<Arguments, clap::Error> {
        let arguments = Arguments::try_parse_from(words)?;
        match &arguments.command {
            Command::Pack(pack) => pack.sources.validate()?,
            Command::Check(check) => check.sources.validate()?,
            Command::Convert(convert) => convert.sources.validate()?,
            Command::Fmt(_) | Command::Unpack(_) | Command::Verify(_) | Command::Inspect(_) => {}
        }
        Ok(arguments)
    }
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Pack(pack::Pack),
    Check(check::Check),
    Fmt(fmt::Fmt),
    Convert(convert::Convert),
    Unpack(unpack::Unpack),
    Verify(verify::Verify),
    Inspect(inspect::Inspect),
}
