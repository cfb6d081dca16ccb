//! `lipz import`: imports files of other tools, by the kind of their content.

mod recogniser;
mod subtitles;
mod texts;
mod visemes;

use crate::commands::Run;
use crate::reporter::{CommandResult, Reporter};
use clap::{Args, Subcommand};

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

#[derive(Subcommand, Debug)]
enum ImportKind {
    Visemes(Box<visemes::ImportVisemes>),
    Texts(Box<texts::ImportTexts>),
    Subtitles(Box<subtitles::ImportSubtitles>),
    Recogniser(recogniser::RecogniserArguments),
}

impl Import {
    fn task(&self) -> &dyn Run {
        match &self.kind {
            ImportKind::Visemes(visemes) => visemes.as_ref(),
            ImportKind::Texts(texts) => texts.as_ref(),
            ImportKind::Subtitles(subtitles) => subtitles.as_ref(),
            ImportKind::Recogniser(recogniser) => recogniser,
        }
    }
}

impl Run for Import {
    fn prints_result(&self) -> bool {
        self.task().prints_result()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.task().run(reporter)
    }
}
