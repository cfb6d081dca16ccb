//! The voices of a project, and the assignment of dubs to originals.

use crate::project::LocaleError;
use crate::project::settings::{KEY, refused_pattern, without_extension};
use lipz_diagnostics::escape;
use std::collections::BTreeMap;
use std::fmt;

/// The languages in which the lines of a project are recorded, and the patterns of their clips' keys.
///
/// A clip whose key matches the pattern of a voice other than the original's is a dub of the clip with the same line.
/// With the patterns `en/{key}` and `de/{key}`, the line of `de/act1/mayor` is `act1/mayor`, and its original is
/// `en/act1/mayor`, or `act1/mayor` if there is no such clip.
///
/// ```
/// use lipz_compiler::Voices;
/// let voices = Voices::new("en-us")?.dub("de-de", "de/{key}")?;
/// assert_eq!(voices.of_key("de/act1/mayor"), Some(("de-de", "act1/mayor")));
/// assert_eq!(voices.original_of("de/act1/mayor", |key| key == "act1/mayor").as_deref(), Some("act1/mayor"));
/// assert_eq!(voices.dub_of("act1/mayor", "de-de").as_deref(), Some("de/act1/mayor"));
///
/// assert!(voices.dub("fr-fr", "fr/").is_err(), "nothing stands for the key");
/// # Ok::<(), lipz_compiler::VoiceError>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Voices {
    /// The locale of the original recordings. Without it, no clip is a dub.
    pub original: Option<String>,
    /// The pattern of the keys in each voice, by locale. If that of the original is missing, its keys are lines.
    pub patterns: BTreeMap<String, String>,
}

impl Voices {
    /// Creates the voices of a project with original recordings in this locale.
    ///
    /// # Errors
    /// If the tag is not a BCP 47 language tag. A run checks at its start whether the project accepts the tag.
    pub fn new(original: impl AsRef<str>) -> Result<Voices, VoiceError> {
        let original = LocaleError::check(original.as_ref(), true)?;
        Ok(Voices { original: Some(original), patterns: BTreeMap::new() })
    }

    /// Adds a voice: its locale, and the pattern of the keys of its clips, with `{key}` for the line. The extension of
    /// a recording is not part of a key. Add the pattern of the original in the same way.
    ///
    /// # Errors
    /// If the tag is not a BCP 47 language tag, or if the pattern does not contain `{key}` exactly once or leads out of
    /// its folder.
    pub fn dub(mut self, locale: impl AsRef<str>, pattern: impl Into<String>) -> Result<Voices, VoiceError> {
        let (locale, pattern) = (LocaleError::check(locale.as_ref(), true)?, pattern.into());
        if let Some((why, help)) = refused_pattern(&pattern) {
            return Err(VoiceError::Pattern { pattern, why, help });
        }
        self.patterns.insert(locale, pattern);
        Ok(self)
    }

    /// Returns the voice whose pattern this key matches, and the line, which is the rest of the key: `de-de/act1/mayor`
    /// is `act1/mayor` in de-de. The longest pattern takes precedence. A pattern that consists only of the key is
    /// ignored.
    pub fn of_key<'p, 'k>(&'p self, key: &'k str) -> Option<(&'p str, &'k str)> {
        let fit = |(locale, pattern): (&'p String, &'p String)| {
            let (before, after) = without_extension(pattern).split_once(KEY)?;
            let line = key.strip_prefix(before)?.strip_suffix(after).filter(|line| !line.is_empty())?;
            let is_one = !before.is_empty() || !after.is_empty();
            is_one.then_some((pattern.len(), locale.as_str(), line))
        };
        let found = self.patterns.iter().filter_map(fit).max_by_key(|(length, ..)| *length);
        found.map(|(_, locale, line)| (locale, line))
    }

    /// Returns the spoken locale of the clip with this key: that of its voice, or else of the original.
    pub fn locale_of(&self, key: &str) -> Option<&str> {
        self.of_key(key).map(|(locale, _)| locale).or(self.original.as_deref())
    }

    /// Returns the key of the original of a dub. `is_there` states which keys exist.
    pub fn original_of(&self, key: &str, is_there: impl Fn(&str) -> bool) -> Option<String> {
        let line = self.dubbed_line(key)?;
        self.originals_of(line).into_iter().find(|original| is_there(original))
    }

