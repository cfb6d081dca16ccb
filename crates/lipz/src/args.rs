//! The command line: the list of commands. Each one's arguments and help stand beside its work.

use crate::commands::{
    babble, check, completions, convert, coverage, diff, explain, export, fallout, fmt, ids, import, init, inspect,
    man, maps, pack, schema, stats, subtitles, unpack, verify, watch,
};
use crate::reporter::Format;
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

    /// How findings are shown
    #[arg(long, global = true, value_enum, value_name = "FORMAT", default_value_t = Format::Human)]
    pub(crate) format: Format,

    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Pack(pack::Pack),
    Watch(watch::Watch),
    Check(check::Check),
    Init(init::Init),
    Fmt(fmt::Fmt),
    Convert(convert::Convert),
    Import(import::Import),
    Export(export::Export),
    Subtitles(subtitles::Subtitles),
    Maps(maps::Maps),
    Unpack(unpack::Unpack),
    Verify(verify::Verify),
    Inspect(inspect::Inspect),
    Diff(diff::Diff),
    Coverage(coverage::CoverageArguments),
    Stats(stats::Stats),
    Ids(ids::Ids),
    Babble(babble::BabbleArguments),
    Fallout(fallout::Fallout),
    Explain(explain::Explain),
    Schema(schema::Schema),
    Completions(completions::Completions),
    Man(man::ManPages),
}

impl Command {
    /// Whether standard output is for a result other than findings.
    pub(crate) fn prints_result(&self) -> bool {
        match self {
            Command::Pack(pack) => pack.prints_bank(),
            Command::Ids(ids) => ids.prints_ids(),
            Command::Check(check) => check.prints_diff(),
            Command::Fmt(fmt) => fmt.prints_result(),
            Command::Convert(convert) => convert.prints_result(),
            Command::Import(import) => import.prints_result(),
            Command::Export(export) => export.prints_result(),
            Command::Subtitles(_)
            | Command::Watch(_)
            | Command::Init(_)
            | Command::Unpack(_)
            | Command::Verify(_)
            | Command::Man(_) => false,
            Command::Inspect(_) | Command::Diff(_) | Command::Coverage(_) | Command::Stats(_) => true,
            Command::Babble(_) | Command::Fallout(_) | Command::Maps(_) => true,
            Command::Explain(_) | Command::Schema(_) | Command::Completions(_) => true,
        }
    }
}
