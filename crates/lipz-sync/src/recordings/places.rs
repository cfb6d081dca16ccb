//! The paths of a clip's recordings in each language, from the patterns of a project.

use lipz_compiler::Voices;
use lipz_compiler::settings::{KEY, Settings, without_extension};

/// The patterns of a project.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct RecordingPlaces {
    /// The pattern of a project without voices; `None` stands for the key.
    pattern: Option<String>,
    /// The spoken locale of all clips without a voice, and the patterns of the voices.
    pub(crate) voices: Voices,
}

/// The path of a recording: a pattern, and the replacement of `{key}`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct RecordingPlace<'p, 'k> {
    /// The locale of the voice; `None` for a recording without a voice.
    pub(crate) locale: Option<&'p str>,
    pattern: &'p str,
    key: &'k str,
}

impl RecordingPlaces {
    pub(crate) fn new(settings: &Settings) -> RecordingPlaces {
        RecordingPlaces { pattern: settings.audio.pattern.clone(), voices: settings.voices() }
    }

    /// Returns the places of a project without voices.
    #[cfg(test)]
    pub(crate) fn of_pattern(pattern: Option<&str>) -> RecordingPlaces {
        RecordingPlaces { pattern: pattern.map(str::to_owned), ..RecordingPlaces::default() }
    }

    /// Whether every pattern states the extension of its recordings.
    pub(crate) fn name_an_extension(&self) -> bool {
        let mut patterns = self.pattern.iter().chain(self.voices.patterns.values()).peekable();
        patterns.peek().is_some() && patterns.all(|pattern| without_extension(pattern).len() < pattern.len())
    }

    /// Returns the voice whose pattern matches this key, with the rest of the key.
    pub(crate) fn voice_of<'p, 'k>(&'p self, key: &'k str) -> Option<RecordingPlace<'p, 'k>> {
        let (locale, line) = self.voices.of_key(key)?;
        let pattern = self.voices.patterns.get(locale)?;
        Some(RecordingPlace { locale: Some(locale), pattern, key: line })
    }

    /// Returns the place of the recording for the clip's visemes.
    pub(crate) fn of<'p, 'k>(&'p self, key: &'k str) -> RecordingPlace<'p, 'k> {
        let spoken = || {
            let (locale, pattern) = self.voices.patterns.get_key_value(self.voices.original.as_deref()?)?;
            Some(RecordingPlace { locale: Some(locale), pattern, key })
        };
        let only = || RecordingPlace { locale: None, pattern: self.pattern.as_deref().unwrap_or(KEY), key };
        self.voice_of(key).or_else(spoken).unwrap_or_else(only)
    }

    /// Returns the places of the clip's recordings in the other languages; none for a clip whose key is that of one
    /// voice.
    pub(crate) fn dubs<'p, 'k>(&'p self, key: &'k str) -> impl Iterator<Item = RecordingPlace<'p, 'k>> + use<'p, 'k> {
        let spoken = self.of(key).locale;
        let voices = self.voices.patterns.iter().filter(move |_| self.voice_of(key).is_none());
        let others = voices.filter(move |(locale, _)| Some(locale.as_str()) != spoken);
        others.map(move |(locale, pattern)| RecordingPlace { locale: Some(locale), pattern, key })
    }
}

impl<'p> RecordingPlace<'p, '_> {
    /// Returns the path below the folder of recordings without its extension, and the extension if the pattern states
    /// it.
    pub(crate) fn path(&self) -> (String, Option<&'p str>) {
        let stem = without_extension(self.pattern);
        (stem.replace(KEY, self.key), self.pattern.get(stem.len() + 1..))
    }

    /// Returns the path for messages.
    pub(crate) fn shown(&self) -> String {
        self.pattern.replace(KEY, self.key)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn places(locale: Option<&str>, voices: &[(&str, &str)]) -> RecordingPlaces {
        let mut original = Voices::default();
        original.original = locale.map(str::to_owned);
        let voices = voices.iter().fold(original, |voices, (locale, pattern)| voices.dub(locale, *pattern).unwrap());
        RecordingPlaces { pattern: None, voices }
    }

    /// Returns the place of the clip's own recording, and those of the dubs, with their locales.
    fn all(places: &RecordingPlaces, key: &str) -> Vec<String> {
        let shown = |place: RecordingPlace<'_, '_>| format!("{} {}", place.locale.unwrap_or("-"), place.shown());
        std::iter::once(places.of(key)).chain(places.dubs(key)).map(shown).collect()
    }

    #[test]
    fn a_folder_of_clips_for_each_language() {
        let places = places(Some("en-us"), &[("en-us", "en-us/{key}"), ("de-de", "de/{key}.ogg")]);
        assert_eq!(all(&places, "en-us/act1/mayor"), ["en-us en-us/act1/mayor"]);
        assert_eq!(all(&places, "de/act1/mayor"), ["de-de de/act1/mayor.ogg"]);
        assert_eq!(places.of("de/x").path(), ("de/x".to_owned(), Some("ogg")));
        assert_eq!(places.of("en-us/a.b").path(), ("en-us/a.b".to_owned(), None));
    }

    #[test]
    fn one_clip_with_recordings_in_several_languages() {
        let places = places(Some("en-us"), &[("en-us", "{key}"), ("de-de", "{key}_de"), ("fr-fr", "fr/{key}")]);
        assert_eq!(all(&places, "act1/mayor"), ["en-us act1/mayor", "de-de act1/mayor_de", "fr-fr fr/act1/mayor"]);
        assert_eq!(all(&places, "fr/mayor"), ["fr-fr fr/mayor"]);
    }

    #[test]
    fn without_a_voice_in_the_spoken_locale_the_pattern_counts() {
        let mut places = places(Some("en-us"), &[("de-de", "de/{key}")]);
        assert_eq!(all(&places, "mayor"), ["- mayor", "de-de de/mayor"]);
        places.pattern = Some("en/{key}.wav".to_owned());
        assert_eq!(all(&places, "mayor"), ["- en/mayor.wav", "de-de de/mayor"]);
        assert_eq!(all(&RecordingPlaces::default(), "a.wav/{key}"), ["- a.wav/{key}"]);
    }
}
