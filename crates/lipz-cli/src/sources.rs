//! The arguments of commands that read Lipz files: where they are, and what the project decides about them.

use crate::args::Arguments;
use clap::error::ErrorKind;
use clap::{Args, CommandFactory};
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::Options;
use std::path::PathBuf;

/// Where Lipz files come from, and what the project decides about them.
#[derive(Args, Debug)]
pub(crate) struct Sources {
    /// Folders, files or glob patterns
    #[arg(value_name = "SOURCES", required = true)]
    pub(crate) sources: Vec<PathBuf>,

    /// Keys are paths below this folder [default: each source folder]
    #[arg(long, value_name = "FOLDER")]
    pub(crate) root: Option<PathBuf>,

    /// Frame rate of files without `fps` [default: unspecified, the game supplies it]
    #[arg(long, value_name = "FPS", value_parser = parse_fps)]
    pub(crate) default_fps: Option<Fps>,

    /// Viseme type of files without `viseme_type`: blair, toonboom, rms [default: unspecified]
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type)]
    pub(crate) default_viseme_type: Option<VisemeType>,

    /// Locale of `text` without a locale, and the one that others fall back to
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    pub(crate) default_locale: Option<String>,

    /// Accept any BCP 47 language tag (es-419, zh-hant), not only ll-cc
    #[arg(long)]
    pub(crate) extended_locales: bool,

    /// Threads to use [default: one per core]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Show no progress and no summary, only findings
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

impl Sources {
    /// What the parser cannot see by itself: arguments that contradict each other.
    ///
    /// # Errors
    /// A usage error for the command line.
    pub(crate) fn validate(&self) -> Result<(), clap::Error> {
        let refused = |tag: &&String| !self.extended_locales && !lipz::locale::has_lipz_shape(tag);
        let Some(tag) = self.default_locale.as_ref().filter(refused) else { return Ok(()) };
        let tip = "name a country, as in en-us, or accept any BCP 47 tag with '--extended-locales'";
        let message = format!("the default locale '{tag}' does not have the form ll-cc\n\n  tip: {tip}");
        Err(Arguments::command().error(ErrorKind::ArgumentConflict, message))
    }

    /// The compiler's options.
    pub(crate) fn options(&self) -> Options {
        Options {
            default_fps: self.default_fps,
            default_viseme_type: self.default_viseme_type,
            default_locale: self.default_locale.clone(),
            extended_locales: self.extended_locales,
            strip: false,
            threads: self.threads.map(usize::from),
            ..Options::default()
        }
    }
}

fn parse_fps(text: &str) -> Result<Fps, String> {
    lipz::rate::parse(text)
        .and_then(|rate| Fps::new(rate.numerator, rate.denominator))
        .ok_or_else(|| "a frame rate is a number from 1 to 1000, such as 24 or 29.97".into())
}

pub(crate) fn parse_viseme_type(text: &str) -> Result<VisemeType, String> {
    VisemeType::from_name(text).ok_or_else(|| "the viseme types are blair, toonboom and rms".into())
}

pub(crate) fn parse_locale(text: &str) -> Result<String, String> {
    lipz::locale::canonical_tag(text, true).ok_or_else(|| "a locale is a language and a country, such as en-us".into())
}
