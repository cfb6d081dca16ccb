//! `lipz import`: imports files of other tools, by the kind of their content.

mod recogniser;
mod subtitles;
mod texts;
mod visemes;

use clap::Args;

/// Import visemes, translations or subtitles from files of other tools.
///
/// Files that exist are merged: each import changes only its own part of a Lipz file.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import visemes rhubarb-tsv recorded/*.tsv -o voices
  lipz import texts de-de.po
  lipz import subtitles subtitles -o voices")]
pub(crate) struct Import {
    #[command(subcommand)]
    kind: ImportKind,
}

subcommands! {
    Import.kind: ImportKind {
        Visemes(visemes::ImportVisemes),
        Texts(texts::ImportTexts),
        Subtitles(subtitles::ImportSubtitles),
        Recogniser(recogniser::RecogniserArguments),
    }
}
