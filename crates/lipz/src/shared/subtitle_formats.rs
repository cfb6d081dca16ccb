//! Formats of subtitle files.

use clap::ValueEnum;
use lipz_interop::subtitles::SubtitleFormat;

/// A format of subtitle files, for the command line.
#[derive(ValueEnum, Clone, Copy, Debug)]
pub(crate) enum SubtitleFormatArgument {
    /// SubRip
    Srt,
    /// WebVTT, with speakers
    Vtt,
}

impl From<SubtitleFormatArgument> for SubtitleFormat {
    fn from(format: SubtitleFormatArgument) -> SubtitleFormat {
        match format {
            SubtitleFormatArgument::Srt => SubtitleFormat::Srt,
            SubtitleFormatArgument::Vtt => SubtitleFormat::Vtt,
        }
    }
}
