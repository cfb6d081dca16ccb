//! The command line: the list of commands. Each one's arguments and help stand beside its work.

use crate::commands::{check, completions, diff, ids, init, inspect, man, pack, schema, stats, unpack, verify};
use clap::{Parser, Subcommand};
use colorchoice_clap::Color;

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

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Pack(pack::Pack),
    Check(check::Check),
    Init(init::Init),
    Unpack(unpack::Unpack),
    Verify(verify::Verify),
    Inspect(inspect::Inspect),
    Diff(diff::Diff),
    Stats(stats::Stats),
    Schema(schema::Schema),
    Completions(completions::Completions),
    Man(man::ManPages),
    Ids(ids::Ids),
}
