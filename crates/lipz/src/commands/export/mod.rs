//! `lipz export`: files for other tools, by the kind of their content.

mod subtitles;
mod texts;
mod visemes;

use clap::Args;

/// Export visemes, texts for translators, or subtitles.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz export visemes moho voices -o switches
  lipz export texts po voices --locale de-de -o de-de.po
  lipz export subtitles vtt voices -o subtitles")]
pub(crate) struct Export {
    #[command(subcommand)]
    kind: ExportKind,
}

subcommands! {
    Export.kind: ExportKind {
        Visemes(visemes::ExportVisemes),
        Texts(texts::ExportTexts),
        Subtitles(subtitles::ExportSubtitles),
    }
}
