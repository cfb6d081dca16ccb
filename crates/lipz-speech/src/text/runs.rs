//! Writing systems, classified by how words are divided and read.

/// The writing system of a character.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WritingSystem {
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
    /// Not a letter: punctuation, symbols, whitespace.
    None,
}

/// Returns the writing system of a character.
pub(crate) fn writing(c: char) -> WritingSystem {
    match c {
        'A'..='Z' | 'a'..='z' => WritingSystem::Latin,
        '0'..='9' => WritingSystem::Digit,
        '\u{aa}'
        | '\u{ba}'
        | '\u{c0}'..='\u{24f}'
        | '\u{1e00}'..='\u{1eff}'
        | '\u{ff21}'..='\u{ff3a}'
        | '\u{ff41}'..='\u{ff5a}' => match c.is_alphabetic() {
            true => WritingSystem::Latin,
            false => WritingSystem::None,
        },
        '\u{400}'..='\u{52f}' | '\u{1c80}'..='\u{1c8f}' => WritingSystem::Cyrillic,
        '\u{e00}'..='\u{eff}' | '\u{1000}'..='\u{109f}' | '\u{1780}'..='\u{17ff}' => WritingSystem::Unspaced,
        '\u{1100}'..='\u{11ff}' | '\u{3130}'..='\u{318f}' | '\u{ac00}'..='\u{d7af}' => WritingSystem::Hangul,
        '\u{3041}'..='\u{309f}' => WritingSystem::Hiragana,
        '\u{30a1}'..='\u{30fa}' | '\u{30fc}'..='\u{30ff}' | '\u{31f0}'..='\u{31ff}' | '\u{ff66}'..='\u{ff9f}' => {
            WritingSystem::Katakana
        }
        '々'
        | '〇'
        | '〆'
        | '\u{3400}'..='\u{4dbf}'
        | '\u{4e00}'..='\u{9fff}'
        | '\u{f900}'..='\u{faff}'
        | '\u{20000}'..='\u{3ffff}' => WritingSystem::Han,
        '\u{590}'..='\u{85f}' | '\u{8a0}'..='\u{dff}' | '\u{fb1d}'..='\u{fdff}' | '\u{fe70}'..='\u{fefc}'
            if c.is_alphabetic() =>
        {
            WritingSystem::Consonantal
        }
        c if c.is_numeric() => WritingSystem::Digit,
        c if c.is_alphabetic() => WritingSystem::Other,
        _ => WritingSystem::None,
    }
}

impl WritingSystem {
    /// Whether a word in this script may directly follow a number: `3年`.
    pub(super) fn stands_alone(self) -> bool {
        !matches!(
            self,
            WritingSystem::Latin | WritingSystem::Cyrillic | WritingSystem::Consonantal | WritingSystem::Other
        )
    }

    /// Whether adjacent characters form one word, although Unicode divides them. For Chinese characters, this applies
    /// to Japanese only. In other languages, each of them is a syllable with its own reading.
    pub(super) fn joins(self, japanese: bool) -> bool {
        match self {
            WritingSystem::Hiragana | WritingSystem::Katakana | WritingSystem::Unspaced => true,
            WritingSystem::Han => japanese,
            _ => false,
        }
    }
}
