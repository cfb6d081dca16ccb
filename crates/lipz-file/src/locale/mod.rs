//! Locales of texts: the names of `text_ll-cc` elements.

mod iso;
mod tag;
mod variant;

pub use tag::LanguageTag;
pub use variant::{
    LONGEST_KEY, LONGEST_NAME, found_keys, is_variant, is_variant_key, split_category, split_variant, variant_tag,
    without_category,
};

/// The locale in the name of a text element.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum TextName {
    /// `text_ll-cc`, or `text_ll-cc-x-key` for a [variant](is_variant): the tag.
    Canonical(String),
    /// A different spelling of a locale, `text-en_us`, `text_EN-US`: the intended locale.
    Misspelt(String),
    /// `text` or `text_` without a locale.
    NoLocale,
    /// A text whose locale does not have the form `ll-cc`: the locale as written, and the BCP 47 tag in lower case if
    /// it is one.
    OtherShape(String, Option<String>),
}

/// Parses the name of an element; `None` if it is not the name of a text.
///
/// ```
/// use lipz_file::locale::{TextName, text_name};
/// assert_eq!(text_name("text_es-mx"), Some(TextName::Canonical("es-mx".into())));
/// assert_eq!(text_name("text-en_us"), Some(TextName::Misspelt("en-us".into())));
/// assert_eq!(text_name("text_pl-pl-x-few"), Some(TextName::Canonical("pl-pl-x-few".into())));
/// assert_eq!(text_name("texture"), None);
/// ```
pub fn text_name(name: &str) -> Option<TextName> {
    let rest = name.strip_prefix("text")?;
    let Some(separator) = rest.chars().next() else { return Some(TextName::NoLocale) };
    if !matches!(separator, '_' | '-') {
        return None;
    }
    let locale = &rest[1..];
    if locale.is_empty() {
        return Some(TextName::NoLocale);
    }
    // Nearly every name has the correct spelling.
    if separator == '_' && is_lipz_tag(locale) {
        return Some(TextName::Canonical(locale.to_owned()));
    }
    let tag = locale.to_ascii_lowercase().replace('_', "-");
    if is_lipz_tag(&tag) {
        return Some(TextName::Misspelt(tag));
    }
    let (language, key) = split_variant(&tag);
    let is_tag = LanguageTag::parse(language).is_some() && key.is_none_or(is_variant_key);
    let extended = is_tag.then_some(tag);
    Some(TextName::OtherShape(locale.to_owned(), extended))
}

impl TextName {
    /// Returns the tag in canonical spelling, of the form `ll-cc` or of BCP 47, with its variant; `None` for a name
    /// without a locale, or with one that is not a language tag.
    pub fn tag(self) -> Option<String> {
        match self {
            TextName::Canonical(tag) | TextName::Misspelt(tag) => Some(tag),
            TextName::OtherShape(_, extended) => extended,
            TextName::NoLocale => None,
        }
    }
}

/// Returns the canonical form of a locale tag (`en-us` for `en_US`). `None` if it does not have the form `ll-cc` or,
/// with `extended`, is not a BCP 47 language tag, and for a [variant](is_variant), which is not a locale.
///
/// ```
/// use lipz_file::locale::canonical_tag;
/// assert_eq!(canonical_tag("en_US", false).as_deref(), Some("en-us"));
/// assert_eq!(canonical_tag("es-419", false), None);
/// assert_eq!(canonical_tag("es-419", true).as_deref(), Some("es-419"));
/// ```
pub fn canonical_tag(tag: &str, extended: bool) -> Option<String> {
    match text_name(&format!("text_{tag}"))? {
        TextName::Canonical(tag) | TextName::Misspelt(tag) => Some(tag),
        TextName::OtherShape(_, tag) if extended => tag,
        _ => None,
    }
    .filter(|tag| !is_variant(tag))
}

