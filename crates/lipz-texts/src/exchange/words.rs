//! The number of words in a text, for the payment of translators.

use lipz_file::text::display;
use unicode_segmentation::UnicodeSegmentation;

/// The letters per word in scripts without spaces, for which no rule divides words: the factor of GMX-V for Thai.
const LETTERS_A_WORD: usize = 6;

/// Returns the number of words in a text, without `{meta}`: those between spaces and punctuation (Unicode, annex 29),
/// including numbers. In Chinese and Japanese, each character is a word; in Thai, Lao, Khmer and Burmese, every six
/// letters are.
///
/// ```
/// use lipz_texts::words;
/// assert_eq!(words("{louder} Don't go, 2,000 men!"), 4);
/// assert_eq!(words("灯台です"), 4);
/// assert_eq!(words("สวัสดีชาวโลก"), 2);
/// ```
pub fn words(text: &str) -> usize {
    let shown = display(text).text;
    let (mut count, mut letters) = (0, 0);
    for word in shown.unicode_words() {
        let first = word.chars().next().unwrap_or_default();
        match script(first) {
            Script::Spaced => count += 1,
            Script::Characters => count += word.chars().filter(|character| character.is_alphanumeric()).count(),
            Script::Undivided => letters += word.chars().filter(|character| character.is_alphabetic()).count(),
        }
    }
    count + letters.div_ceil(LETTERS_A_WORD)
}

enum Script {
    /// Spaces separate words.
    Spaced,
    /// Each character counts.
    Characters,
    /// There is no sign between words.
    Undivided,
}

fn script(character: char) -> Script {
    match u32::from(character) {
        0x0E00..=0x0EFF | 0x1000..=0x109F | 0x1780..=0x17FF => Script::Undivided,
        // Kana, and Han with its extensions.
        0x3040..=0x30FF | 0x31F0..=0x31FF | 0x3400..=0x4DBF | 0x4E00..=0x9FFF | 0xF900..=0xFAFF | 0x20000..=0x3FFFF => {
            Script::Characters
        }
        _ => Script::Spaced,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_all_scripts() {
        for (text, count) in [
            ("", 0),
            ("…", 0),
            ("{to: amy}", 0),
            ("Who goes there?", 3),
            ("L'homme, aujourd'hui", 2),
            ("안녕하세요 여러분", 2),
            ("カタカナ", 4),
            ("港 Hafen", 2),
            ("مرحبا بالعالم", 2),
            ("ก", 1),
        ] {
            assert_eq!(words(text), count, "{text}");
        }
    }
}
