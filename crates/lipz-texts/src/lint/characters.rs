//! Characters that texts should not contain: damaged and invisible ones, and letters of different scripts.

use lipz_diagnostics::escape;
use lipz_file::locale::language;
use lipz_file::text::display;
use std::ops::Range;

/// The help for damaged and invisible characters.
const TYPE_AGAIN: &str =
    "delete it, or type the text again; a wrong encoding or text copied from a web page contains such characters";
/// The help for letters of a different script.
const MOVE: &str = "move the text to the element of its language, or translate it";

/// The least number of letters of a different script, so that a symbol or a name does not count.
const LETTERS: usize = 3;

/// An odd place in a text.
pub(super) struct OddPlace {
    /// Its bytes.
    pub(super) range: Range<usize>,
    pub(super) message: String,
    pub(super) help: &'static str,
}

/// Returns the first odd place of a text in a locale.
pub(super) fn odd(text: &str, locale: &str) -> Option<OddPlace> {
    let place = |help| move |(range, message)| OddPlace { range, message, help };
    let character = damaged(text).or_else(|| unclosed(text)).map(place(TYPE_AGAIN));
    character.or_else(|| foreign(text, locale).map(place(MOVE)))
}

/// Returns the first damaged or invisible character, and a message about it.
fn damaged(text: &str) -> Option<(Range<usize>, String)> {
    text.char_indices().find_map(|(at, character)| {
        let place = |length: usize| at..at + length;
        let is_continued = |rest: &str| rest.chars().next().is_some_and(|next| ('\u{80}'..='\u{bf}').contains(&next));
        let rest = text.get(at + character.len_utf8()..)?;
        match character {
            '\u{fffd}' => {
                Some((place(3), "the text has U+FFFD, which stands for a character that was lost".to_owned()))
            }
            '\u{200b}' | '\u{feff}' => {
                let code = u32::from(character);
                Some((place(3), format!("the text has U+{code:04X}, which has no width")))
            }
            // UTF-8 that was read as Windows-1252: `Ã¼` for `ü`, `â€™` for `’`.
            'Ã' | 'Â' if is_continued(rest) => {
                let shown = text.get(at..at + 4).unwrap_or_default();
                Some((place(4), format!("{} is a character in a wrong encoding", escape::quoted(shown))))
            }
            'â' if rest.starts_with('€') => {
                let length = 'â'.len_utf8() + '€'.len_utf8();
                Some((place(length), "`â€` is a character in a wrong encoding".to_owned()))
            }
            '\u{80}'..='\u{9f}' => {
                Some((place(2), format!("the text has the control character U+{:04X}", u32::from(character))))
            }
            _ => None,
        }
    })
}

/// Returns the first control of the writing direction (UAX 9) without a counterpart.
fn unclosed(text: &str) -> Option<(Range<usize>, String)> {
    let (mut embeddings, mut isolates) = (Vec::new(), Vec::new());
    let mut odd = None;
    for (at, character) in text.char_indices() {
        match character {
            '\u{202a}' | '\u{202b}' | '\u{202d}' | '\u{202e}' => embeddings.push((at, character)),
            '\u{2066}'..='\u{2068}' => isolates.push((at, character)),
            '\u{202c}' if embeddings.pop().is_none() => odd = odd.or(Some((at, character))),
            '\u{2069}' if isolates.pop().is_none() => odd = odd.or(Some((at, character))),
            _ => {}
        }
    }
    let (at, character) = odd.or(embeddings.first().copied()).or(isolates.first().copied())?;
    let code = u32::from(character);
    Some((at..at + 3, format!("U+{code:04X} changes the direction of the text, and has no counterpart")))
}

/// A script of writing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Letters {
    Latin,
    Greek,
    Cyrillic,
    Hebrew,
    Arabic,
    Devanagari,
    Thai,
    Hangul,
    /// Chinese characters and kana.
    Han,
}

impl Letters {
    const NAMES: [(Letters, &str); 9] = [
        (Letters::Latin, "Latin"),
        (Letters::Greek, "Greek"),
        (Letters::Cyrillic, "Cyrillic"),
        (Letters::Hebrew, "Hebrew"),
        (Letters::Arabic, "Arabic"),
        (Letters::Devanagari, "Devanagari"),
        (Letters::Thai, "Thai"),
        (Letters::Hangul, "Korean"),
        (Letters::Han, "Chinese or Japanese"),
    ];

