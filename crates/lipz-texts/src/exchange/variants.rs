//! Variants of texts as translations: their sources, and the variants that a locale needs.
//!
//! The variant `de-de-x-few` is a translation of the variant `en-us-x-few`. If the source locale lacks that, it is a
//! translation of the source text in the segments that vary. The other segments are blank.

use crate::exchange::ClipTexts;
use crate::exchange::model::joined;
use crate::exchange::placeholder;
use crate::plural::{Categories, join_category};
use lipz_file::locale::{split_category, split_variant, variant_tag, without_category};
use lipz_file::placeholder::PlaceholderPattern;
use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::{BTreeSet, HashSet};

/// The texts that a translation is made from.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SourceTexts<'t> {
    /// Their locale, with the key of the variant: `en-us-x-few`. No file needs to have a text with this tag.
    pub locale: Cow<'t, str>,
    /// The text of each segment; empty where a variant does not vary.
    pub texts: Cow<'t, [String]>,
    /// The texts of the source locale.
    whole: &'t [String],
    /// The locale of the translation, without a variant.
    to: String,
}

/// The texts of a clip as sources of its translations.
#[derive(Debug)]
pub struct ClipSources<'t> {
    clip: &'t ClipTexts,
    source_locale: &'t str,
    whole: &'t [String],
    /// For each segment, whether it varies.
    varies: OnceCell<Vec<bool>>,
}

impl<'t> ClipSources<'t> {
    /// Returns the sources of translations from a locale; `None` if the clip has no text in it.
    pub fn new(clip: &'t ClipTexts, source_locale: &'t str) -> Option<ClipSources<'t>> {
        let whole = clip.get(source_locale)?.as_slice();
        Some(ClipSources { clip, source_locale, whole, varies: OnceCell::new() })
    }

    /// Returns the texts that the translation into `locale`, which may be a variant, is made from.
    ///
    /// ```
    /// use lipz_texts::{ClipSources, texts_of};
    /// let clip = br#"{ "text_en-us": "Look!|{n} guards.", "text_en-us-x-one": "|One guard." }"#;
    /// let clip = texts_of(&lipz_file::parse(clip).document.ok_or("a valid file")?, None);
    /// let sources = ClipSources::new(&clip, "en-us").ok_or("a text")?;
    /// let of = |locale| sources.of(locale).texts.join("|");
    /// assert_eq!(of("pl-pl"), "Look!|{n} guards.");
    /// assert_eq!(of("pl-pl-x-one"), "|One guard.");
    /// assert_eq!(of("pl-pl-x-few"), "|{n} guards.");
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(&self, locale: &str) -> SourceTexts<'t> {
        let (to, key) = split_variant(locale);
        let ClipSources { clip, source_locale, whole, .. } = *self;
        let Some(key) = key else {
            return SourceTexts { locale: source_locale.into(), texts: whole.into(), whole, to: to.to_owned() };
        };
        let of_key = |key: &str| {
            Some(clip.get(&variant_tag(source_locale, key))?.as_slice()).filter(|own| own.len() == whole.len())
        };
        let rest = || without_category(key).filter(|rest| *rest != key);
        let texts = match of_key(key).or_else(|| of_key(rest()?)) {
            Some(own) => own.into(),
            None => {
                let varies = self.varies.get_or_init(|| varying(clip, source_locale, whole.len()));
                let text = |(text, varies): (&String, &bool)| if *varies { text.clone() } else { String::new() };
                Cow::Owned(whole.iter().zip(varies).map(text).collect())
            }
        };
        SourceTexts { locale: variant_tag(source_locale, key).into(), texts, whole, to: to.to_owned() }
    }
}

