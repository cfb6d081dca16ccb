//! Lints of translations that are stale, or differ in content from their source, and of texts in a font.

mod characters;
mod font;
mod glyphs;
mod numbers;
mod numerals;
mod punctuation;
mod same;
mod stale;
mod terms;
mod variants;

pub use font::{Font, FontError};
pub use glyphs::{FontLimit, LinePixels, check_glyphs};
pub use terms::Terms;

use crate::exchange::clip_texts::{tag_of, trimmed};
use crate::exchange::{ClipSources, SourceTexts, markup, placeholder, texts_of};
use crate::record::TextRecord;
use characters::OddPlace;
use lipz_diagnostics::{Code, Diagnostic, Span, bound};
use lipz_file::locale::{language, split_variant};
use lipz_file::placeholder::PlaceholderPattern;
use lipz_file::text;
use lipz_file::{Document, JsonString, Value};
use std::collections::HashMap;

/// The most diagnostics of one kind that are listed for a text. The rest are counted.
const SHOWN: usize = 3;

/// Compares translations with their source texts, in one Lipz file.
///
/// ```
/// use lipz_texts::TextLints;
/// let clip = br#"{ "text_en-us": "Take 15 shoes, {name}!", "text_de-de": "Nimm 50 Schuhe, {nmae}!" }"#;
/// let clip = lipz_file::parse(clip).document.ok_or("a valid file")?;
/// let mut found = Vec::new();
/// TextLints::new("en-us").check("mara.lipz", &clip, &mut found);
/// let messages: Vec<&str> = found.iter().map(|diagnostic| diagnostic.message.as_str()).collect();
/// assert_eq!(messages, [
///     "the translation has `{nmae}` instead of `{name}`",
///     "the translation has the number 50 instead of 15",
/// ]);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug)]
pub struct TextLints<'r> {
    source_locale: String,
    default_locale: Option<String>,
    record: Option<&'r TextRecord>,
    terms: Option<&'r Terms>,
    placeholders: &'r [PlaceholderPattern],
}

impl<'r> TextLints<'r> {
    /// Returns lints of translations from this locale.
    pub fn new(source_locale: impl Into<String>) -> TextLints<'r> {
        TextLints {
            source_locale: source_locale.into(),
            default_locale: None,
            record: None,
            terms: None,
            placeholders: &[],
        }
    }

    /// Sets the locale of `text` without a locale.
    #[must_use]
    pub fn default_locale(self, locale: Option<String>) -> Self {
        TextLints { default_locale: locale, ..self }
    }

    /// Sets the record of the translations' source texts. Without it, stale translations are not reported.
    #[must_use]
    pub fn record(self, record: Option<&'r TextRecord>) -> Self {
        TextLints { record, ..self }
    }

    /// Sets the terms of the project, whose translations every text must contain.
    #[must_use]
    pub fn terms(self, terms: Option<&'r Terms>) -> Self {
        TextLints { terms, ..self }
    }

    /// Sets the patterns of the project's own placeholders, which translations repeat.
    #[must_use]
    pub fn placeholders(self, placeholders: &'r [PlaceholderPattern]) -> Self {
        TextLints { placeholders, ..self }
    }

    /// Reports the problems of a clip's translations. `file` is the path of its Lipz file in the record.
    pub fn check(&self, file: &str, clip: &Document<'_>, diagnostics: &mut Vec<Diagnostic>) {
        let before = diagnostics.len();
        let all: Vec<LocaleText<'_>> = self.texts(clip).collect();
        let mut by_locale: HashMap<&str, &LocaleText<'_>> = HashMap::new();
        for text in &all {
            odd_characters(text, diagnostics);
            by_locale.entry(&text.locale).or_insert(text);
        }
        let others = self.record.map(|record| record.source_locales_of(file)).unwrap_or_default();
        let others = others.into_iter().filter(|locale| *locale != self.source_locale);
        let texts = texts_of(clip, self.default_locale.as_deref());
        for source_locale in others.chain([self.source_locale.as_str()]) {
            let Some(sources) = ClipSources::new(&texts, source_locale) else { continue };
            let is_translation = |text: &&LocaleText<'_>| split_variant(&text.locale).0 != source_locale;
            for translation in all.iter().filter(is_translation) {
                let from = sources.of(&translation.locale);
                let written = by_locale.get(&*from.locale).or_else(|| by_locale.get(source_locale));
                let Some(LocaleText { name, string, .. }) = written else { continue };
                let (locale, segments) = (from.locale.to_string(), from.texts.to_vec());
                let source = LocaleText { locale, name: name.clone(), string, segments };
                if translation.segments.len() != source.segments.len() {
                    continue; // reported separately
                }
                if let Some(record) = self.record {
                    stale::check(record, file, &source, translation, diagnostics);
                }
                // A translation should match the text in the project's own locale, whichever its source was.
                if source_locale == self.source_locale {
                    self.compare(&from, &source, translation, diagnostics);
                    variants::check(&texts, &sources, source_locale, translation, diagnostics);
                }
                bound::limit_many(diagnostics);
            }
        }
        if diagnostics.len() > before {
            bound::limit(diagnostics);
        }
    }

    /// Reports translations whose content differs from the source, in segments that both have.
    fn compare(
        &self,
        from_texts: &SourceTexts<'_>,
        source: &LocaleText<'_>,
        translation: &LocaleText<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let locale = split_variant(&translation.locale).0;
        let is_other_language = language(&source.locale) != language(&translation.locale);
        let mut found: [FewDiagnostics; 7] = Default::default();
        let [same, placeholders, metas, tags, numbers, of_terms, ends] = &mut found;
        let numbers_differ = numbers::differ(&source.segments, &translation.segments);
        let pairs = source.segments.iter().zip(&translation.segments).enumerate();
        for (at, (from, to)) in pairs.filter(|(_, (from, to))| !from.is_empty() && !to.is_empty()) {
            let differs = |code, message: String, label: &str, help: &str| {
                let diagnostic = Diagnostic::at(code, translation.span(at, None), message);
                diagnostic.also(source.span(at, None), label).help(help)
            };
            if is_other_language && from == to && same::is_suspicious(from) {
                let message = format!("the text in {} is the same as in {}", translation.locale, source.locale);
                let help = "translate it, or remove the element, so that the fallback applies and the coverage counts it \
                as missing";
                same.add(|| differs(Code::UntranslatedText, message, "the same text", help));
            }
            if let Some(message) = from_texts.placeholder_difference(at, to, self.placeholders) {
                placeholders.add(|| differs(Code::Placeholder, message, "the source", placeholder::HELP));
            }
            if let Some(message) = placeholder::meta_difference(from, to) {
                metas.add(|| differs(Code::MetaDiffers, message, "the source", placeholder::META_HELP));
            }
            if let Some(message) = markup::difference(from, to) {
                tags.add(|| differs(Code::MarkupDiffers, message, "the source", markup::HELP));
            }
            if let Some(message) = numbers_differ.then(|| numbers::difference(from, to)).flatten() {
                let help = "compare the texts, and correct one of the two";
                numbers.add(|| differs(Code::NumbersDiffer, message, "the source", help));
            }
            if let Some(message) = self.terms.and_then(|terms| terms.difference(from, locale, to)) {
                let help = "use the term, or add this translation to the table of terms";
                of_terms.add(|| differs(Code::TermMissing, message, "the source", help));
            }
            if let Some(message) = punctuation::difference([from, &source.locale], [to, locale]) {
                ends.add(|| differs(Code::EndPunctuation, message, "the source", punctuation::HELP));
            }
        }
        for of_kind in found {
            of_kind.report(diagnostics);
        }
    }

    fn texts<'d>(&'d self, clip: &'d Document<'_>) -> impl Iterator<Item = LocaleText<'d>> {
        texts(clip, self.default_locale.as_deref())
    }
}