    /// Returns the line of the clip with this key, if the clip is to be a dub.
    pub(crate) fn dubbed_line<'k>(&self, key: &'k str) -> Option<&'k str> {
        let original = self.original.as_deref()?;
        self.of_key(key).filter(|(locale, _)| *locale != original).map(|(_, line)| line)
    }

    /// Returns the line of the clip with this key in any voice: the part that the keys of an original and of its dubs
    /// have in common.
    #[cfg(feature = "shards")]
    pub(crate) fn line_of<'k>(&self, key: &'k str) -> &'k str {
        let line = self.original.as_ref().and_then(|_| self.of_key(key));
        line.map_or(key, |(_, line)| line)
    }

    /// Returns the possible keys of a line's original, the most likely first.
    pub(crate) fn originals_of(&self, line: &str) -> Vec<String> {
        let by_pattern = self.original.as_deref().and_then(|original| self.key_of(line, original));
        let keys = by_pattern.into_iter().chain([line.to_owned()]);
        let is_original = |key: &String| self.dubbed_line(key).is_none();
        let mut keys: Vec<String> = keys.filter(is_original).collect();
        keys.dedup();
        keys
    }

    /// Returns the key of an original's dub in a voice; `None` if the project lacks this voice, or if it has no
    /// pattern.
    pub fn dub_of(&self, original: &str, locale: &str) -> Option<String> {
        let line = self.of_key(original).map_or(original, |(_, line)| line);
        self.key_of(line, locale).filter(|key| self.of_key(key) == Some((locale, line)))
    }

    /// Returns the key of a line in a voice that has a pattern.
    fn key_of(&self, line: &str, locale: &str) -> Option<String> {
        self.patterns.get(locale).map(|pattern| without_extension(pattern).replace(KEY, line))
    }

    /// Returns the locales of the voices, with that of the original first; none if no clip can be a dub.
    pub(crate) fn locales(&self) -> impl Iterator<Item = &str> {
        let dubs = self.patterns.keys().map(String::as_str);
        let original = self.original.as_deref();
        original
            .into_iter()
            .flat_map(move |original| std::iter::once(original).chain(dubs.clone().filter(move |dub| *dub != original)))
    }
}

/// The reason why a voice is invalid.
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum VoiceError {
    /// Its tag is not a locale.
    Locale(LocaleError),
    /// Its pattern is not valid for keys.
    Pattern {
        /// The pattern.
        pattern: String,
        /// The problem: `does not name {key} once`.
        why: &'static str,
        /// The help.
        help: &'static str,
    },
}

impl From<LocaleError> for VoiceError {
    fn from(error: LocaleError) -> VoiceError {
        VoiceError::Locale(error)
    }
}

impl fmt::Display for VoiceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            VoiceError::Locale(error) => write!(f, "{error}"),
            VoiceError::Pattern { pattern, why, help } => {
                write!(f, "the pattern {} {why}: {help}", escape::quoted(pattern))
            }
        }
    }
}

/// The same text, because a `main` that returns the error prints it this way.
impl fmt::Debug for VoiceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for VoiceError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voices_are_checked_where_they_are_set() {
        assert_eq!(
            Voices::new("english").unwrap_err().to_string(),
            "`english` is not a BCP 47 language tag: name a language, with a script and a region where needed: en-us, es-419, zh-hant"
        );
        let voices = Voices::new("en_US").unwrap();
        assert_eq!(voices.original.as_deref(), Some("en-us"));
        assert_eq!(
            voices.clone().dub("de-de", "de/").unwrap_err().to_string(),
            "the pattern `de/` does not contain {key} exactly once: write {key} once, for the key of the clip: \
                en-us/{key}"
        );
        assert!(voices.clone().dub("deutsch!", "de/{key}").is_err());
        assert!(voices.dub("de-de", "../{key}").unwrap_err().to_string().contains("leads out of the folder"));
    }

    #[test]
    fn originals_have_the_pattern_of_their_voice_or_are_lines() {
        let voices = Voices::new("en-us")
            .unwrap()
            .dub("en-us", "en/{key}")
            .unwrap()
            .dub("de-de", "de/{key}.ogg")
            .unwrap()
            .dub("fr-fr", "{key}_fr")
            .unwrap();
        let all = |_: &str| true;
        assert_eq!(voices.original_of("de/a", all).as_deref(), Some("en/a"));
        assert_eq!(voices.original_of("de/a", |key| key == "a").as_deref(), Some("a"));
        assert_eq!(voices.original_of("de/a", |_| false), None);
        assert_eq!(voices.original_of("a_fr", all).as_deref(), Some("en/a"));
        assert_eq!((voices.original_of("en/a", all), voices.original_of("a", all)), (None, None));
        assert_eq!(voices.original_of("de/de/a", |key| key == "de/a"), None, "a dub is no original");
        assert_eq!(voices.dub_of("en/a", "de-de").as_deref(), Some("de/a"));
        assert_eq!(voices.dub_of("a", "fr-fr").as_deref(), Some("a_fr"));
        assert_eq!(voices.dub_of("a", "it-it"), None);
        assert!(voices.locales().eq(["en-us", "de-de", "fr-fr"]));
    }

    #[test]
    fn without_an_original_nothing_is_a_dub() {
        let voices = Voices { original: None, ..Voices::new("en-us").unwrap().dub("de-de", "de/{key}").unwrap() };
        assert_eq!((voices.of_key("de/a"), voices.original_of("de/a", |_| true)), (Some(("de-de", "a")), None));
        assert_eq!(voices.locales().count(), 0);
        assert_eq!(
            Voices::new("en-us").unwrap().dub("de-de", "{key}").unwrap().dub_of("a", "de-de"),
            None,
            "it would be the original"
        );
    }
}
