//! The settings of a project, and with the feature `settings` its file `lipz.toml`.

mod audio;
#[cfg(feature = "settings")]
mod babble;
#[cfg(feature = "settings")]
mod emotions;
#[cfg(feature = "settings")]
mod face;
#[cfg(feature = "settings")]
mod file;
mod find;
#[cfg(feature = "settings")]
pub mod lint;
#[cfg(feature = "settings")]
mod reading;
mod sync;
#[cfg(feature = "settings")]
mod syntax;
#[cfg(feature = "settings")]
mod table;
#[cfg(feature = "settings")]
mod template;
#[cfg(feature = "settings")]
mod value;

pub use audio::{Audio, KEY, SOUND_EXTENSIONS, refused_pattern, sound_rank, without_extension};
pub use find::FILE_NAME;
pub use sync::Sync;
#[cfg(feature = "settings")]
pub use table::{Content, Map, Setting, TABLES, Table};
#[cfg(feature = "settings")]
pub use template::template;
#[cfg(feature = "settings")]
pub use value::is_word;

use crate::{Input, Inputs, Options, Voices, discover};
use lipz_diagnostics::{DiagnosticsError, Report};
use std::path::PathBuf;

/// What a project decides: where its Lipz files are, where its bank goes, and how it is made.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Settings {
    /// Folders, files and glob patterns, as [`discover`](discover()) takes them.
    pub sources: Vec<PathBuf>,
    /// Keys are paths below this folder; `None` for below each source.
    pub root: Option<PathBuf>,
    /// Read hidden files and folders, too: those whose names start with a dot.
    pub hidden: bool,
    /// The bank to write.
    pub output: Option<PathBuf>,
    /// Write the texts of each locale into a text bank of its own.
    pub split_locales: bool,
    /// Write the dubs of each voice into a bank of its own.
    pub split_voices: bool,
    /// File in which a run remembers the Lipz files for the next one.
    pub cache: Option<PathBuf>,
    /// Its recordings.
    pub audio: Audio,
    /// How mouth shapes are made of them.
    pub sync: Sync,
    /// How the bank is made.
    pub options: Options,
    /// What is said about the file that they were read from.
    #[cfg(feature = "settings")]
    warnings: Option<Report>,
}

impl Settings {
    /// The settings of a project with these sources that decides nothing else.
    pub fn from_sources(sources: Vec<PathBuf>) -> Settings {
        Settings { sources, ..Settings::default() }
    }

    /// The voices of the project, for [`Options::voices`](Options::voices()).
    pub fn voices(&self) -> Voices {
        let original = self.audio.locale.as_ref().or(self.options.default_locale.as_ref()).cloned();
        Voices { original, patterns: self.audio.voices.clone() }
    }

    /// The warnings about the file that the settings were [read](Settings::read) from.
    #[cfg(feature = "settings")]
    pub fn warnings(&self) -> &[Report] {
        self.warnings.as_slice()
    }

    /// The Lipz files of the sources with their keys, as [`discover`](discover()) finds them.
    ///
    /// # Errors
    /// All diagnostics about the sources, at the project's levels, if one of them is an error: a file that cannot be read, or a
    /// folder without Lipz files.
    pub fn discover(&self) -> Result<Inputs, DiagnosticsError> {
        let (inputs, reports) = self.discover_with_reports();
        let (inputs, warnings) = DiagnosticsError::check(inputs, reports)?;
        Ok(Inputs { inputs, warnings })
    }

    /// The Lipz files that could be found, and all diagnostics about the sources, at the project's levels.
    ///
    /// For tools that report everything at once, such as the command `lipz` and editors. If a report has an error, files of
    /// the project are missing. All other programs call [`discover`](Settings::discover).
    #[must_use = "the reports say whether files are missing"]
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
