//! The setters of [`Options`].

use super::requirements::strings;
use super::{Emotions, Gestures, KnownNames, MinCoverage, Options, TextLimits};
use crate::babble::BabbleProfiles;
use crate::face::FaceProfiles;
use crate::{Voices, WordTimes};
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_diagnostics::Levels;

impl Options {
    /// The options of a project that decides nothing.
    #[must_use]
    pub fn new() -> Options {
        Options::default()
    }

    /// Sets the frame rate of files without `fps`.
    #[must_use]
    pub fn default_fps(self, fps: Fps) -> Options {
        Options { default_fps: Some(fps), ..self }
    }

    /// Sets the viseme type of files without `viseme_type`.
    #[must_use]
    pub fn default_viseme_type(self, viseme_type: VisemeType) -> Options {
        Options { default_viseme_type: Some(viseme_type), ..self }
    }

    /// Sets the locale of `text` elements without one, and the last resort of every locale's fallback.
    #[must_use]
    pub fn default_locale(self, tag: impl Into<String>) -> Options {
        Options { default_locale: Some(tag.into()), ..self }
    }

    /// Accepts any BCP 47 language tag, or only `ll-cc`.
    #[must_use]
    pub fn extended_locales(self, extended_locales: bool) -> Options {
        Options { extended_locales, ..self }
    }

    /// Leaves out the source section, or includes it.
    #[must_use]
    pub fn strip(self, strip: bool) -> Options {
        Options { strip, ..self }
    }

    /// Sets the number of threads.
    #[must_use]
    pub fn threads(self, count: usize) -> Options {
        Options { threads: Some(count), ..self }
    }

    /// Sets the levels of lints that differ from their defaults.
    #[must_use]
    pub fn levels(self, levels: impl Into<Levels>) -> Options {
        Options { levels: levels.into(), ..self }
    }

    /// Packs these locales only.
    #[must_use]
    pub fn locales<T: Into<String>>(self, tags: impl IntoIterator<Item = T>) -> Options {
        Options { locales: Some(strings(tags)), ..self }
    }

    /// Takes missing texts of one locale from others, in this order.
    #[must_use]
    pub fn fallback<T: Into<String>>(mut self, tag: impl Into<String>, chain: impl IntoIterator<Item = T>) -> Options {
        self.fallbacks.insert(tag.into(), chain.into_iter().map(Into::into).collect());
        self
    }

    /// Displays braces as they are, or reads them as meta information.
    #[must_use]
    pub fn literal_braces(self, literal_braces: bool) -> Options {
        Options { literal_braces, ..self }
    }

    /// Sets how much text a screen holds and a player reads.
    #[must_use]
    pub fn text_limits(self, text_limits: TextLimits) -> Options {
        Options { text_limits, ..self }
    }

    /// Sets the names that events may mention.
    #[must_use]
    pub fn known_names(self, known_names: KnownNames) -> Options {
        Options { known_names, ..self }
    }

    /// Converts clips of other viseme types to this one.
    #[must_use]
    pub fn viseme_type(self, viseme_type: VisemeType) -> Options {
        Options { viseme_type: Some(viseme_type), ..self }
    }

    /// Sets how much of the dialogue must be translated for a bank to be made.
    #[must_use]
    pub fn min_coverage(self, min_coverage: MinCoverage) -> Options {
        Options { min_coverage, ..self }
    }

    /// Adds a pseudo-locale, or does not.
    #[must_use]
    pub fn pseudo(self, pseudo: bool) -> Options {
        Options { pseudo, ..self }
    }

    /// Sets how mouths move when there is no viseme data.
    #[must_use]
    pub fn babble(self, babble: BabbleProfiles) -> Options {
        Options { babble, ..self }
    }

    /// Sets how faces move by themselves.
    #[must_use]
    pub fn faces(self, faces: FaceProfiles) -> Options {
        Options { faces, ..self }
    }

    /// Sets how emotions in texts and events become curves.
    #[must_use]
    pub fn emotions(self, emotions: Emotions) -> Options {
        Options { emotions, ..self }
    }

    /// Sets what faces do while something is said or heard.
    #[must_use]
    pub fn gestures(self, gestures: Gestures) -> Options {
        Options { gestures, ..self }
    }

    /// Sets what the bank says about the recordings of clips, by key.
    #[must_use]
    pub fn recordings<K: Into<String>>(self, recordings: impl IntoIterator<Item = (K, Recording)>) -> Options {
        let recordings = recordings.into_iter().map(|(key, recording)| (key.into(), recording)).collect();
        Options { recordings, ..self }
    }

    /// Sets when the words of clips are said, by key.
    #[must_use]
    pub fn word_times<K: Into<String>>(self, word_times: impl IntoIterator<Item = (K, WordTimes)>) -> Options {
        let word_times = word_times.into_iter().map(|(key, times)| (key.into(), times)).collect();
        Options { word_times, ..self }
    }

    /// Sets the languages in which lines are recorded.
    #[must_use]
    pub fn voices(self, voices: Voices) -> Options {
        Options { voices, ..self }
    }
}