impl SourceTexts<'_> {
    /// Returns the current source text of a segment, from 0, or of the clip, if a file has the same in another form: with
    /// the text in the segments that do not vary, or the text itself, because an entry with plural forms has the sources
    /// of two of them.
    pub(crate) fn current(&self, segment: Option<usize>, then: &str) -> Option<String> {
        let of = |texts: &[String]| match segment {
            Some(at) => texts.get(at).cloned().unwrap_or_default(),
            None => joined(texts),
        };
        let fill = |(text, whole): (&String, &String)| if text.is_empty() { whole.clone() } else { text.clone() };
        let filled: Vec<String> = self.texts.iter().zip(self.whole).map(fill).collect();
        let is_current = [of(&self.texts), of(&filled), of(self.whole)].iter().any(|known| known == then);
        is_current.then(|| of(&self.texts))
    }

    /// Returns the difference between the placeholders of a segment and those of its source, if lipz reports it. A variant
    /// may have those of the text. For a plural category with one number, it may do without: `One guard.`
    pub(crate) fn placeholder_difference(&self, at: usize, text: &str, own: &[PlaceholderPattern]) -> Option<String> {
        let source = self.texts.get(at).map_or("", String::as_str);
        let found = placeholder::difference(source, text, own)?;
        let (_, Some(key)) = split_variant(&self.locale) else { return Some(found) };
        let whole = self.whole.get(at).map_or("", String::as_str);
        let is_one_number = split_category(key).0.is_some_and(|name| Categories::of(&self.to).has_one_number(name));
        let is_allowed = match is_one_number {
            true => placeholder::are_among(text, whole, own),
            false => placeholder::difference(whole, text, own).is_none(),
        };
        (!is_allowed).then_some(found)
    }
}

/// Returns the tag of a source text for a translation into `locale`, which may be a variant.
pub(crate) fn source_tag(source_locale: &str, locale: &str) -> String {
    variant_tag(source_locale, split_variant(locale).1.unwrap_or(""))
}

/// Returns for each segment whether it varies: in the source locale, or in any locale if the source has no variants.
fn varying(clip: &ClipTexts, source_locale: &str, count: usize) -> Vec<bool> {
    let variants = |is_meant: &dyn Fn(&str) -> bool| {
        let mut varies = vec![false; count];
        for (tag, texts) in clip {
            if matches!(split_variant(tag), (locale, Some(_)) if is_meant(locale)) {
                varies.iter_mut().zip(texts).for_each(|(varies, text)| *varies |= !text.is_empty());
            }
        }
        Some(varies).filter(|varies| varies.contains(&true))
    };
    let of_source = variants(&|locale| locale == source_locale);
    of_source.or_else(|| variants(&|_| true)).unwrap_or_else(|| vec![true; count])
}

/// A variant of a clip in one locale.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct VariantKey {
    pub(crate) key: String,
    /// Whether the locale needs it. Others only exist there.
    pub(crate) is_needed: bool,
}

/// Returns the variants of a clip that a locale needs or has. It needs those of the source locale, with the plural
/// categories of its own language in place of those of the source.
pub(crate) fn variant_keys(clip: &ClipTexts, source_locale: &str, locale: &str) -> Vec<VariantKey> {
    let keys_of = |wanted: &str| {
        let keys = clip.keys().filter_map(|tag| match split_variant(tag) {
            (locale, Some(key)) if locale == wanted => Some(key),
            _ => None,
        });
        keys.collect::<Vec<&str>>()
    };
    let (of_source, own) = (keys_of(source_locale), keys_of(locale));
    let mut all: Vec<VariantKey> = Vec::new();
    if of_source.is_empty() && own.is_empty() {
        return all;
    }
    let mut known = HashSet::new();
    let mut add = |key: String, is_needed| {
        if known.insert(key.clone()) {
            all.push(VariantKey { key, is_needed });
        }
    };
    let of_language = Categories::of(source_locale);
    // A template is in no language, and has the plural forms of its source.
    let own_language = Categories::of(if locale.is_empty() { source_locale } else { locale });
    let plurals_of_source = of_source.iter().filter(|key| is_plural(key, &of_language));
    let plurals = plurals_of_source.chain(own.iter().filter(|key| is_plural(key, &own_language)));
    let rests: BTreeSet<&str> = plurals.map(|key| split_category(key).1).collect();
    for rest in rests {
        for category in own_language.variants() {
            add(join_category(category, rest), true);
        }
    }
    // `zero` in English is a text of its own, for a number that the language treats as many.
    let others = of_source.iter().filter(|key| !is_plural(key, &of_language));
    others.for_each(|key| add((*key).to_owned(), true));
    own.iter().for_each(|key| add((*key).to_owned(), false));
    all
}

/// Whether a key begins with a plural category that needs a variant in a language.
fn is_plural(key: &str, language: &Categories) -> bool {
    split_category(key).0.is_some_and(|category| language.variants().contains(&category))
}

