//! Conversion of a clip to a unit: its texts, and information for translators.

use crate::exchange::clip_texts::{strings, texts_of, trimmed};
use crate::exchange::model::{Segment, State, Translation, Unit};
use crate::exchange::variants::{ClipSources, VariantKey, keys_of_all, variant_keys};
use lipz_diagnostics::{Code, Diagnostic, Severity, escape};
use lipz_file::locale::{is_variant, variant_tag};
use lipz_file::rate::Rate;
use lipz_file::text::{DELIMITER, is_white_space, speakers};
use lipz_file::{Document, Value};

/// Converts clips to units.
///
/// ```
/// use lipz_texts::Collect;
/// let clip = br#"{ "fps": 4, "visemes": "MA--|EO", "text_en-us": "{speaker: Mara} Hi. |You?", "text_de-de": "Hallo. |Du?" }"#;
/// let clip = lipz_file::parse(clip).document.ok_or("a valid file")?;
/// let unit = Collect::new("en-us", ["de-de"]).unit("mara", &clip, &mut Vec::new()).ok_or("a text")?;
/// assert_eq!(unit.segments[1].speaker.as_deref(), Some("Mara"));
/// assert_eq!(unit.segments[1].time_ms, Some((1000, 1500)));
/// assert_eq!(unit.translations[0].texts, ["Hallo.", "Du?"]);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Collect {
    source_locale: String,
    locales: Vec<String>,
    default_locale: Option<String>,
    default_rate: Option<Rate>,
    screen_characters: Option<usize>,
    characters_per_second: Option<f64>,
}

impl Collect {
    /// Returns a collector for texts in a source locale, and their translations into other locales.
    pub fn new<T: Into<String>>(source_locale: impl Into<String>, locales: impl IntoIterator<Item = T>) -> Collect {
        let locales = locales.into_iter().map(Into::into).collect();
        Collect { source_locale: source_locale.into(), locales, ..Collect::default() }
    }

    /// Sets the locale of `text` without a locale.
    #[must_use]
    pub fn default_locale(self, locale: Option<String>) -> Collect {
        Collect { default_locale: locale, ..self }
    }

    /// Sets the frame rate of files without `fps`.
    #[must_use]
    pub fn default_rate(self, rate: Option<Rate>) -> Collect {
        Collect { default_rate: rate, ..self }
    }

    /// Sets the number of characters that fit on a screen, and the number that a player reads per second.
    #[must_use]
    pub fn limits(self, screen_characters: Option<usize>, characters_per_second: Option<f64>) -> Collect {
        Collect { screen_characters, characters_per_second, ..self }
    }