/// Returns the canonical form of a tag that stands for a locale (`ja-jp` for `ja_JP`), or for all locales of a language
/// (`ja`, `haw`). With `extended`, any BCP 47 language tag is a locale. `None` for everything else.
///
/// A language has two letters of ISO 639-1 or, because that list lacks most languages, any three letters.
///
/// ```
/// use lipz_file::locale::language_or_locale;
/// assert_eq!(language_or_locale("JA", false).as_deref(), Some("ja"));
/// assert_eq!(language_or_locale("ja_JP", false).as_deref(), Some("ja-jp"));
/// assert_eq!(language_or_locale("japanese", true), None);
/// ```
pub fn language_or_locale(tag: &str, extended: bool) -> Option<String> {
    let code = tag.to_ascii_lowercase();
    match code.len() {
        2 => iso::is_language(&code).then_some(code),
        3 => code.bytes().all(|letter| letter.is_ascii_lowercase()).then_some(code),
        _ => canonical_tag(tag, extended),
    }
}

/// Whether a tag has the form `ll-cc`, or `ll-cc-x-key`.
fn is_lipz_tag(tag: &str) -> bool {
    let (locale, key) = split_variant(tag);
    has_lipz_shape(locale) && key.is_none_or(is_variant_key)
}

/// Whether a tag has the form `ll-cc`: two lower-case letters, a hyphen, two lower-case letters.
pub fn has_lipz_shape(tag: &str) -> bool {
    matches!(tag.as_bytes(), [b'a'..=b'z', b'a'..=b'z', b'-', b'a'..=b'z', b'a'..=b'z'])
}

/// Returns the language part of a tag: `en` of `en-us`.
pub fn language(tag: &str) -> &str {
    tag.split('-').next().unwrap_or(tag)
}

/// Whether the language of an `ll-cc` tag is missing in ISO 639-1, and whether its country is missing in ISO 3166-1.
pub fn unknown_parts(tag: &str) -> (bool, bool) {
    let (language, country) = tag.split_once('-').unwrap_or((tag, ""));
    (!iso::is_language(language), !iso::is_country(&country.to_ascii_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings() {
        let misspelt = |tag: &str| Some(TextName::Misspelt(tag.to_owned()));
        for name in ["text-en_us", "text_en_us", "text_EN-US", "text-en-us", "text_En_uS"] {
            assert_eq!(text_name(name), misspelt("en-us"), "{name}");
        }
        for name in ["text_en-US-x-One", "text-en-us-x-one", "text_en_us_x_one"] {
            assert_eq!(text_name(name), misspelt("en-us-x-one"), "{name}");
        }
        for name in ["text", "text_", "text-"] {
            assert_eq!(text_name(name), Some(TextName::NoLocale), "{name}");
        }
        let other = |name: &str, tag: Option<&str>| Some(TextName::OtherShape(name.into(), tag.map(Into::into)));
        assert_eq!(text_name("text_es-419"), other("es-419", Some("es-419")));
        assert_eq!(text_name("text_zh-Hant"), other("zh-Hant", Some("zh-hant")));
        assert_eq!(text_name("text_en"), other("en", Some("en")));
        assert_eq!(text_name("text_es-419-x-few"), other("es-419-x-few", Some("es-419-x-few")));
        assert_eq!(text_name("text_en-us-x-"), other("en-us-x-", None));
        assert_eq!(text_name("text_en-us-x-feminine1"), other("en-us-x-feminine1", None));
        assert_eq!(text_name("text_x-one"), other("x-one", None));
        assert_eq!(text_name("text_englisch-deutsch"), other("englisch-deutsch", None));
        for name in ["texture", "Text_en-us", "visemes", "texten-us"] {
            assert_eq!(text_name(name), None, "{name}");
        }
    }

    #[test]
    fn a_language_or_a_locale() {
        let cases = [
            ("ja", "ja"),
            ("JA", "ja"),
            ("haw", "haw"),
            ("ja-jp", "ja-jp"),
            ("pt_BR", "pt-br"),
            ("es-419", "es-419"),
            ("zh-Hant", "zh-hant"),
        ];
        for (tag, expected) in cases {
            assert_eq!(language_or_locale(tag, true).as_deref(), Some(expected), "{tag}");
        }
        for tag in ["", "j", "xx", "id ", "japanese", "Englisch", "text", "a-b", "n1", "ja-", "note", "日本"] {
            assert_eq!(language_or_locale(tag, true), None, "{tag}");
        }
        assert_eq!(language_or_locale("es-419", false), None);
    }

    #[test]
    fn iso_lists() {
        assert_eq!(unknown_parts("en-us"), (false, false));
        assert_eq!(unknown_parts("en-uk"), (false, true));
        assert_eq!(unknown_parts("xx-us"), (true, false));
    }
}
