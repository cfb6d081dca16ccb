//! The flags of an import, and the settings of the project below them.

use super::recordings::Recordings;
use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::existing::Existing;
use crate::shared::formats::{self, MapChoice};
use crate::shared::lint_flags::LintFlags;
use crate::shared::project_flags::{parse_fps, parse_locale, parse_viseme_type};
use crate::shared::settings_file::SettingsFile;
use clap::{Args, ValueEnum};
use lipz_bank::Fps;
use lipz_compiler::settings::Sync;
use lipz_diagnostics::Diagnostic;
use lipz_interop::{DEFAULT_RATE, ImportOptions, MergeOptions, Segments, Time};
use lipz_types::VisemeType;
use std::path::{Path, PathBuf};

const SHAPES: &str = "Mouth shapes";
pub(super) const TEXT: &str = "Text and segments";

#[derive(Args, Debug)]
pub(crate) struct Options {
    /// Mapping table to use instead of the format's: a name that `lipz maps` lists, or a file
    #[arg(long, value_name = "NAME|FILE", help_heading = SHAPES)]
    map: Option<String>,

    /// Viseme type of the clips: blair, toonboom, rms [default: that of lipz.toml, or of the format's first table]
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type, help_heading = SHAPES)]
    viseme_type: Option<VisemeType>,

    /// Frame rate of the clips [default: that of the file, or of lipz.toml, or 24]
    #[arg(long, value_name = "FPS", value_parser = parse_fps, help_heading = SHAPES)]
    fps: Option<Fps>,

    /// Frame rate of files that count frames but do not name their rate [default: 24, ovr: 60]
    #[arg(long, value_name = "FPS", value_parser = parse_fps, help_heading = SHAPES)]
    file_fps: Option<Fps>,

    /// Number of the first frame in Moho files: 0 or 1
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=1), help_heading = SHAPES)]
    dat_base: u64,

    /// Minimum frames per mouth shape
    #[arg(long, value_name = "FRAMES", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..), help_heading = SHAPES)]
    min_hold: u16,

    /// The spoken line: a text, a file, or for several clips a folder with KEY.txt for each
    #[arg(long, value_name = "TEXT|FILE|FOLDER", help_heading = TEXT)]
    pub(super) text: Option<String>,

    /// Locale of the text [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, help_heading = TEXT)]
    locale: Option<String>,

    /// Where to divide clips into segments, unless `|` in the text does
    #[arg(long, value_enum, value_name = "WHERE", default_value_t = Where::Phrases, help_heading = TEXT)]
    segments: Where,

    /// Seconds of rest that count as a pause
    #[arg(long, value_name = "SECONDS", default_value = "0.3", value_parser = parse_time, help_heading = TEXT)]
    min_pause: Time,

    #[command(flatten)]
    pub(super) recordings: Recordings,

    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    lints: LintFlags,
}

#[derive(ValueEnum, Clone, Copy, Debug)]
enum Where {
    /// At the phrases of the file, if it has any
    Phrases,
    /// Where the mouth rests
    Pauses,
    /// At the ends of the text's sentences
    Sentences,
    /// Nowhere
    None,
}

impl From<Where> for Segments {
    fn from(place: Where) -> Segments {
        match place {
            Where::Phrases => Segments::Phrases,
            Where::Pauses => Segments::Pauses,
            Where::Sentences => Segments::Sentences,
            Where::None => Segments::None,
        }
    }
}

/// The settings of an import: flags over the settings of the project.
pub(super) struct Settings<'a> {
    flags: &'a Options,
    project: lipz_compiler::Options,
    /// The rules of mouths that are made of phones.
    pub(super) sync: Sync,
    map: Option<MapChoice>,
}

impl Options {
    /// The settings of the project to which the output belongs, below the flags.
    pub(super) fn settings(&self, output: Option<&Path>, reporter: &mut Reporter) -> Result<Settings<'_>, Abort> {
        // The Lipz files that are made are sources of the project.
        let sources = [output.map_or_else(|| PathBuf::from("."), Path::to_owned)];
        let settings = self.file.project(&sources, reporter)?.settings;
        let (mut project, sync) = (settings.options, settings.sync);
        self.lints.apply(&mut project);
        let map = self.map.as_deref().map(|map| formats::map(map, reporter)).transpose()?;
        Ok(Settings { flags: self, project, sync, map })
    }
}

impl Settings<'_> {
    pub(super) fn import_options(&self) -> ImportOptions<'_> {
        let flags = self.flags;
        ImportOptions::new()
            .map(self.map.as_ref().map(MapChoice::map))
            .viseme_type(
                flags.viseme_type.or(self.project.get_viseme_type()).or(self.project.get_default_viseme_type()),
            )
            .rate(flags.fps.map(formats::rate))
            .default_rate(self.project.get_default_fps().map_or(DEFAULT_RATE, formats::rate))
            .file_rate(flags.file_fps.map(formats::rate))
            .dat_base(flags.dat_base)
            .min_hold(usize::from(flags.min_hold))
            .locale(self.default_locale())
            .segments(flags.segments.into())
            .min_pause(flags.min_pause)
    }

    /// The options for files whose clips exist: these have a rate and a type of their own, which they keep unless
    /// somebody or the file names another. `None` if that changes nothing, or not all of them agree.
    pub(super) fn as_before<'o, 'e>(
        &self,
        clips: impl Iterator<Item = &'e Existing>,
        options: &ImportOptions<'o>,
    ) -> Option<ImportOptions<'o>> {
        let mut of_clips = clips.filter_map(|clip| clip.rate_and_type().ok());
        let (rate, viseme_type) = of_clips.next().filter(|first| of_clips.all(|other| other == *first))?;
        let is_named = self.flags.viseme_type.or(self.project.get_viseme_type()).is_some();
        let viseme_type = viseme_type.filter(|_| !is_named).or(options.viseme_type);
        let rate = rate.unwrap_or(options.default_rate);
        let is_other = (rate, viseme_type) != (options.default_rate, options.viseme_type);
        is_other.then(|| options.clone().default_rate(rate).viseme_type(viseme_type))
    }

    /// What is decided about merging.
    pub(super) fn merge_options(&self) -> MergeOptions<'_> {
        MergeOptions::new()
            .locale(self.default_locale())
            .min_pause(self.flags.min_pause)
            .default_rate(self.project.get_default_fps().map(formats::rate))
            .default_viseme_type(self.project.get_default_viseme_type())
    }

    /// The locale of texts that do not name it.
    pub(super) fn default_locale(&self) -> Option<&str> {
        self.flags.locale.as_deref().or(self.project.get_default_locale())
    }

    /// Gives diagnostics the levels of the project.
    pub(super) fn apply_levels(&self, diagnostics: &mut Vec<Diagnostic>) {
        self.project.get_levels().apply(diagnostics);
    }
}

pub(super) fn parse_time(text: &str) -> Result<Time, String> {
    Time::parse(text).ok_or_else(|| "write seconds, such as 0.3".into())
}