    /// Returns the unit of a clip; `None` if it has no text to translate. A translation with a different number of
    /// segments is reported and skipped.
    pub fn unit(&self, key: &str, clip: &Document<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Unit> {
        let strings = strings(clip, self.default_locale.as_deref());
        let source = strings.get(&self.source_locale)?;
        let sources = trimmed(&source.text);
        if sources.iter().all(String::is_empty) {
            return None;
        }
        let translation = |locale: &String| {
            let texts = strings.get(locale).map(|text| (trimmed(&text.text), text.span()));
            let texts = match texts {
                Some((texts, _)) if texts.len() == sources.len() => texts,
                Some((texts, span)) => {
                    let (has, needs) = (texts.len(), sources.len());
                    let message = format!(
                        "the text in {locale} has {has} segments, but the text in {} has {needs}",
                        self.source_locale
                    );
                    let mut diagnostic = Diagnostic::at(Code::TextSegments, span, message)
                        .note("the exchange file has no translation for it")
                        .help("put a `|` into both texts where the segments meet");
                    // All other texts are exported.
                    diagnostic.severity = Severity::Warning;
                    diagnostics.push(diagnostic);
                    vec![String::new(); sources.len()]
                }
                None => vec![String::new(); sources.len()],
            };
            let state = if texts.iter().all(String::is_empty) { State::Initial } else { State::Translated };
            Translation { texts, state, ..Translation::default() }
        };
        let translations = self.locales.iter().map(translation).collect();
        Some(Unit { key: key.to_owned(), segments: self.segments(clip, &sources), translations, ..Unit::default() })
    }

    /// Returns the units of the clip's variants: those of the source, and those that one of the locales needs or has.
    pub fn variants(&self, unit: &Unit, clip: &Document<'_>) -> Vec<Unit> {
        let texts = texts_of(clip, self.default_locale.as_deref());
        if !texts.keys().any(|tag| is_variant(tag)) {
            return Vec::new();
        }
        let of_locales: Vec<Vec<VariantKey>> =
            self.locales.iter().map(|locale| variant_keys(&texts, &self.source_locale, locale)).collect();
        let Some(sources_of) = ClipSources::new(&texts, &self.source_locale) else { return Vec::new() };
        let variant = |key: String| {
            let sources = sources_of.of(&variant_tag(&self.source_locale, &key));
            let segment = |(whole, source): (&Segment, &String)| match source.is_empty() {
                true => Segment::default(),
                false => Segment { source: source.clone(), ..whole.clone() },
            };
            let translation = |(locale, keys): (&String, &Vec<VariantKey>)| {
                let own = texts.get(&variant_tag(locale, &key)).filter(|own| own.len() == sources.texts.len());
                let is_unneeded = keys.iter().all(|known| known.key != key);
                let state = if own.is_none() { State::Initial } else { State::Translated };
                let texts = own.cloned().unwrap_or_else(|| vec![String::new(); sources.texts.len()]);
                Translation { texts, state, is_unneeded, ..Translation::default() }
            };
            let segments = unit.segments.iter().zip(&*sources.texts).map(segment).collect();
            let translations = self.locales.iter().zip(&of_locales).map(translation).collect();
            Unit { key: unit.key.clone(), variant: Some(key), segments, translations, ..Unit::default() }
        };
        keys_of_all(&texts, &self.source_locale, &of_locales).into_iter().map(variant).collect()
    }

    fn segments(&self, clip: &Document<'_>, sources: &[String]) -> Vec<Segment> {
        let events = clip.string("events").map(trimmed).filter(|events| events.len() == sources.len());
        let times = self.times(clip).filter(|times| times.len() == sources.len());
        let mut speaker = None;
        let mut all = Vec::with_capacity(sources.len());
        for (number, source) in sources.iter().enumerate() {
            speaker = speaker_in(source).or(speaker);
            if source.is_empty() {
                all.push(Segment::default());
                continue;
            }
            let time_ms = times.as_ref().and_then(|times| times.get(number).copied());
            all.push(Segment {
                source: source.clone(),
                speaker: speaker.clone(),
                events: events.as_ref().and_then(|all| all.get(number)).filter(|events| !events.is_empty()).cloned(),
                time_ms,
                max_characters: self.max_characters(time_ms),
            });
        }
        all
    }

    /// Returns the start and the end of each segment, in milliseconds.
    fn times(&self, clip: &Document<'_>) -> Option<Vec<(u64, u64)>> {
        let rate = match clip.get("fps").map(|fps| &fps.value) {
            Some(Value::Number(number)) => lipz_file::rate::parse(&number.text),
            Some(_) => None,
            None => self.default_rate,
        }?;
        // Rounded to the nearest millisecond.
        let frames = u64::from(rate.numerator.max(1));
        let ms = |frame: u64| (frame.saturating_mul(u64::from(rate.denominator) * 1000) + frames / 2) / frames;
        let mut start = 0;
        let times = clip.string("visemes")?.split(DELIMITER).map(|codes| {
            let frames = codes.chars().filter(|&code| !is_white_space(code)).count() as u64;
            let time = (ms(start), ms(start + frames));
            start += frames;
            time
        });
        Some(times.collect())
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a clip is short"
    )]
    fn max_characters(&self, time_ms: Option<(u64, u64)>) -> Option<usize> {
        let readable = time_ms
            .zip(self.characters_per_second)
            .map(|((start, end), per_second)| ((end.saturating_sub(start)) as f64 / 1000.0 * per_second) as usize);
        match (readable, self.screen_characters) {
            (Some(readable), Some(screen)) => Some(readable.min(screen)),
            (readable, screen) => readable.or(screen),
        }
    }
}

/// Returns the speaker at the end of a text, if it names one.
fn speaker_in(text: &str) -> Option<String> {
    speakers(text).last().filter(|name| !name.is_empty()).map(|name| escape::text(name).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn collected(file: &str) -> (Option<Unit>, usize) {
        let document = lipz_file::parse(file.as_bytes()).document.unwrap();
        let mut found = Vec::new();
        let collect = Collect::new("en-us", ["de-de"]).default_locale(Some("en-us".into()));
        let collect = collect.limits(Some(80), Some(10.0));
        (collect.unit("a", &document, &mut found), found.len())
    }

    #[test]
    fn clips_without_a_text_have_no_unit() {
        for file in [r#"{"visemes": "M"}"#, r#"{"text_de-de": "Ja."}"#, r#"{"text_en-us": " | "}"#] {
            assert_eq!(collected(file), (None, 0), "{file}");
        }
    }

    #[test]
    fn a_translation_of_another_shape_is_reported() {
        let (unit, found) = collected(r#"{"text": "a|b", "text_de-de": "a"}"#);
        assert_eq!((unit.unwrap().translations[0].texts.concat(), found), (String::new(), 1));
    }

    #[test]
    fn limits_are_those_of_screen_and_time() {
        let (unit, _) = collected(r#"{"fps": 1, "visemes": "MA|MMMMMMMMMMMM", "events": "x|", "text": "a|b"}"#);
        let segments = unit.unwrap().segments;
        assert_eq!(segments.iter().map(|segment| segment.max_characters).collect::<Vec<_>>(), [Some(20), Some(80)]);
        assert_eq!(segments[0].events.as_deref(), Some("x"));
        assert_eq!(segments[1].events, None);
    }
}
