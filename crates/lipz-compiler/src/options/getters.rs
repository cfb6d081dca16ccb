//! What the [`Options`] of a project are.

use super::{EmotionOptions, FileLevels, Gestures, KnownNames, MinCoverage, Options, TextLimits};
use crate::babble::BabbleProfiles;
use crate::face::FaceProfileSettings;
use crate::{Voices, WordTimes};
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_diagnostics::Levels;
use std::collections::{BTreeMap, BTreeSet};

impl Options {
    /// The frame rate of files without `fps`; `None` for "unspecified".
    pub fn get_default_fps(&self) -> Option<Fps> {
        self.default_fps
    }

    /// The viseme type of files without `viseme_type`; `None` for "unspecified".
    pub fn get_default_viseme_type(&self) -> Option<VisemeType> {
        self.default_viseme_type
    }

    /// The locale of `text` elements without one.
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

    /// Threads that read and check files; `None` for one per core.
    pub fn get_threads(&self) -> Option<usize> {
        self.threads
    }

    /// Levels of lints that differ from their defaults, in all files.
    pub fn get_levels(&self) -> &Levels {
        &self.levels
    }

    /// Levels that hold for some of the files; later ones win.
    pub fn get_files_levels(&self) -> &[FileLevels] {
        &self.files_levels
    }

    /// Locales to pack; `None` for all that the files have.
    pub fn get_locales(&self) -> Option<&BTreeSet<String>> {
        self.locales.as_ref()
    }

    /// For a locale, those that its missing texts are taken from, in order.
    pub fn get_fallbacks(&self) -> &BTreeMap<String, Vec<String>> {
        &self.fallbacks
    }

    /// Whether braces are displayed as they are.
    pub fn get_literal_braces(&self) -> bool {
        self.literal_braces
    }

    /// How much text a screen holds and a player reads.
    pub fn get_text_limits(&self) -> TextLimits {
        self.text_limits
    }

    /// The names that events may mention.
    pub fn get_known_names(&self) -> &KnownNames {
        &self.known_names
    }

    /// The viseme type that clips of other types are converted to.
    pub fn get_viseme_type(&self) -> Option<VisemeType> {
        self.viseme_type
    }

    /// How much of the dialogue must be translated for a bank to be made.
    pub fn get_min_coverage(&self) -> &MinCoverage {
        &self.min_coverage
    }

    /// Whether a pseudo-locale is added.
    pub fn get_pseudo(&self) -> bool {
        self.pseudo
    }

    /// How mouths move when there is no viseme data.
    pub fn get_babble(&self) -> &BabbleProfiles {
        &self.babble
    }

    /// How faces move by themselves.
    pub fn get_faces(&self) -> &FaceProfileSettings {
        &self.faces
    }

    /// How emotions in texts and events become curves.
    pub fn get_emotions(&self) -> &EmotionOptions {
        &self.emotions
    }

    /// What faces do while something is said or heard.
    pub fn get_gestures(&self) -> Gestures {
        self.gestures
    }

    /// What the bank says about the recordings of clips, by key.
    pub fn get_recordings(&self) -> &BTreeMap<String, Recording> {
        &self.recordings
    }

    /// When the words of clips are said, by key.
    pub fn get_word_times(&self) -> &BTreeMap<String, WordTimes> {
        &self.word_times
    }

    /// The languages in which lines are recorded.
    pub fn get_voices(&self) -> &Voices {
        &self.voices
    }
}
