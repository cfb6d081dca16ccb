//! `lipz subtitles`: texts of clips to and from subtitle files.

mod export;
mod found;
mod import;

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::{Args, Subcommand, ValueEnum};
use lipz_interop::subtitles::SubtitleFormat;

/// Write the texts of clips as subtitles, or read them from there: SubRip (.srt) and WebVTT (.vtt).
///
/// Each segment is a cue, from its first frame to that of the next segment.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz subtitles export vtt voices -o subtitles
  lipz subtitles export srt voices -o subtitles --locale de-de --locale fr-fr
  lipz subtitles import subtitles -o voices
  lipz subtitles import mayor.srt -o voices --locale en-us --fps 24")]
pub(crate) struct Subtitles {
    #[command(subcommand)]
    direction: Direction,
}

#[derive(Subcommand, Debug)]
enum Direction {
    Export(Box<export::Export>),
    Import(import::Import),
}

/// A format of subtitle files, for the command line.
#[derive(ValueEnum, Clone, Copy, Debug)]
enum Format {
    /// SubRip
    Srt,
    /// WebVTT, with speakers
    Vtt,
}

impl From<Format> for SubtitleFormat {
    fn from(format: Format) -> SubtitleFormat {
        match format {
            Format::Srt => SubtitleFormat::Srt,
            Format::Vtt => SubtitleFormat::Vtt,
        }
    }
}

impl Run for Subtitles {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        match &self.direction {
            Direction::Export(export) => export::run(export, reporter),
            Direction::Import(import) => import::run(import, reporter),
        }
    }
}
