//! Languages, and the sources of their pronunciations.

use std::fmt;

/// A language, which decides how words are pronounced and numbers are read.
///
/// ```
/// use lipz_speech::{Language, Reliance};
/// let language = Language::from_locale("pt-br").expect("a locale");
/// assert_eq!((language.code(), language.name()), ("pt", "Portuguese"));
/// assert_eq!(language.reliance(), Reliance::Rules);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Language(&'static LanguageEntry);

#[derive(PartialEq, Eq, Hash, Debug)]
struct LanguageEntry {
    code: &'static str,
    name: &'static str,
    reliance: Reliance,
}

/// The source of a language's pronunciations, apart from a project's own lexicon.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum Reliance {
    /// A dictionary, and letter-to-sound rules for words that it does not contain.
    Dictionary,
    /// Letter-to-sound rules of the language.
    Rules,
    /// Kana, which are phonetic. Chinese characters need a reading: `{say: …}` or the lexicon.
    Kana,
    /// Hangul, which is read by rules.
    Hangul,
    /// Chinese characters with all their readings in pinyin.
    Pinyin,
    /// Letters as most languages read them; other scripts are romanised first.
    Letters,
}

impl fmt::Display for Reliance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Reliance::Dictionary => "dictionary, rules for other words",
            Reliance::Rules => "rules",
            Reliance::Kana => "kana; Chinese characters need a reading",
            Reliance::Hangul => "rules for hangul",
            Reliance::Pinyin => "readings in pinyin",
            Reliance::Letters => "letters with their most common sounds",
        })
    }
}

macro_rules! languages {
    ($($code:literal $name:literal $reliance:ident,)*) => {
        /// The entries, sorted by code.
        static ENTRIES: &[LanguageEntry] = &[$(LanguageEntry { code: $code, name: $name, reliance: Reliance::$reliance }),*];
    };
}

languages! {
    "en" "English" Dictionary,
    "af" "Afrikaans" Letters,
    "ak" "Akan" Letters,
    "am" "Amharic" Letters,
    "ar" "Arabic" Letters,
    "az" "Azerbaijani" Letters,
    "be" "Belarusian" Letters,
    "bg" "Bulgarian" Rules,
    "bs" "Bosnian" Letters,
    "ca" "Catalan" Rules,
    "ccp" "Chakma" Letters,
    "chr" "Cherokee" Letters,
    "cs" "Czech" Rules,
    "cy" "Welsh" Letters,
    "da" "Danish" Letters,
    "de" "German" Rules,
    "ee" "Ewe" Letters,
    "el" "Greek" Letters,
    "eo" "Esperanto" Letters,
    "es" "Spanish" Rules,
    "et" "Estonian" Letters,
    "fa" "Persian" Letters,
    "ff" "Fula" Letters,
    "fi" "Finnish" Rules,
    "fil" "Filipino" Letters,
    "fo" "Faroese" Letters,
    "fr" "French" Rules,
    "ga" "Irish" Letters,
    "gu" "Gujarati" Letters,
    "he" "Hebrew" Letters,
    "hi" "Hindi" Letters,
    "hr" "Croatian" Letters,
    "hu" "Hungarian" Letters,
    "hy" "Armenian" Letters,
    "id" "Indonesian" Letters,
    "is" "Icelandic" Letters,
    "it" "Italian" Rules,
    "ja" "Japanese" Kana,
    "ka" "Georgian" Letters,
    "kk" "Kazakh" Letters,
    "kl" "Greenlandic" Letters,
    "km" "Khmer" Letters,
    "ko" "Korean" Hangul,
    "ky" "Kyrgyz" Letters,
    "lb" "Luxembourgish" Letters,
    "lo" "Lao" Letters,
    "lrc" "Northern Luri" Letters,
    "lt" "Lithuanian" Letters,
    "lv" "Latvian" Letters,
    "mk" "Macedonian" Letters,
    "ms" "Malay" Letters,
    "mt" "Maltese" Letters,
    "my" "Burmese" Letters,
    "ne" "Nepali" Letters,
    "nl" "Dutch" Rules,
    "nn" "Norwegian Nynorsk" Letters,
    "no" "Norwegian" Letters,
    "pl" "Polish" Rules,
    "pt" "Portuguese" Rules,
    "qu" "Quechua" Letters,
    "ro" "Romanian" Letters,
    "ru" "Russian" Rules,
    "se" "Northern Sami" Letters,
    "sk" "Slovak" Letters,
    "sl" "Slovenian" Letters,
    "sq" "Albanian" Letters,
    "sr" "Serbian" Letters,
    "su" "Sundanese" Letters,
    "sv" "Swedish" Letters,
    "sw" "Swahili" Letters,
    "ta" "Tamil" Letters,
    "th" "Thai" Letters,
    "tr" "Turkish" Rules,
    "uk" "Ukrainian" Rules,
    "vec" "Venetian" Letters,
    "vi" "Vietnamese" Letters,
    "yue" "Cantonese" Letters,
    "zh" "Mandarin Chinese" Pinyin,
}

