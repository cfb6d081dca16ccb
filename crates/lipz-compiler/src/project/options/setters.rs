//! The setters of [`Options`].

use super::{EmotionOptions, FileLevels, Gestures, KnownNames, LocaleError, MinCoverage, Options, TextLimits};
use crate::project::articulation::ArticulationSettings;
use crate::project::babble::BabbleProfiles;
use crate::project::face::FaceProfileSettings;
use crate::project::rigs::{RigSettings, WeightSpec};
use crate::project::{Voices, WordTimes};
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_diagnostics::Levels;

impl Options {
    /// Creates the default options.
    #[must_use]
    pub fn new() -> Options {
        Options::default()
    }

    /// Sets the frame rate of files without `fps`. Without it, the rate of their clips is "unspecified".
    #[must_use]
    pub fn default_fps(self, fps: impl Into<Option<Fps>>) -> Options {
        Options { default_fps: fps.into(), ..self }
    }

    /// Sets the viseme type of files without `viseme_type`. Without it, the type of their clips is "unspecified".
    #[must_use]
    pub fn default_viseme_type(self, viseme_type: impl Into<Option<VisemeType>>) -> Options {
        Options { default_viseme_type: viseme_type.into(), ..self }
    }

    /// Sets the locale of `text` elements without one, and the last fallback of every locale. Accepts the spellings of
    /// [`lipz_file::locale::canonical_tag`].
    ///
    /// # Errors
    /// If the tag does not have the form `ll-cc`; after [`extended_locales(true)`](Options::extended_locales), if it is not a
    /// BCP 47 language tag.
    pub fn default_locale(self, tag: impl AsRef<str>) -> Result<Options, LocaleError> {
        let tag = self.locale(tag.as_ref())?;
        Ok(Options { default_locale: Some(tag), ..self })
    }

    /// Accepts any BCP 47 language tag (`es-419`, `zh-hant`), or only `ll-cc`. Call it before setting locales.
    #[must_use]
    pub fn extended_locales(self, extended_locales: bool) -> Options {
        Options { extended_locales, ..self }
    }

    /// Leaves out the source section, or includes it. Without it, a bank is smaller, but unpacking restores only
    /// display forms.
    #[must_use]
    pub fn strip(self, strip: bool) -> Options {
        Options { strip, ..self }
    }

    /// Sets the number of threads that read and check files; `None` for one per core.
    #[must_use]
    pub fn threads(self, count: impl Into<Option<usize>>) -> Options {
        Options { threads: count.into(), ..self }
    }

    /// Sets the levels of lints that differ from their defaults.
    #[must_use]
    pub fn levels(self, levels: impl Into<Levels>) -> Options {
        Options { levels: levels.into(), ..self }
    }

    /// Adds levels for some of the files, which override those added before.
    #[must_use]
    pub fn file_levels(mut self, levels: FileLevels) -> Options {
        self.files_levels.push(levels);
        self
    }

    /// Packs only these locales.
    ///
    /// # Errors
    /// Those of [`default_locale`](Options::default_locale).
    pub fn locales<T: AsRef<str>>(self, tags: impl IntoIterator<Item = T>) -> Result<Options, LocaleError> {
        let locales = tags.into_iter().map(|tag| self.locale(tag.as_ref())).collect::<Result<_, _>>()?;
        Ok(Options { locales: Some(locales), ..self })
    }

    /// Replaces missing texts of one locale with those of others, in this order, instead of the usual ones.
    ///
    /// # Errors
    /// Those of [`default_locale`](Options::default_locale).
    pub fn fallback<T: AsRef<str>>(
        mut self,
        tag: impl AsRef<str>,
        chain: impl IntoIterator<Item = T>,
    ) -> Result<Options, LocaleError> {
        let tag = self.locale(tag.as_ref())?;
        let chain = chain.into_iter().map(|tag| self.locale(tag.as_ref())).collect::<Result<_, _>>()?;
        self.fallbacks.insert(tag, chain);
        Ok(self)
    }

    /// Returns the canonical form of a locale.
    fn locale(&self, tag: &str) -> Result<String, LocaleError> {
        LocaleError::check(tag, self.extended_locales)
    }

    /// Displays braces unchanged, for games with placeholders such as `{0}`, or reads them as meta information.
    #[must_use]
    pub fn literal_braces(self, literal_braces: bool) -> Options {
        Options { literal_braces, ..self }
    }

