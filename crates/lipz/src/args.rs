//! The command line. Each command's arguments and help are beside its work, in `commands`.

use crate::commands::Command;
use crate::reporter::Format;
use clap::Parser;
use colorchoice_clap::Color;

/// Spoken dialogue for games: packs Lipz files into banks.
///
/// A Lipz file has one voice-over clip: a mouth shape per frame, subtitles per locale, events per
/// segment. A bank has many clips in one file that games read in place.
#[derive(Parser, Debug)]
#[command(name = "lipz", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 no errors, 1 diagnostics at error level, 2 the tool could not run, \
                  130 interrupted.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) color: Color,

    /// Format of diagnostics
    #[arg(long, global = true, value_enum, value_name = "FORMAT", default_value_t = Format::Human)]
    pub(crate) format: Format,

    #[command(subcommand)]
    pub(crate) command: Command,
}
