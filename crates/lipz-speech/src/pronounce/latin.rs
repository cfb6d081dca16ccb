//! Reduction of Latin letters to those of English.

use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

/// Returns a word in lower case, as far as possible with only `a` to `z` and apostrophes: without accents, with `ss`
/// for `ß`.
pub(super) fn plain(word: &str) -> String {
    if word.is_ascii() {
        return word.to_ascii_lowercase();
    }
    let mut plain = String::with_capacity(word.len());
    for c in word.nfkd().filter(|c| !is_combining_mark(*c)).flat_map(char::to_lowercase) {
        match c {
            'ß' => plain.push_str("ss"),
            'æ' => plain.push_str("ae"),
            'œ' => plain.push_str("oe"),
            'þ' | 'ð' => plain.push_str("th"),
            'ø' => plain.push('o'),
            'ł' => plain.push('l'),
            'đ' | 'ɖ' => plain.push('d'),
            'ħ' => plain.push('h'),
            'ŋ' => plain.push_str("ng"),
            'ı' => plain.push('i'),
            'ə' => plain.push('e'),
            '’' | 'ʼ' => plain.push('\''),
            c => plain.push(c),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    #[test]
    fn accents_go_and_letters_stay() {
        for (word, plain) in
            [("Café", "cafe"), ("STRAẞE", "strasse"), ("Ærøskøbing", "aeroskobing"), ("l’Été", "l'ete"), ("ﬁn", "fin")]
        {
            assert_eq!(super::plain(word), plain);
        }
    }
}
