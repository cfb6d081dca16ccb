//! The command line: commands, arguments, help texts.

use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand};
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::Options;
use std::ffi::OsString;
use std::path::PathBuf;

/// Spoken dialogue for games: packs Lipz files into banks.
///
/// A Lipz file holds one voice clip: a mouth shape per frame, subtitles per locale, events per
/// segment. A bank holds many clips in one file that games use in place.
#[derive(Parser, Debug)]
#[command(name = "lipz", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 nothing at error level, 1 findings at error level, 2 the tool could not run.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Arguments {
    /// The arguments in `words`, the first of which is the program's name.
    pub(crate) fn read(words: impl IntoIterator<Item = OsString>) -> Result<Arguments, clap::Error> {
        let arguments = Arguments::try_parse_from(words)?;
        match &arguments.command {
            Command::Pack(pack) => pack.sources.validate()?,
            Command::Check(check) => check.sources.validate()?,
            Command::Unpack(_) | Command::Verify(_) | Command::Inspect(_) => {}
        }
        Ok(arguments)
    }
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Pack(Pack),
    Check(Check),
    Unpack(Unpack),
    Verify(Verify),
    Inspect(Inspect),
}

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays as it is until the new one is complete and verified. Nothing is written if
/// there are errors.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices/act1 voices/act2 --root voices -o acts.lipzbank --default-locale en-us
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --strip")]
pub(crate) struct Pack {
    #[command(flatten)]
    pub(crate) sources: Sources,

    /// The bank to write
    #[arg(short, long, value_name = "BANK")]
    pub(crate) output: PathBuf,

    /// Leave out the source section: smaller, but unpacking gives display forms only
    #[arg(long)]
    pub(crate) strip: bool,

    /// Print where the time went
    #[arg(long)]
    pub(crate) timings: bool,
}

/// Check Lipz files without packing them.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz check voices
  lipz check voices/act1/mara-hello.lipz")]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) sources: Sources,
}

/// Write the clips of a bank as Lipz files.
///
/// Nothing is written outside the folder, and nothing at all if a key cannot be a file name.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz unpack dialogue.lipzbank -o voices")]
pub(crate) struct Unpack {
    /// The bank to read
    #[arg(value_name = "BANK")]
    pub(crate) bank: PathBuf,

    /// The folder to write into; it is made if it does not exist
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,

    /// Replace files that exist
    #[arg(long)]
    pub(crate) force: bool,

    /// Show no progress and no summary
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Check every byte and every reference of banks.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz verify dialogue.lipzbank")]
pub(crate) struct Verify {
    /// The banks to check
    #[arg(value_name = "BANK", required = true)]
    pub(crate) banks: Vec<PathBuf>,

    /// Print nothing about banks without fault
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Show what is in a bank: a summary, the list of clips, or one clip as a timeline.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz inspect dialogue.lipzbank
  lipz inspect dialogue.lipzbank --list act1/
  lipz inspect dialogue.lipzbank act1/mara-hello --locale de-de
  lipz inspect dialogue.lipzbank act1/mara-hello --json")]
pub(crate) struct Inspect {
    /// The bank to read
    #[arg(value_name = "BANK")]
    pub(crate) bank: PathBuf,

    /// The clip to show
    #[arg(value_name = "KEY")]
    pub(crate) key: Option<String>,

    /// List the clips whose keys start with PREFIX
    #[arg(long, value_name = "PREFIX", num_args = 0..=1, default_missing_value = "", conflicts_with = "key")]
    pub(crate) list: Option<String>,

    /// Show texts in this locale only; may be given several times
    #[arg(long, value_name = "LOCALE", requires = "key")]
    pub(crate) locale: Vec<String>,

    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

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
        }
    }
}

fn parse_fps(text: &str) -> Result<Fps, String> {
    lipz::rate::parse(text)
        .and_then(|rate| Fps::new(rate.numerator, rate.denominator))
        .ok_or_else(|| "a frame rate is a number from 1 to 1000, such as 24 or 29.97".into())
}

fn parse_viseme_type(text: &str) -> Result<VisemeType, String> {
    VisemeType::from_name(text).ok_or_else(|| "the viseme types are blair, toonboom and rms".into())
}

fn parse_locale(text: &str) -> Result<String, String> {
    lipz::locale::canonical_tag(text, true).ok_or_else(|| "a locale is a language and a country, such as en-us".into())
}
