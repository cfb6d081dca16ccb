//! The command line. Arguments and help of each command are defined next to its code, in `commands`.

use crate::commands::Command;
use crate::reporter::ReportFormat;
use clap::{Arg, Parser};
use colorchoice_clap::Color;

/// Spoken dialogue for games: packs Lipz files into banks.
///
/// A Lipz file describes one voice-over clip: a viseme for each frame, subtitles for each locale, events
/// for each segment. A bank holds many clips in one file, which games read in place.
#[derive(Parser, Debug)]
#[command(name = "lipz", version, max_term_width = 100, mut_args(in_short))]
#[command(after_help = "Exit codes: 0 no errors, 1 diagnostics at error level, 2 the tool could not run, \
                  130 interrupted.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) color: Color,

    /// Output format: human, json, sarif, github, gitlab, junit, concise
    #[arg(long, global = true, value_enum, value_name = "FORMAT", default_value_t = ReportFormat::Human)]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub(crate) output_format: ReportFormat,

    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Shortens the help of `--color`, which comes from a library.
fn in_short(argument: Arg) -> Arg {
    match argument.get_id().as_str() {
        "color" => argument
            .help("Colours in the output: auto, always, never")
            .hide_possible_values(true)
            .hide_default_value(true),
        _ => argument,
    }
}
