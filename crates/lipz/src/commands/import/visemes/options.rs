//! The flags of an import, and the project settings that they override.

use super::recordings::Recordings;
use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::existing_file::ExistingFile;
use crate::shared::formats::{self, MapChoice};
use crate::shared::lint_flags::LintFlags;
use crate::shared::settings_file::SettingsFile;
use crate::shared::stdin_file::StdinFile;
use crate::shared::values::{parse_fps, parse_locale, parse_viseme_type};
use clap::{Args, ValueEnum};
use lipz_bank::Fps;
use lipz_compiler::settings::Sync;
use lipz_diagnostics::Diagnostic;
use lipz_file::rate::{self, Rate};
use lipz_interop::textgrid::TierChoice;
use lipz_interop::{DEFAULT_RATE, ImportOptions, MergeOptions, Segments, Time};
use lipz_types::VisemeType;
use std::path::{Path, PathBuf};

const SHAPES: &str = "Visemes";
pub(super) const TEXT: &str = "Text and segments";

#[derive(Args, Debug)]
pub(crate) struct Options {
    /// Mapping table, by its name or as a file [default: that of the format]
    #[arg(long, value_name = "NAME|FILE", help_heading = SHAPES)]
    map: Option<String>,

    /// Viseme type: blair, toonboom, rms [default: that of the table]
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type, help_heading = SHAPES)]
    viseme_type: Option<VisemeType>,

    /// Frame rate of the clips [default: that of the file, or 24]
    #[arg(long, value_name = "FPS", value_parser = parse_fps, help_heading = SHAPES)]
    fps: Option<Fps>,

    /// Frames (fallout: units) per second in files that do not name their rate
    ///
    /// The default is 24 frames, or 60 for ovr. For fallout, it is the unit that fits the length of the audio, or 44100.
    #[arg(long, value_name = "NUMBER", value_parser = parse_rate, help_heading = SHAPES)]
    file_rate: Option<Rate>,

    /// Tier of a TextGrid with the phones, or ROLE=NAME
    ///
    /// The roles are `phones`, `visemes`, `words` and `segments`.
    #[arg(long = "tier", value_name = "NAME", help_heading = SHAPES)]
    tiers: Vec<TierChoice>,

    /// First frame number of Moho files: 0 or 1
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=1), help_heading = SHAPES)]
    dat_base: u64,

    /// Minimum frames per mouth shape
    #[arg(long, value_name = "FRAMES", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..), help_heading = SHAPES)]
    min_hold: u16,

    /// Locale of the text [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, help_heading = TEXT)]
    locale: Option<String>,

    /// Divide texts at phrases, pauses, sentences, none
    #[arg(long, value_enum, value_name = "WHERE", default_value_t = SegmentBoundaries::Phrases, help_heading = TEXT)]
    #[arg(hide_possible_values = true)]
    segments: SegmentBoundaries,

    /// Seconds of rest that count as a pause
    #[arg(long, value_name = "SECONDS", default_value = "0.3", value_parser = parse_time, help_heading = TEXT)]
    min_pause: Time,

    #[command(flatten)]
    pub(super) recordings: Recordings,

    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    stdin: StdinFile,

    #[command(flatten)]
    lints: LintFlags,
}

#[derive(ValueEnum, Clone, Copy, Debug)]
enum SegmentBoundaries {
    /// At the phrases of the file
    Phrases,
    /// Where the mouth rests
    Pauses,
    /// At the ends of the text's sentences
    Sentences,
    /// Nowhere
    None,
}

impl From<SegmentBoundaries> for Segments {
    fn from(place: SegmentBoundaries) -> Segments {
        match place {
            SegmentBoundaries::Phrases => Segments::Phrases,
            SegmentBoundaries::Pauses => Segments::Pauses,
            SegmentBoundaries::Sentences => Segments::Sentences,
            SegmentBoundaries::None => Segments::None,
        }
    }
}

/// The settings of an import: project settings, overridden by flags.
pub(super) struct Settings<'a> {
    flags: &'a Options,
    project: lipz_compiler::Options,
    /// The rules for visemes made from phones.
    pub(super) sync: Sync,
    map: Option<MapChoice>,
}

impl Options {
    /// Returns the settings of the project to which the output belongs, overridden by the flags.
    pub(super) fn settings(
        &self,
        files: &[PathBuf],
        output: Option<&Path>,
        reporter: &mut Reporter,
    ) -> Result<Settings<'_>, Abort> {
        self.stdin.apply(files, reporter)?;
        // The new Lipz files are sources of the project.
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
            .file_rate(flags.file_rate)
            .units_per_second(flags.file_rate.filter(|rate| rate.denominator == 1).map(|rate| rate.numerator))
            .tiers(&flags.tiers)
            .dat_base(flags.dat_base)
            .min_hold(usize::from(flags.min_hold))
            .locale(self.default_locale())
            .segments(flags.segments.into())
            .min_pause(flags.min_pause)
    }

    /// Returns the options for files of existing clips, which keep their rate and viseme type unless a flag or the file
    /// sets them. `None` if that changes nothing, or if the clips differ in them.
    pub(super) fn as_before<'o, 'e>(
        &self,
        clips: impl Iterator<Item = &'e ExistingFile>,
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

    /// Returns the options for merging.
    pub(super) fn merge_options(&self) -> MergeOptions<'_> {
        MergeOptions::new()
            .locale(self.default_locale())
            .default_locale(self.project.get_default_locale().or(self.flags.locale.as_deref()))
            .min_pause(self.flags.min_pause)
            .default_rate(self.project.get_default_fps().map(formats::rate))
            .default_viseme_type(self.project.get_default_viseme_type())
            .phones(self.sync.phones)
    }

    /// Returns the locale of texts without a locale of their own.
    pub(super) fn default_locale(&self) -> Option<&str> {
        self.flags.locale.as_deref().or(self.project.get_default_locale())
    }

    /// Sets the levels of diagnostics to those of the project.
    pub(super) fn apply_levels(&self, diagnostics: &mut Vec<Diagnostic>) {
        self.project.get_levels().apply(diagnostics);
    }
}

fn parse_rate(text: &str) -> Result<Rate, String> {
    rate::parse(text)
        .filter(|rate| rate.numerator > 0)
        .ok_or_else(|| "expected a number above 0, such as 24 or 29.97".into())
}

pub(super) fn parse_time(text: &str) -> Result<Time, String> {
    Time::parse(text).ok_or_else(|| "expected seconds, such as 0.3".into())
}
