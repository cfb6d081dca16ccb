//! `lipz export`: files for other tools, by the kind of their content.

mod subtitles;
mod texts;
mod visemes;
mod weights;

use clap::Args;

/// Export visemes, weights of 3D faces, texts for translators, or subtitles.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz export visemes moho voices -o switches
  lipz export weights gltf voices -o animations
  lipz export texts po voices --locale de-de -o de-de.po
  lipz export subtitles vtt voices -o subtitles")]
pub(crate) struct Export {
    #[command(subcommand)]
    kind: ExportKind,
}

subcommands! {
    Export.kind: ExportKind {
        Visemes(visemes::ExportVisemes),
        Weights(weights::ExportWeights),
        Texts(texts::ExportTexts),
        Subtitles(subtitles::ExportSubtitles),
    }
}