/// Returns the keys of all variants that a file with these locales can have, each once. The plural forms of a PO file
/// come from the source, even if the language of the file has only one.
pub(crate) fn keys_of_all(clip: &ClipTexts, source_locale: &str, of_locales: &[Vec<VariantKey>]) -> Vec<String> {
    let of_source = clip.keys().map(|tag| split_variant(tag)).filter(|(locale, _)| *locale == source_locale);
    let of_locales = of_locales.iter().flatten().map(|known| known.key.as_str());
    let mut known = HashSet::new();
    let all = of_locales.chain(of_source.filter_map(|(_, key)| key)).filter(|key| known.insert(*key));
    all.map(str::to_owned).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn clip(texts: &[(&str, &str)]) -> ClipTexts {
        let segments = |text: &str| text.split('|').map(str::to_owned).collect();
        texts.iter().map(|(tag, text)| ((*tag).to_owned(), segments(text))).collect()
    }

    fn keys(clip: &ClipTexts, locale: &str) -> String {
        let keys = variant_keys(clip, "en-us", locale);
        keys.into_iter().map(|key| key.key + if key.is_needed { "" } else { "?" }).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_locale_needs_its_own_categories() {
        let guards = clip(&[("en-us", "a"), ("en-us-x-one", "b"), ("ru-ru-x-many", "c"), ("ja-jp-x-one", "d")]);
        assert_eq!(keys(&guards, "de-de"), "one");
        assert_eq!(keys(&guards, "pl-pl"), "one few");
        assert_eq!(keys(&guards, "ru-ru"), "one few many?");
        assert_eq!(keys(&guards, "ja-jp"), "one?");
        let king = clip(&[("en-us", "a"), ("en-us-x-fem", "b"), ("en-us-x-one-fem", "b")]);
        assert_eq!(keys(&king, "pl-pl"), "one-fem few-fem fem");
        assert_eq!(
            keys(&clip(&[("en-us", "a"), ("pl-pl-x-few", "b")]), "pl-pl"),
            "one few",
            "without those of the source"
        );
        assert_eq!(keys(&clip(&[("en-us", "a"), ("pl-pl-x-few", "b")]), "de-de"), "");
        assert_eq!(keys(&clip(&[("en-us", "a"), ("en-us-x-zero", "b")]), "pl-pl"), "zero", "a special case");
    }

    #[test]
    fn sources_are_blank_where_nothing_varies() {
        let of = |clip: &ClipTexts, locale: &str| ClipSources::new(clip, "en-us").unwrap().of(locale).texts.join("|");
        let guards = clip(&[("en-us", "a|b"), ("en-us-x-fem", "|c"), ("de-de-x-one", "d|d")]);
        assert_eq!(of(&guards, "pl-pl-x-few-fem"), "|c", "without the category");
        assert_eq!(of(&guards, "pl-pl-x-few"), "|b");
        let german = clip(&[("en-us", "a|b"), ("de-de-x-one", "d|")]);
        assert_eq!(of(&german, "de-de-x-one"), "a|");
        assert_eq!(of(&clip(&[("en-us", "a|b")]), "de-de-x-one"), "a|b");
        assert!(ClipSources::new(&german, "fr-fr").is_none());
    }

    #[test]
    fn numbers_in_words_need_no_placeholder() {
        let guards = clip(&[("en-us", "{n} guards of {name}"), ("en-us-x-one", "One guard of {name}")]);
        let differs = |locale: &str, text: &str| {
            ClipSources::new(&guards, "en-us").unwrap().of(locale).placeholder_difference(0, text, &[]).is_some()
        };
        assert!(!differs("ru-ru-x-one", "{n} стражник {name}"), "as in the text");
        assert!(!differs("de-de-x-one", "Eine Wache von {name}"));
        assert!(differs("de-de-x-one", "Eine Wache von {nmae}"));
        assert!(differs("ru-ru-x-two", "стражник {name}"), "not a category of Russian");
        assert!(differs("ru-ru-x-few", "стражники {name}"));
        assert!(!differs("ru-ru-x-few", "{n} стражника {name}"));
        assert!(differs("de-de", "Wachen von {name}"));
    }
}