    /// Sets the limits of texts on a screen, and of reading speed.
    #[must_use]
    pub fn text_limits(self, text_limits: TextLimits) -> Options {
        Options { text_limits, ..self }
    }

    /// Sets the limits of texts in a locale or, for a language such as `ja`, in all of its locales. Limits that are not set
    /// here are those of [`text_limits`](Options::text_limits).
    ///
    /// # Errors
    /// If the tag is not a BCP 47 language tag.
    pub fn locale_limits(mut self, tag: impl AsRef<str>, limits: TextLimits) -> Result<Options, LocaleError> {
        self.locale_limits.insert(LocaleError::check(tag.as_ref(), true)?, limits);
        Ok(self)
    }

    /// Sets the names that events may use.
    #[must_use]
    pub fn known_names(self, known_names: KnownNames) -> Options {
        Options { known_names, ..self }
    }

    /// Converts clips of other viseme types to this one.
    #[must_use]
    pub fn viseme_type(self, viseme_type: impl Into<Option<VisemeType>>) -> Options {
        Options { viseme_type: viseme_type.into(), ..self }
    }

    /// Sets the share of the dialogue that must be translated for a bank to be made.
    #[must_use]
    pub fn min_coverage(self, min_coverage: MinCoverage) -> Options {
        Options { min_coverage, ..self }
    }

    /// Sets whether to add a pseudo-locale, made from the texts of the default locale (`en-xa` from `en-us`). A run
    /// reports an error if there is no default locale. The pseudo-locale is packed even if
    /// [`locales`](Options::locales) does not name it. Existing texts of files in it are kept.
    #[must_use]
    pub fn pseudo(self, pseudo: bool) -> Options {
        Options { pseudo, ..self }
    }

    /// Sets the mouth movement without viseme data.
    #[must_use]
    pub fn babble(self, babble: BabbleProfiles) -> Options {
        Options { babble, ..self }
    }

    /// Sets the spontaneous movements of faces.
    #[must_use]
    pub fn faces(self, faces: FaceProfileSettings) -> Options {
        Options { faces, ..self }
    }

    /// Sets the movements of mouths with phones.
    #[must_use]
    pub fn articulation(self, articulation: ArticulationSettings) -> Options {
        Options { articulation, ..self }
    }

    /// Sets the shapes of models that a bank contains.
    #[must_use]
    pub fn rigs(self, rigs: RigSettings) -> Options {
        Options { rigs, ..self }
    }

    /// Sets the rig whose weights become ordinary curves of all clips with frames and a frame rate, for programs that do
    /// not compute weights. Curves of the files with the same names stay.
    #[must_use]
    pub fn baked_rig(self, rig: impl Into<Option<(String, Vec<WeightSpec>)>>) -> Options {
        Options { baked_rig: rig.into(), ..self }
    }

    /// Sets the conversion of emotions in texts and events to curves.
    #[must_use]
    pub fn emotions(self, emotions: EmotionOptions) -> Options {
        Options { emotions, ..self }
    }

    /// Sets the movements of faces during speech and listening.
    #[must_use]
    pub fn gestures(self, gestures: Gestures) -> Options {
        Options { gestures, ..self }
    }

    /// Sets the data about the recordings of clips for the bank, by key. Keys without a clip are ignored. Without
    /// entries, the bank has no section about recordings.
    #[must_use]
    pub fn recordings<K: Into<String>>(self, recordings: impl IntoIterator<Item = (K, Recording)>) -> Options {
        let recordings = recordings.into_iter().map(|(key, recording)| (key.into(), recording)).collect();
        Options { recordings, ..self }
    }

    /// Sets the times of the words of clips, by key, which determine changes of emotions and movements of faces.
    #[must_use]
    pub fn word_times<K: Into<String>>(self, word_times: impl IntoIterator<Item = (K, WordTimes)>) -> Options {
        let word_times = word_times.into_iter().map(|(key, times)| (key.into(), times)).collect();
        Options { word_times, ..self }
    }

    /// Sets the languages in which lines are recorded. They determine the dubs, and the texts whose emotions apply. A
    /// run checks whether the project accepts their locales.
    #[must_use]
    pub fn voices(self, voices: Voices) -> Options {
        Options { voices, ..self }
    }
}
