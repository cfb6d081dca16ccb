//! The settings of a project, and with the feature `settings` its file `lipz.toml`.

#[cfg(feature = "settings")]
mod articulation;
mod audio;
#[cfg(feature = "settings")]
mod babble;
#[cfg(feature = "settings")]
mod dubs;
#[cfg(feature = "settings")]
mod emotions;
#[cfg(feature = "settings")]
mod face;
#[cfg(feature = "settings")]
mod file;
mod find;
#[cfg(feature = "settings")]
pub mod lint;
mod named_file;
#[cfg(feature = "settings")]
mod overrides;
mod pixel_limits;
#[cfg(feature = "settings")]
mod read;
#[cfg(feature = "settings")]
mod reading;
#[cfg(feature = "settings")]
mod rig;
#[cfg(feature = "settings")]
mod sprites;
mod sync;
mod sync_status;
#[cfg(feature = "settings")]
mod syntax;
#[cfg(feature = "settings")]
mod table;
#[cfg(feature = "settings")]
mod template;
#[cfg(feature = "settings")]
mod text;
#[cfg(feature = "settings")]
mod value;

pub use audio::{Audio, KEY, SOUND_EXTENSIONS, refused_pattern, sound_rank, without_extension};
pub use find::FILE_NAME;
pub use named_file::NamedFile;
pub use pixel_limits::{PixelLimit, PixelLimits};
pub use sync::Sync;
pub use sync_status::{SyncStatus, SyncStatuses};
#[cfg(feature = "settings")]
pub use table::{Content, Map, Setting, TABLES, Table, find_flat};
#[cfg(feature = "settings")]
pub use template::{short_template, template};
#[cfg(feature = "settings")]
pub use value::is_word;

use crate::project::{Options, Voices};
use crate::sources::{Input, Inputs, discover};
use lipz_diagnostics::{DiagnosticsError, Report};
use lipz_file::placeholder::PlaceholderPattern;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The settings of a project: its Lipz files, its bank, and the options for packing.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Settings {
    /// Folders, files and glob patterns, for [`discover`](discover()).
    pub sources: Vec<PathBuf>,
    /// The folder that keys are relative to; `None` for each source.
    pub root: Option<PathBuf>,
    /// Whether to read hidden files and folders, whose names start with a dot.
    pub hidden: bool,
    /// The bank to write.
    pub output: Option<PathBuf>,
    /// Whether to write the texts of each locale into a separate text bank.
    pub split_locales: bool,
    /// Whether to write the dubs of each voice into a separate bank.
    pub split_voices: bool,
    /// The file that stores checked Lipz files for the next run.
    pub cache: Option<PathBuf>,
    /// Its recordings.
    pub audio: Audio,
    /// The rules for making visemes from them.
    pub sync: Sync,
    /// The fonts of texts, and the limits for the widths of their lines.
    pub pixel_limits: PixelLimits,
    /// The table of terms and their translations.
    pub terms: Option<NamedFile>,
    /// The patterns of the game's own placeholders, which translations repeat.
    pub placeholders: Vec<PlaceholderPattern>,
    /// The images of characters' mouths for previews, by character; `default` is for all others.
    pub sprites: BTreeMap<String, Sprites>,
    /// The options for packing the bank.
    pub options: Options,
    /// The warnings about the settings file.
    #[cfg(feature = "settings")]
    warnings: Option<Report>,
}

/// The images of a character's mouth.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Sprites {
    /// A file per viseme code: the path with `{code}`, which stands for the code, or for `rest`.
    Files(PathBuf),
    /// A single file with images of the same width, from left to right in the order of these codes.
    Sheet(PathBuf, String),
}

impl Settings {
    /// Creates the default settings of a project with these sources.
    pub fn from_sources(sources: Vec<PathBuf>) -> Settings {
        Settings { sources, ..Settings::default() }
    }

    /// Returns the voices of the project, for [`Options::voices`](Options::voices()).
    pub fn voices(&self) -> Voices {
        let original = self.audio.locale.as_ref().or(self.options.default_locale.as_ref()).cloned();
        Voices { original, patterns: self.audio.voices.clone() }
    }

    /// Returns the warnings about the file that the settings were [read](Settings::read) from.
    #[cfg(feature = "settings")]
    pub fn warnings(&self) -> &[Report] {
        self.warnings.as_slice()
    }

    /// Returns the Lipz files of the sources with their keys, as [`discover`](discover()) finds them.
    ///
    /// # Errors
    /// If a file cannot be read, if a folder contains no Lipz files, or for any other error about the sources: all
    /// diagnostics, at the project's levels.
    pub fn discover(&self) -> Result<Inputs, DiagnosticsError> {
        let (inputs, reports) = self.discover_with_reports();
        let (inputs, warnings) = DiagnosticsError::check(inputs, reports)?;
        Ok(Inputs { inputs, warnings })
    }

    /// Returns the Lipz files that could be found, and all diagnostics about the sources, at the project's levels.
    ///
    /// This is for tools that report everything at once, such as the command `lipz` and editors. If a report has an
    /// error, files of the project are missing. All other programs should call [`discover`](Settings::discover).
    #[must_use = "check the reports for missing files"]
    pub fn discover_with_reports(&self) -> (Vec<Input>, Vec<Report>) {
        let (inputs, mut reports) =
            discover::find(&self.sources, self.root.as_deref(), self.hidden, self.options.threads);
        for report in &mut reports {
            self.options.levels.apply(&mut report.diagnostics);
        }
        reports.retain(|report| !report.diagnostics.is_empty());
        (inputs, reports)
    }
}
