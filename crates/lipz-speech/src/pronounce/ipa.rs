//! The International Phonetic Alphabet, and the nearest English phones of its symbols.

use crate::Phone;
use unicode_normalization::UnicodeNormalization;

/// Symbols and the nearest phones. If one symbol is a prefix of another, the longer one comes first.
const SYMBOLS: &[(&str, &[Phone])] = {
    use Phone::*;
    &[
        // Affricates and diphthongs, without ties.
        ("tʃ", &[Ch]),
        ("dʒ", &[Jh]),
        ("tɕ", &[Ch]),
        ("dʑ", &[Jh]),
        ("tʂ", &[Ch]),
        ("dʐ", &[Jh]),
        ("ʧ", &[Ch]),
        ("ʤ", &[Jh]),
        ("ʨ", &[Ch]),
        ("ʥ", &[Jh]),
        ("ʦ", &[T, S]),
        ("ʣ", &[D, Z]),
        ("aɪ", &[Ay]),
        ("ai", &[Ay]),
        ("aj", &[Ay]),
        ("ɑɪ", &[Ay]),
        ("aʊ", &[Aw]),
        ("au", &[Aw]),
        ("aw", &[Aw]),
        ("ɑʊ", &[Aw]),
        ("æʊ", &[Aw]),
        ("eɪ", &[Ey]),
        ("ei", &[Ey]),
        ("ej", &[Ey]),
        ("ɛɪ", &[Ey]),
        ("ɛi", &[Ey]),
        ("oʊ", &[Ow]),
        ("ou", &[Ow]),
        ("ow", &[Ow]),
        ("əʊ", &[Ow]),
        ("ɔʊ", &[Ow]),
        ("ɔɪ", &[Oy]),
        ("ɔi", &[Oy]),
        ("oi", &[Oy]),
        ("oɪ", &[Oy]),
        ("ɔʏ", &[Oy]),
        ("ɔy", &[Oy]),
        ("ɔj", &[Oy]),
        ("ɜr", &[Er]),
        ("ɝ", &[Er]),
        ("ɚ", &[Er]),
        ("ɜ", &[Er]),
        ("ɞ", &[Er]),
        // Vowels, by height and rounding first, because lips show these.
        ("i", &[Iy]),
        ("ɪ", &[Ih]),
        ("ɨ", &[Ih]),
        ("ᵻ", &[Ih]),
        ("y", &[Uw]),
        ("ʏ", &[Uh]),
        ("ʉ", &[Uw]),
        ("ɯ", &[Uw]),
        ("u", &[Uw]),
        ("ʊ", &[Uh]),
        ("e", &[Ey]),
        ("ɛ", &[Eh]),
        ("ə", &[Ah]),
        ("ɘ", &[Ah]),
        ("ɤ", &[Ah]),
        ("ø", &[Uh]),
        ("œ", &[Uh]),
        ("ɵ", &[Uh]),
        ("o", &[Ow]),
        ("ɔ", &[Ao]),
        ("ɒ", &[Ao]),
        ("ʌ", &[Ah]),
        ("ɐ", &[Ah]),
        ("æ", &[Ae]),
        ("a", &[Aa]),
        ("ɑ", &[Aa]),
        ("ɶ", &[Aa]),
        // Consonants.
        ("p", &[P]),
        ("b", &[B]),
        ("ɓ", &[B]),
        ("m", &[M]),
        ("ɱ", &[M]),
        ("t", &[T]),
        ("d", &[D]),
        ("ɗ", &[D]),
        ("ʈ", &[T]),
        ("ɖ", &[D]),
        ("n", &[N]),
        ("ɳ", &[N]),
        ("ɲ", &[N, Y]),
        ("ŋ", &[Ng]),
        ("ɴ", &[Ng]),
        ("k", &[K]),
        ("g", &[G]),
        ("ɡ", &[G]),
        ("ɠ", &[G]),
        ("q", &[K]),
        ("ɢ", &[G]),
        ("c", &[K]),
        ("ɟ", &[G]),
        ("f", &[F]),
        ("v", &[V]),
        ("ⱱ", &[V]),
        ("ʋ", &[V]),
        ("ɸ", &[F]),
        ("β", &[V]),
        ("θ", &[Th]),
        ("ð", &[Dh]),
        ("s", &[S]),
        ("z", &[Z]),
        ("ʃ", &[Sh]),
        ("ʒ", &[Zh]),
        ("ʂ", &[Sh]),
        ("ʐ", &[Zh]),
        ("ɕ", &[Sh]),
        ("ʑ", &[Zh]),
        ("ɧ", &[Sh]),
        ("ç", &[Hh]),
        ("ʝ", &[Y]),
        ("x", &[Hh]),
        ("ɣ", &[G]),
        ("χ", &[Hh]),
        ("ʁ", &[R]),
        ("ʀ", &[R]),
        ("ħ", &[Hh]),
        ("ʕ", &[Ah]),
        ("h", &[Hh]),
        ("ɦ", &[Hh]),
        ("ʔ", &[]),
        ("ʡ", &[]),
        ("l", &[L]),
        ("ɫ", &[L]),
        ("ɭ", &[L]),
        ("ɬ", &[L]),
        ("ɮ", &[L]),
        ("ʎ", &[L, Y]),
        ("ʟ", &[L]),
        ("ɺ", &[L]),
        ("r", &[R]),
        ("ɹ", &[R]),
        ("ɾ", &[R]),
        ("ɻ", &[R]),
        ("ɽ", &[R]),
        ("ʙ", &[B]),
        ("w", &[W]),
        ("ʍ", &[W]),
        ("ɥ", &[W]),
        ("j", &[Y]),
        ("ɰ", &[W]),
    ]
};

