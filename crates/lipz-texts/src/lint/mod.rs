//! What is wrong with translations: they are older than their source, or do not say what it says.

mod numbers;
mod numerals;
mod same;
mod stale;

use crate::collect::trimmed;
use crate::merge::tag_of;
use crate::placeholder;
use crate::record::TextRecord;
use lipz_diagnostics::{Code, Diagnostic, Span, bound};
use lipz_file::locale::language;
use lipz_file::text;
use lipz_file::{Document, JsonString, Value};

/// Diagnostics of one kind that one text shows in full; the rest is counted.
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
///     "the translation has `{nmae}` in place of `{name}`",
///     "the translation has the number 50 in place of 15",
/// ]);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug)]
pub struct TextLints<'r> {
    source_locale: String,
    default_locale: Option<String>,
    record: Option<&'r TextRecord>,
}

impl<'r> TextLints<'r> {
    /// Lints of translations from this locale.
    pub fn new(source_locale: impl Into<String>) -> TextLints<'r> {
        TextLints { source_locale: source_locale.into(), default_locale: None, record: None }
    }

    /// Sets the locale of `text` without a locale.
    #[must_use]
    pub fn default_locale(self, locale: Option<String>) -> Self {
        TextLints { default_locale: locale, ..self }
    }

    /// Sets the record of what translations were made from: without it, none is older than its source.
    #[must_use]
    pub fn record(self, record: Option<&'r TextRecord>) -> Self {
        TextLints { record, ..self }
    }

    /// Reports what is wrong with the translations of a clip; `file` is what the record calls its Lipz file.
    pub fn check(&self, file: &str, clip: &Document<'_>, diagnostics: &mut Vec<Diagnostic>) {
        let before = diagnostics.len();
        let others = self.record.map(|record| record.source_locales_of(file)).unwrap_or_default();
        let others = others.into_iter().filter(|locale| *locale != self.source_locale);
        for source_locale in others.chain([self.source_locale.as_str()]) {
            let Some(source) = self.texts(clip).find(|text| text.locale == source_locale) else { continue };
            for translation in self.texts(clip).filter(|text| text.locale != source_locale) {
                if translation.segments.len() != source.segments.len() {
                    continue; // reported as such
                }
                if let Some(record) = self.record {
                    stale::check(record, file, &source, &translation, diagnostics);
                }
                // Whatever a translation was made from, it says what the text of the project's own locale says.
                if source_locale == self.source_locale {
                    compare(&source, &translation, diagnostics);
                }
                bound::limit_many(diagnostics);
            }
        }
        if diagnostics.len() > before {
            bound::limit(diagnostics);
        }
    }

    fn texts<'d>(&'d self, clip: &'d Document<'d>) -> impl Iterator<Item = Text<'d>> {
        clip.elements.iter().filter_map(|element| {
            let locale = tag_of(&element.name.text, self.default_locale.as_deref())?;
            let Value::String(string) = &element.value else { return None };
            Some(Text { locale, string, segments: trimmed(&string.text) })
        })
    }
}

/// A text of a clip.
struct Text<'d> {
    locale: String,
    string: &'d JsonString<'d>,
    /// Its segments, trimmed.
    segments: Vec<String>,
}

impl Text<'_> {
    /// Where a segment is, or a range of its bytes, without the white space around it.
    fn span(&self, segment: usize, range: Option<std::ops::Range<usize>>) -> Span {
        let Some(whole) = text::segments(&self.string.text).nth(segment) else { return self.string.span() };
        let shown = self.string.text.get(whole.clone()).unwrap_or_default();
        let blank = shown.len() - shown.trim_start_matches(text::is_white_space).len();
        let start = whole.start + blank;
        let range = range.unwrap_or(0..text::trim(shown).len());
        self.string.span_of(start + range.start..start + range.end)
    }
}

/// Reports translations that do not say what the source says: segments that both have.
fn compare(source: &Text<'_>, translation: &Text<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let is_other_language = language(&source.locale) != language(&translation.locale);
    let mut found: [Few; 4] = Default::default();
    let [same, placeholders, metas, numbers] = &mut found;
    let numbers_differ = numbers::differ(&source.segments, &translation.segments);
    let pairs = source.segments.iter().zip(&translation.segments).enumerate();
    for (at, (from, to)) in pairs.filter(|(_, (from, to))| !from.is_empty() && !to.is_empty()) {
        let differs = |code, message: String, label: &str, help: &str| {
            let diagnostic = Diagnostic::at(code, translation.span(at, None), message);
            diagnostic.also(source.span(at, None), label).help(help)
        };
        if is_other_language && from == to && same::is_suspicious(from) {
            let message = format!("the text in {} is still that in {}", translation.locale, source.locale);
            let help = "translate it; without the element, players would see the same, and coverage that it is missing";
            same.add(|| differs(Code::UntranslatedText, message, "the same text", help));
        }
        if let Some(message) = placeholder::difference(from, to) {
            placeholders.add(|| differs(Code::Placeholder, message, "the source", placeholder::HELP));
        }
        if let Some(message) = placeholder::meta_difference(from, to) {
            metas.add(|| differs(Code::MetaDiffers, message, "the source", placeholder::META_HELP));
        }
        if let Some(message) = numbers_differ.then(|| numbers::difference(from, to)).flatten() {
            let help = "compare the texts: one of the two is wrong";
            numbers.add(|| differs(Code::NumbersDiffer, message, "the source", help));
        }
    }
    for of_kind in found {
        of_kind.report(diagnostics);
    }
}

/// Diagnostics of one kind about one text: the first few, and how many there are. The others are not made, because finding
/// their places takes as long as their text is.
#[derive(Default)]
struct Few {
    shown: Vec<Diagnostic>,
    count: usize,
}

impl Few {
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

/// Whether a Lipz file may have something to compare, two texts, as its bytes show without parsing.
pub fn has_translations(bytes: &[u8]) -> bool {
    const NAME: &[u8] = b"text";
    bytes.windows(NAME.len()).filter(|window| *window == NAME).nth(1).is_some()
}
