//! The options of a project for its Lipz files.

mod emotions;
mod file_levels;
mod gestures;
mod getters;
mod locale_error;
mod requirements;
mod setters;

pub(crate) use emotions::Face;
pub use emotions::{EmotionCurves, EmotionOptions};
pub use file_levels::FileLevels;
pub(crate) use file_levels::FileOptions;
pub use gestures::{GestureKeys, Gestures};
pub use locale_error::LocaleError;
pub use requirements::{KnownNames, MinCoverage, TextLimits};

use crate::project::articulation::ArticulationSettings;
use crate::project::babble::BabbleProfiles;
use crate::project::face::FaceProfileSettings;
use crate::project::pseudo_locale::locale_for;
use crate::project::rigs::{RigSettings, WeightSpec};
use crate::project::{Voices, WordTimes};
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_diagnostics::{Code, Levels, Report, escape};
use lipz_file::locale::{TextName, split_variant};
use std::collections::{BTreeMap, BTreeSet};

/// The options of a project for its Lipz files. New versions may add options: start with [`Options::new`] and set those
/// that differ.
///
/// Each option has a method that sets it and one that returns it, whose name starts with `get_`, as in
/// [`std::process::Command`]. Setters check locales.
///
/// ```
/// use lipz_compiler::{Options, TextLimits};
/// let options = Options::new()
///     .default_locale("en-us")?
///     .fallback("de-at", ["de-de", "en-us"])?
///     .text_limits(TextLimits::new().line_columns(42).lines(2));
/// assert_eq!(options.get_default_locale(), Some("en-us"));
/// assert_eq!(options.get_text_limits().get_lines(), Some(2));
/// assert!(Options::new().default_locale("english").is_err());
/// # Ok::<(), lipz_compiler::LocaleError>(())
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Options {
    /// The frame rate of files without `fps`. Without it, the rate of their clips is "unspecified".
    pub(crate) default_fps: Option<Fps>,
    /// The viseme type of files without `viseme_type`. Without it, the type of their clips is "unspecified".
    pub(crate) default_viseme_type: Option<VisemeType>,
    /// The locale of `text` elements without one, and the last fallback of every locale, in its canonical form.
    pub(crate) default_locale: Option<String>,
    /// Accepts any BCP 47 language tag (`es-419`, `zh-hant`) instead of only `ll-cc`.
    pub(crate) extended_locales: bool,
    /// Leaves out the source section: the bank is smaller, but unpacking restores only display forms.
    pub(crate) strip: bool,
    /// The number of threads that read and check files; `None` for one per core.
    pub(crate) threads: Option<usize>,
    /// Levels of lints that differ from their defaults.
    pub(crate) levels: Levels,
    /// Levels for some of the files, which override `levels`. Later ones take precedence.
    pub(crate) files_levels: Vec<FileLevels>,
    /// Locales to pack; `None` for all locales of the files.
    pub(crate) locales: Option<BTreeSet<String>>,
    /// For a locale, those that replace its missing texts, in order, instead of the usual ones.
    pub(crate) fallbacks: BTreeMap<String, Vec<String>>,
    /// Displays braces unchanged: `{0}` is a placeholder of the game, not meta.
    pub(crate) literal_braces: bool,
    /// Limits of texts on a screen, and of reading speed.
    pub(crate) text_limits: TextLimits,
    /// The limits of locales and languages, which replace these.
    pub(crate) locale_limits: BTreeMap<String, TextLimits>,
    /// The names that events may use.
    pub(crate) known_names: KnownNames,
    /// The viseme type that clips of other types are converted to.
    pub(crate) viseme_type: Option<VisemeType>,
    /// The share of the dialogue that must be translated for a bank to be made.
    pub(crate) min_coverage: MinCoverage,
    /// Adds a pseudo-locale made from the texts of the default locale: `en-xa` from `en-us`. It is packed even if
    /// `locales` does not name it. Existing texts of files in it are kept.
    pub(crate) pseudo: bool,
    /// The mouth movement without a clip.
    pub(crate) babble: BabbleProfiles,
    /// The spontaneous movements of faces.
    pub(crate) faces: FaceProfileSettings,
    /// The movements of mouths with phones.
    pub(crate) articulation: ArticulationSettings,
    /// The shapes of models.
    pub(crate) rigs: RigSettings,
    /// The name and the weights of the rig whose weights become curves.
    pub(crate) baked_rig: Option<(String, Vec<WeightSpec>)>,
    /// The conversion of emotions in texts and events to curves.
    pub(crate) emotions: EmotionOptions,
    /// The movements of faces during speech and listening.
    pub(crate) gestures: Gestures,
    /// Data about the recordings of clips for the bank, by key. Keys without a clip are ignored. Without entries, the
    /// bank has no section about recordings.
    pub(crate) recordings: BTreeMap<String, Recording>,
    /// The times of the words of clips, by key, which determine changes of emotions and movements of faces.
    pub(crate) word_times: BTreeMap<String, WordTimes>,
    /// The languages in which lines are recorded. They determine the dubs, and the texts whose emotions apply.
    pub(crate) voices: Voices,
}