/// Whether a character modifies the symbol before it in a way that lips do not show, or divides syllables.
fn is_mark(c: char) -> bool {
    matches!(
        c,
        'ˈ' | 'ˌ'
            | 'ː'
            | 'ˑ'
            | '.'
            | '|'
            | '‿'
            | '͡'
            | '͜'
            | '\''
            | '’'
            | '-'
            | '_'
            | '*'
            | '̩'
            | 'ʼ'
            | '˞'
            | '↗'
            | '↘'
    ) || ('\u{300}'..='\u{36f}').contains(&c)
        || ('\u{2b0}'..='\u{2ff}').contains(&c)
        || ('\u{1d2c}'..='\u{1d6a}').contains(&c)
        || ('\u{1d9b}'..='\u{1dbf}').contains(&c)
        || matches!(c, 'ⁿ' | '⁰'..='⁹' | '0'..='9')
        || c.is_whitespace()
}

/// Returns the nearest phones of a word in IPA, which may include stress, length, ties and tones.
///
/// # Errors
/// Returns the first character that is not a symbol.
pub(crate) fn phones(word: &str) -> Result<Vec<Phone>, char> {
    // Composed letters would hide their marks. Only `ç` is a symbol itself.
    let plain: String =
        word.nfc().flat_map(|c| if c == 'ç' { vec![c] } else { c.nfd().collect() }).filter(|c| !is_mark(*c)).collect();
    let mut phones = Vec::new();
    let mut rest = plain.as_str();
    while let Some(first) = rest.chars().next() {
        let (symbol, nearest) = SYMBOLS.iter().find(|(symbol, _)| rest.starts_with(symbol)).ok_or(first)?;
        phones.extend_from_slice(nearest);
        rest = &rest[symbol.len()..];
    }
    Ok(phones)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_become_the_nearest_phones() {
        let cases = [
            ("ˈwɛsnɒθ", "W EH S N AO TH"),
            ("həˈləʊ", "HH AH L OW"),
            ("t͡ʃɪə", "CH IH AH"),
            ("ɡʁyːn", "G R UW N"),
            ("bɔ̃ʒuʁ", "B AO ZH UW R"),
            ("ɲo̞kːi", "N Y OW K IY"),
            ("ˈʔaʊ̯s", "AW S"),
            ("ɪç", "IH HH"),
            ("ɕi˥˩", "SH IY"),
            ("", ""),
        ];
        for (word, expected) in cases {
            let phones = phones(word).expect(word);
            assert_eq!(phones.iter().map(|phone| phone.name()).collect::<Vec<_>>().join(" "), expected, "{word}");
        }
        assert_eq!(phones("wɛ!"), Err('!'));
        assert_eq!(phones("Äh"), Err('A'));
    }

    #[test]
    fn no_symbol_hides_behind_a_shorter_one() {
        for (index, (symbol, _)) in SYMBOLS.iter().enumerate() {
            let hidden = SYMBOLS[..index].iter().find(|(before, _)| symbol.starts_with(before));
            assert_eq!(hidden, None, "{symbol}");
        }
    }
}
