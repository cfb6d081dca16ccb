//! Writing systems, as far as they differ in how words are divided and read.

/// How a character is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Writing {
    /// Latin letters.
    Latin,
    /// Cyrillic letters.
    Cyrillic,
    /// Hiragana.
    Hiragana,
    /// Katakana.
    Katakana,
    /// Chinese characters.
    Han,
    /// Korean syllables and letters.
    Hangul,
    /// A script without spaces between words: Thai, Lao, Burmese, Khmer.
    Unspaced,
    /// Digits.
    Digit,
    /// Letters of scripts that leave out some or all vowels: Hebrew, Arabic, Devanagari and its relatives.
    Consonantal,
    /// Letters of any other script.
    Other,
    /// No letter: punctuation, symbols, white space.
    None,
}

/// How a character is read.
pub(crate) fn writing(c: char) -> Writing {
    match c {
        'A'..='Z' | 'a'..='z' => Writing::Latin,
        '0'..='9' => Writing::Digit,
        '\u{aa}'
        | '\u{ba}'
        | '\u{c0}'..='\u{24f}'
        | '\u{1e00}'..='\u{1eff}'
        | '\u{ff21}'..='\u{ff3a}'
        | '\u{ff41}'..='\u{ff5a}' => match c.is_alphabetic() {
            true => Writing::Latin,
            false => Writing::None,
        },
        '\u{400}'..='\u{52f}' | '\u{1c80}'..='\u{1c8f}' => Writing::Cyrillic,
        '\u{e00}'..='\u{eff}' | '\u{1000}'..='\u{109f}' | '\u{1780}'..='\u{17ff}' => Writing::Unspaced,
        '\u{1100}'..='\u{11ff}' | '\u{3130}'..='\u{318f}' | '\u{ac00}'..='\u{d7af}' => Writing::Hangul,
        '\u{3041}'..='\u{309f}' => Writing::Hiragana,
        '\u{30a1}'..='\u{30fa}' | '\u{30fc}'..='\u{30ff}' | '\u{31f0}'..='\u{31ff}' | '\u{ff66}'..='\u{ff9f}' => {
            Writing::Katakana
        }
        '々'
        | '〇'
        | '〆'
        | '\u{3400}'..='\u{4dbf}'
        | '\u{4e00}'..='\u{9fff}'
        | '\u{f900}'..='\u{faff}'
        | '\u{20000}'..='\u{3ffff}' => Writing::Han,
        '\u{590}'..='\u{85f}' | '\u{8a0}'..='\u{dff}' | '\u{fb1d}'..='\u{fdff}' | '\u{fe70}'..='\u{fefc}'
            if c.is_alphabetic() =>
        {
            Writing::Consonantal
        }
        c if c.is_numeric() => Writing::Digit,
        c if c.is_alphabetic() => Writing::Other,
        _ => Writing::None,
    }
}

impl Writing {
    /// Whether what is written so may follow a number without a blank and is a word of its own: `3年`.
    pub(super) fn stands_alone(self) -> bool {
        !matches!(self, Writing::Latin | Writing::Cyrillic | Writing::Consonantal | Writing::Other)
    }

    /// Whether neighbours without anything between them are one word, although Unicode divides them. Chinese
    /// characters are, in Japanese only: elsewhere each of them is a syllable with a reading of its own.
    pub(super) fn joins(self, japanese: bool) -> bool {
        match self {
            Writing::Hiragana | Writing::Katakana | Writing::Unspaced => true,
            Writing::Han => japanese,
            _ => false,
        }
    }
}