impl Options {
    /// Returns the options with all locales in their canonical form, and the pseudo-locale among those to pack.
    pub(crate) fn canonical(&self) -> Result<Options, Report> {
        let canonical = |tag: &String| {
            lipz_file::locale::canonical_tag(tag, self.extended_locales).ok_or_else(|| {
                let message = format!("the project's locale {} is not a locale of the form ll-cc", escape::quoted(tag));
                Report::failure("", Code::LocaleShape, message, "name a language and a country: en-us")
            })
        };
        if self.pseudo && self.default_locale.is_none() {
            let message = "the pseudo-locale needs a default locale, which is not set".to_owned();
            return Err(Report::failure(
                "",
                Code::SettingValue,
                message,
                "set the default locale: default-locale = \"en-us\"",
            ));
        }
        let chain = |(tag, chain): (&String, &Vec<String>)| {
            Ok((canonical(tag)?, chain.iter().map(canonical).collect::<Result<_, Report>>()?))
        };
        let share = |(tag, percent): (&String, &f64)| Ok((canonical(tag)?, *percent));
        let default_locale = self.default_locale.as_ref().map(canonical).transpose()?;
        let mut locales: Option<BTreeSet<String>> =
            self.locales.as_ref().map(|tags| tags.iter().map(canonical).collect()).transpose()?;
        if let (Some(locales), Some(default), true) = (&mut locales, &default_locale, self.pseudo) {
            locales.insert(locale_for(default));
        }
        let pattern = |(tag, pattern): (&String, &String)| Ok((canonical(tag)?, pattern.clone()));
        Ok(Options {
            default_locale,
            locales,
            voices: Voices {
                original: self.voices.original.as_ref().map(canonical).transpose()?,
                patterns: self.voices.patterns.iter().map(pattern).collect::<Result<_, Report>>()?,
            },
            fallbacks: self.fallbacks.iter().map(chain).collect::<Result<_, Report>>()?,
            min_coverage: MinCoverage {
                locales: self.min_coverage.locales.iter().map(share).collect::<Result<_, Report>>()?,
                ..self.min_coverage
            },
            ..self.clone()
        })
    }

    /// Whether the element with this name is packed: all elements except texts in unpacked locales. A variant is packed
    /// with its locale.
    pub(crate) fn packs(&self, name: &str) -> bool {
        let Some(packed) = &self.locales else { return true };
        match lipz_file::locale::text_name(name) {
            Some(TextName::NoLocale) => self.default_locale.as_ref().is_none_or(|tag| packed.contains(tag)),
            text => text.and_then(TextName::tag).is_none_or(|tag| packed.contains(split_variant(&tag).0)),
        }
    }

    /// Returns the pseudo-locale made from the texts of this locale, if there is one.
    pub(crate) fn pseudo_locale_of(&self, tag: &str) -> Option<String> {
        let is_source = self.pseudo && self.default_locale.as_deref() == Some(tag);
        is_source.then(|| locale_for(tag))
    }
}