/// The entry for every language that is not in the list.
static OTHER: LanguageEntry = LanguageEntry { code: "und", name: "other languages", reliance: Reliance::Letters };

impl Language {
    /// English.
    pub const ENGLISH: Language = Language(&ENTRIES[0]);
    /// Any language that is not in the list.
    pub const OTHER: Language = Language(&OTHER);

    /// Returns the language of a locale, which may be `xx-yy` as in Lipz files, or BCP 47 (`es-419`, `zh-Hant-TW`,
    /// `pt_BR`).
    ///
    /// A language that is not in the list becomes [`Language::OTHER`]. Returns `None` if this cannot be a locale.
    pub fn from_locale(locale: &str) -> Option<Language> {
        let code = locale.split(['-', '_']).next().unwrap_or_default().to_ascii_lowercase();
        if !(2..=3).contains(&code.len()) || !code.bytes().all(|byte| byte.is_ascii_lowercase()) {
            return None;
        }
        let code = ALIASES.iter().find(|(alias, _)| *alias == code).map_or(code.as_str(), |(_, code)| code);
        let entry = ENTRIES.iter().find(|entry| entry.code == code);
        Some(entry.map_or(Language::OTHER, Language))
    }

    /// Returns all languages except [`Language::OTHER`]: English, then the rest by code.
    pub fn all() -> impl Iterator<Item = Language> {
        ENTRIES.iter().map(Language)
    }

    /// Returns the ISO 639 code, with two letters if there is such a code; `und` for [`OTHER`](Language::OTHER).
    pub fn code(self) -> &'static str {
        self.0.code
    }

    /// Returns the English name.
    pub fn name(self) -> &'static str {
        self.0.name
    }

    /// Returns the source of the language's pronunciations.
    pub fn reliance(self) -> Reliance {
        self.0.reliance
    }
}

/// Alternative codes, with the code of the language that is used.
const ALIASES: [(&str, &str); 8] = [
    ("eng", "en"),
    ("sco", "en"),
    ("cmn", "zh"),
    ("zho", "zh"),
    ("nb", "no"),
    ("in", "id"),
    ("iw", "he"),
    ("tl", "fil"),
];

/// Prints the code.
impl fmt::Debug for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Language({})", self.0.code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn locales_of_every_shape() {
        let code = |locale| Language::from_locale(locale).map(Language::code);
        for locale in ["en", "en-us", "EN-GB", "en_AU", "eng", "en-Latn-US-x-old"] {
            assert_eq!(code(locale), Some("en"), "{locale}");
        }
        assert_eq!(code("tlh"), Some("und"));
        for bad in ["", "e", "engl", "e1", "-us", "é", "12"] {
            assert_eq!(code(bad), None, "{bad}");
        }
    }

    #[test]
    fn the_list_has_an_order() {
        let codes: Vec<_> = Language::all().skip(1).map(Language::code).collect();
        assert!(codes.is_sorted());
        assert_eq!(Language::ENGLISH.code(), "en");
    }
}
