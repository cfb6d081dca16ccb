//! The getters of [`Options`].

use super::{EmotionOptions, FileLevels, Gestures, KnownNames, MinCoverage, Options, TextLimits};
use crate::project::articulation::ArticulationSettings;
use crate::project::babble::BabbleProfiles;
use crate::project::face::FaceProfileSettings;
use crate::project::rigs::RigSettings;
use crate::project::{Voices, WordTimes};
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_diagnostics::Levels;
use lipz_file::locale::{language, split_variant};
use std::collections::{BTreeMap, BTreeSet};

impl Options {
    /// Returns the frame rate of files without `fps`; `None` for "unspecified".
    pub fn get_default_fps(&self) -> Option<Fps> {
        self.default_fps
    }

    /// Returns the viseme type of files without `viseme_type`; `None` for "unspecified".
    pub fn get_default_viseme_type(&self) -> Option<VisemeType> {
        self.default_viseme_type
    }

    /// Returns the locale of `text` elements without one.
    pub fn get_default_locale(&self) -> Option<&str> {
        self.default_locale.as_deref()
    }

    /// Whether any BCP 47 language tag is accepted, not only `ll-cc`.
    pub fn get_extended_locales(&self) -> bool {
        self.extended_locales
    }

    /// Whether the source section is left out.
    pub fn get_strip(&self) -> bool {
        self.strip
    }

    /// Returns the number of threads that read and check files; `None` for one per core.
    pub fn get_threads(&self) -> Option<usize> {
        self.threads
    }

    /// Returns the levels of lints that differ from their defaults, in all files.
    pub fn get_levels(&self) -> &Levels {
        &self.levels
    }

    /// Returns the levels for some of the files. Later ones take precedence.
    pub fn get_files_levels(&self) -> &[FileLevels] {
        &self.files_levels
    }

    /// Returns the locales to pack; `None` for all locales of the files.
    pub fn get_locales(&self) -> Option<&BTreeSet<String>> {
        self.locales.as_ref()
    }

    /// Returns for a locale those that replace its missing texts, in order.
    pub fn get_fallbacks(&self) -> &BTreeMap<String, Vec<String>> {
        &self.fallbacks
    }

    /// Whether braces are displayed unchanged.
    pub fn get_literal_braces(&self) -> bool {
        self.literal_braces
    }

    /// Returns the limits of texts on a screen, and of reading speed.
    pub fn get_text_limits(&self) -> TextLimits {
        self.text_limits
    }

    /// Returns the limits of texts in a locale, or in a variant of it.
    pub fn get_text_limits_of(&self, locale: &str) -> TextLimits {
        let (locale, _) = split_variant(locale);
        let of = |tag: &str| self.locale_limits.get(tag).copied().unwrap_or_default();
        match self.locale_limits.is_empty() {
            true => self.text_limits,
            false => of(locale).or(of(language(locale))).or(self.text_limits),
        }
    }

    /// Returns the names that events may use.
    pub fn get_known_names(&self) -> &KnownNames {
        &self.known_names
    }

    /// Returns the viseme type that clips of other types are converted to.
    pub fn get_viseme_type(&self) -> Option<VisemeType> {
        self.viseme_type
    }

    /// Returns the share of the dialogue that must be translated for a bank to be made.
    pub fn get_min_coverage(&self) -> &MinCoverage {
        &self.min_coverage
    }

    /// Whether a pseudo-locale is added.
    pub fn get_pseudo(&self) -> bool {
        self.pseudo
    }

    /// Returns the mouth movement without viseme data.
    pub fn get_babble(&self) -> &BabbleProfiles {
        &self.babble
    }

    /// Returns the spontaneous movements of faces.
    pub fn get_faces(&self) -> &FaceProfileSettings {
        &self.faces
    }

    /// Returns the movements of mouths with phones.
    pub fn get_articulation(&self) -> &ArticulationSettings {
        &self.articulation
    }

    /// Returns the shapes of models that a bank contains.
    pub fn get_rigs(&self) -> &RigSettings {
        &self.rigs
    }

    /// Returns the conversion of emotions in texts and events to curves.
    pub fn get_emotions(&self) -> &EmotionOptions {
        &self.emotions
    }

    /// Returns the movements of faces during speech and listening.
    pub fn get_gestures(&self) -> Gestures {
        self.gestures
    }

    /// Returns the data about the recordings of clips for the bank, by key.
    pub fn get_recordings(&self) -> &BTreeMap<String, Recording> {
        &self.recordings
    }

    /// Returns the times of the words of clips, by key.
    pub fn get_word_times(&self) -> &BTreeMap<String, WordTimes> {
        &self.word_times
    }

    /// Returns the languages in which lines are recorded.
    pub fn get_voices(&self) -> &Voices {
        &self.voices
    }
}
