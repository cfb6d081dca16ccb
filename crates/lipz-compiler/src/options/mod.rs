//! What a project decides about its Lipz files.

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

use crate::babble::BabbleProfiles;
use crate::face::FaceProfileSettings;
use crate::{Voices, WordTimes, pseudo};
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_diagnostics::{Code, Levels, Report, escape};
use lipz_file::locale::TextName;
use std::collections::{BTreeMap, BTreeSet};

/// What a project decides about its Lipz files. New options appear with new versions: start from
/// [`Options::new`] and set what differs.
///
/// Each option has a method that sets it and one that returns it, whose name starts with `get_`, as those of
/// [`std::process::Command`]. Locales are checked where they are set.
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
    /// Frame rate of files without `fps`. Without it their clips' rate is "unspecified".
    pub(crate) default_fps: Option<Fps>,
    /// Viseme type of files without `viseme_type`. Without it their clips' type is "unspecified".
    pub(crate) default_viseme_type: Option<VisemeType>,
    /// Locale of `text` elements without one, and the last resort of every locale's fallback, in its canonical form.
    pub(crate) default_locale: Option<String>,
    /// Accept any BCP 47 language tag (`es-419`, `zh-hant`), not only `ll-cc`.
    pub(crate) extended_locales: bool,
    /// Leave out the source section: smaller, but unpacking gives display forms only.
    pub(crate) strip: bool,
    /// Threads that read and check files; `None` for one per core.
    pub(crate) threads: Option<usize>,
    /// Levels of lints that differ from their defaults.
    pub(crate) levels: Levels,
    /// Levels that hold for some of the files, over `levels`; later ones win.
    pub(crate) files_levels: Vec<FileLevels>,
    /// Locales to pack; `None` for all that the files have.
    pub(crate) locales: Option<BTreeSet<String>>,
    /// For a locale, those that its missing texts are taken from, in order, instead of the usual
    /// ones.
    pub(crate) fallbacks: BTreeMap<String, Vec<String>>,
    /// Braces are displayed as they are: `{0}` is a placeholder of the game, not meta.
    pub(crate) literal_braces: bool,
    /// How much text a screen holds and a player reads.
    pub(crate) text_limits: TextLimits,
    /// The names that events may mention.
    pub(crate) known_names: KnownNames,
    /// Viseme type that clips of other types are converted to.
    pub(crate) viseme_type: Option<VisemeType>,
    /// How much of the dialogue must be translated for a bank to be made.
    pub(crate) min_coverage: MinCoverage,
    /// Add a pseudo-locale, made of the texts of the default locale: `en-xa` of `en-us`. It is packed
    /// whether `locales` names it or not. Files that have a text in it keep theirs.
    pub(crate) pseudo: bool,
    /// How mouths move that no clip describes.
    pub(crate) babble: BabbleProfiles,
    /// How faces move by themselves.
    pub(crate) faces: FaceProfileSettings,
    /// How emotions in texts and events become curves.
    pub(crate) emotions: EmotionOptions,
    /// What faces do while something is said or heard.
    pub(crate) gestures: Gestures,
    /// What the bank says about the recordings of clips, by key. Keys without a clip are ignored; without any entry
    /// the bank has no section about recordings.
    pub(crate) recordings: BTreeMap<String, Recording>,
    /// When the words of clips are said, by key: where emotions change, and what faces do.
    pub(crate) word_times: BTreeMap<String, WordTimes>,
    /// The languages in which lines are recorded: which clips are dubs, and whose text has the emotions that count.
    pub(crate) voices: Voices,
}

impl Options {
    /// The options with all locales in their canonical form, and the pseudo-locale among those to be packed.
    pub(crate) fn canonical(&self) -> Result<Options, Report> {
        let canonical = |tag: &String| {
            lipz_file::locale::canonical_tag(tag, self.extended_locales).ok_or_else(|| {
                let message = format!("the project's locale {} is not a locale of the form ll-cc", escape::quoted(tag));
                Report::failure("", Code::LocaleShape, message, "name a language and a country: en-us")
            })
        };
        if self.pseudo && self.default_locale.is_none() {
            let message = "a pseudo-locale is made of the default locale, and there is none".to_owned();
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
            locales.insert(pseudo::locale_for(default));
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

    /// Whether the element with this name is packed: all but texts of other locales than those that are.
    pub(crate) fn packs(&self, name: &str) -> bool {
        let Some(packed) = &self.locales else { return true };
        match lipz_file::locale::text_name(name) {
            Some(TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag))) => {
                packed.contains(&tag)
            }
            Some(TextName::NoLocale) => self.default_locale.as_ref().is_none_or(|tag| packed.contains(tag)),
            Some(TextName::OtherShape(_, None)) | None => true,
        }
    }

    /// The pseudo-locale that is made of the texts of this locale, if one is.
    pub(crate) fn pseudo_locale_of(&self, tag: &str) -> Option<String> {
        let is_source = self.pseudo && self.default_locale.as_deref() == Some(tag);
        is_source.then(|| pseudo::locale_for(tag))
    }
}