/// Returns the texts of a clip. `text` without a locale is in `default_locale`.
fn texts<'d>(clip: &'d Document<'_>, default_locale: Option<&'d str>) -> impl Iterator<Item = LocaleText<'d>> {
    clip.elements.iter().filter_map(move |element| {
        let locale = tag_of(&element.name.text, default_locale)?;
        let Value::String(string) = &element.value else { return None };
        Some(LocaleText { name: locale.clone(), locale, string, segments: trimmed(&string.text) })
    })
}

/// A text of a clip.
struct LocaleText<'d> {
    /// The locale, with the key of the variant whose texts these are.
    locale: String,
    /// The locale, or the variant, in the name of the element.
    name: String,
    string: &'d JsonString<'d>,
    /// Its segments, trimmed.
    segments: Vec<String>,
}

impl LocaleText<'_> {
    /// Returns the span of a segment without surrounding whitespace, or of a range of its bytes.
    fn span(&self, segment: usize, range: Option<std::ops::Range<usize>>) -> Span {
        let Some(whole) = text::segments(&self.string.text).nth(segment) else { return self.string.span() };
        let shown = self.string.text.get(whole.clone()).unwrap_or_default();
        let blank = shown.len() - shown.trim_start_matches(text::is_white_space).len();
        let start = whole.start + blank;
        let range = range.unwrap_or(0..text::trim(shown).len());
        self.string.span_of(start + range.start..start + range.end)
    }
}

/// Reports the segments of a text with characters that it should not contain.
fn odd_characters(text: &LocaleText<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let mut found = FewDiagnostics::default();
    for (at, segment) in text.segments.iter().enumerate() {
        if let Some(OddPlace { range, message, help }) = characters::odd(segment, split_variant(&text.locale).0) {
            found.add(|| Diagnostic::at(Code::OddCharacters, text.span(at, Some(range)), message).help(help));
        }
    }
    found.report(diagnostics);
}

/// Diagnostics of one kind about one text: the first few, and their number. The rest are not created, because computing
/// each position takes as long as the text.
#[derive(Default)]
struct FewDiagnostics {
    shown: Vec<Diagnostic>,
    count: usize,
}

impl FewDiagnostics {
    fn add(&mut self, make: impl FnOnce() -> Diagnostic) {
        self.count += 1;
        if self.shown.len() < SHOWN {
            self.shown.push(make());
        }
    }

    fn report(mut self, diagnostics: &mut Vec<Diagnostic>) {
        let rest = self.count - self.shown.len();
        if let Some(last) = self.shown.pop() {
            self.shown.push(match rest {
                0 => last,
                rest => last.note(format!("{rest} more in this text are not shown")),
            });
        }
        diagnostics.append(&mut self.shown);
    }
}

/// Whether the bytes of a Lipz file may contain two texts to compare, without parsing it.
pub fn has_translations(bytes: &[u8]) -> bool {
    const NAME: &[u8] = b"text";
    bytes.windows(NAME.len()).filter(|window| *window == NAME).nth(1).is_some()
}
