//! `lipz import`: imports files of other tools, by the kind of their content.

mod incoming_texts;
mod recogniser;
mod recordings;
mod subtitles;
mod texts;
mod visemes;

use clap::Args;

/// Import visemes, translations, subtitles or takes from files of other tools.
///
/// Files that exist are merged: each import changes only its own part of a Lipz file.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import visemes rhubarb-tsv recorded/*.tsv -o voices
  lipz import texts de-de.po
  lipz import recordings script.xlsx takes
  lipz import subtitles subtitles -o voices")]
pub(crate) struct Import {
    #[command(subcommand)]
    kind: ImportKind,
}

subcommands! {
    Import.kind: ImportKind {
        Visemes(visemes::ImportVisemes),
        Texts(texts::ImportTexts),
        Recordings(recordings::ImportRecordings),
        Subtitles(subtitles::ImportSubtitles),
        Recogniser(recogniser::RecogniserArguments),
    }
}