    /// Returns the script of a letter, by its block in Unicode; `None` for scripts that lipz does not tell apart.
    fn of(character: char) -> Option<Letters> {
        Some(match u32::from(character) {
            _ if !character.is_alphabetic() => return None,
            0x41..=0x24f | 0x1e00..=0x1eff => Letters::Latin,
            0x370..=0x3ff | 0x1f00..=0x1fff => Letters::Greek,
            0x400..=0x52f => Letters::Cyrillic,
            0x590..=0x5ff => Letters::Hebrew,
            0x600..=0x6ff | 0x750..=0x77f => Letters::Arabic,
            0x900..=0x97f => Letters::Devanagari,
            0xe00..=0xe7f => Letters::Thai,
            0x1100..=0x11ff | 0xac00..=0xd7af => Letters::Hangul,
            0x3040..=0x30ff | 0x3400..=0x9fff => Letters::Han,
            _ => return None,
        })
    }

    /// Returns the script of a locale; `None` if its language is written in several ones.
    fn of_locale(locale: &str) -> Option<Letters> {
        Some(match language(locale) {
            "el" => Letters::Greek,
            "be" | "bg" | "mk" | "ru" | "uk" => Letters::Cyrillic,
            "he" | "yi" => Letters::Hebrew,
            "ar" | "fa" | "ur" => Letters::Arabic,
            "hi" | "mr" | "ne" => Letters::Devanagari,
            "th" => Letters::Thai,
            "ko" => Letters::Hangul,
            "ja" | "zh" | "yue" => Letters::Han,
            "ca" | "cs" | "cy" | "da" | "de" | "en" | "es" | "et" | "eu" | "fi" | "fr" | "ga" | "gl" | "hr" | "hu"
            | "id" | "is" | "it" | "lt" | "lv" | "ms" | "nb" | "nl" | "nn" | "no" | "pl" | "pt" | "ro" | "sk"
            | "sl" | "sv" | "tr" | "vi" => Letters::Latin,
            _ => return None,
        })
    }
}

/// Returns the whole text if most of its letters belong to the script of a different language. Latin letters do not
/// count, because all languages write names with them.
fn foreign(text: &str, locale: &str) -> Option<(Range<usize>, String)> {
    let expected = Letters::of_locale(locale)?;
    let shown = display(text).text;
    let mut counts = Letters::NAMES.map(|(letters, name)| (letters, name, 0));
    for letters in shown.chars().filter_map(Letters::of) {
        counts.iter_mut().filter(|(known, ..)| *known == letters).for_each(|(.., count)| *count += 1);
    }
    let own = counts.iter().find(|(letters, ..)| *letters == expected).map_or(0, |(.., count)| *count);
    let is_foreign = |letters: Letters| letters != expected && letters != Letters::Latin;
    let (_, name, count) =
        counts.into_iter().filter(|(letters, ..)| is_foreign(*letters)).max_by_key(|(.., count)| *count)?;
    (count >= LETTERS && count > own).then(|| (0..text.len(), format!("the text in {locale} is in {name} letters")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str, locale: &str) -> Option<String> {
        odd(text, locale).map(|place| place.message)
    }

    #[test]
    fn damage_and_invisible_characters_are_found() {
        assert_eq!(odd("Sch\u{fffd}n", "de-de").unwrap().range, 3..6);
        assert_eq!(found("a\u{200b}b", "de-de").unwrap(), "the text has U+200B, which has no width");
        assert_eq!(found("SchÃ¶n", "de-de").unwrap(), "`Ã¶` is a character in a wrong encoding");
        assert_eq!(found("Itâ€™s", "en-us").unwrap(), "`â€` is a character in a wrong encoding");
        assert!(found("a\u{85}b", "en-us").unwrap().contains("U+0085"));
        assert!(found("\u{202e}abc", "en-us").unwrap().contains("U+202E"));
        assert!(found("abc\u{2069}", "he-il").unwrap().contains("U+2069"));
        assert_eq!(found("می\u{200c}خواهم", "fa-ir"), None, "joins letters");
        for text in ["SÃO", "\u{2067}abc\u{2069}", "Ângela, âme", "à € 5"] {
            assert_eq!(found(text, "pt-br"), None, "{text}");
        }
    }

    #[test]
    fn texts_in_other_scripts_are_found() {
        assert_eq!(found("Добрый вечер", "de-de").unwrap(), "the text in de-de is in Cyrillic letters");
        assert_eq!(found("안녕하세요", "ja-jp").unwrap(), "the text in ja-jp is in Korean letters");
        for (text, locale) in [
            ("Bakewell", "ja-jp"),
            ("α + β", "de-de"),
            ("Он сказал: good evening, my friend", "ru-ru"),
            ("灯台です", "ja-jp"),
            ("Добро вече", "sr-rs"),
        ] {
            assert_eq!(found(text, locale), None, "{text}");
        }
    }
}
