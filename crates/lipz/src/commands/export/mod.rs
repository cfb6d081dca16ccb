//! `lipz export`: files for other tools, by the kind of their content.

mod subtitles;
mod texts;
mod visemes;

use crate::commands::Run;
use crate::reporter::{CommandResult, Reporter};
use clap::{Args, Subcommand};

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

#[derive(Subcommand, Debug)]
enum ExportKind {
    Visemes(Box<visemes::ExportVisemes>),
    Texts(Box<texts::ExportTexts>),
    Subtitles(Box<subtitles::ExportSubtitles>),
}

impl Export {
    fn task(&self) -> &dyn Run {
        match &self.kind {
            ExportKind::Visemes(visemes) => visemes.as_ref(),
            ExportKind::Texts(texts) => texts.as_ref(),
            ExportKind::Subtitles(subtitles) => subtitles.as_ref(),
        }
    }
}

impl Run for Export {
    fn prints_result(&self) -> bool {
        self.task().prints_result()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.task().run(reporter)
    }
}
