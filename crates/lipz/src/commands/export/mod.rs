//! `lipz export`: files for other tools, by the kind of their content.

mod recording_script;
mod subtitles;
mod texts;
mod units;
mod visemes;
mod weights;

use clap::Args;

/// Export visemes, weights of 3D faces, texts, recording scripts, or subtitles.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz export visemes moho voices -o switches
  lipz export weights gltf voices -o animations
  lipz export texts po voices --locale de-de -o de-de.po
  lipz export recording-script html voices --locale de-de -o script.html
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
        RecordingScript(recording_script::ExportRecordingScript),
        Subtitles(subtitles::ExportSubtitles),
    }
}
