//! The transcript of a recording: words with their pronunciations.

use crate::Phone;
use crate::text::numbers;
use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

/// A transcript: the words of a recording in order, with all their pronunciations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Script {
    /// The words, in spoken order.
    pub words: Vec<Word>,
    /// For each `|` of the text, the index of the word after it: ascending, may repeat, may equal `words.len()`.
    pub breaks: Vec<usize>,
}

/// A word of a [`Script`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Word {
    /// The word as written.
    pub text: String,
    /// The bytes of the text from which the word was made.
    pub range: Range<usize>,
    /// All ways to pronounce the word, the most likely first. The aligner chooses the one that fits the recording. A
    /// word without pronunciations is not aligned and takes no time.
    pub pronunciations: Vec<Pronunciation>,
}

impl Script {
    /// Returns the words that are in no lexicon or dictionary, each once, in the order of the text. A person should
    /// check their pronunciations. As lines of a lexicon ([`Word`]'s `Display`), they are ready to be pasted there.
    pub fn guessed(&self) -> impl Iterator<Item = &Word> {
        let mut seen = HashSet::new();
        self.words
            .iter()
            .filter(move |word| word.origin() >= Some(Origin::Rules) && seen.insert(word.text.to_lowercase()))
    }
}

impl Word {
    /// Whether the word is drawn out, such as `Nooo`, `Aaargh` or `Mmmm`: written with a letter three times or more in a
    /// row at its start or end, or four times within it (`Heeeelp`). Its sound may last for seconds.
    ///
    /// Compounds of German have three equal letters within a word (`Schifffahrt`, `Seeelefant`), and Roman numerals at
    /// the end (`VIII`). Neither is drawn out.
    pub fn is_drawn_out(&self) -> bool {
        let letters: Vec<char> = self.text.chars().flat_map(char::to_lowercase).collect();
        let runs: Vec<&[char]> = letters.chunk_by(|one, two| one == two).collect();
        let is_held = |(at, run): (usize, &&[char])| {
            let is_outer = at == 0 || at + 1 == runs.len();
            run.len() >= if is_outer { 3 } else { 4 } && run.iter().all(|c| c.is_alphabetic())
        };
        runs.iter().enumerate().any(is_held) && !numbers::is_roman(&self.text)
    }

    /// Returns the origin of the first pronunciation, or `None` if the word is silent.
    pub fn origin(&self) -> Option<Origin> {
        self.pronunciations.first().map(|pronunciation| pronunciation.origin)
    }
}

/// Prints the word with its first pronunciation, as a line of a lexicon: `Wesnoth  W EH S N AO TH`.
impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.text)?;
        self.pronunciations.first().map_or(Ok(()), |pronunciation| write!(f, " {pronunciation}"))
    }
}

/// Prints the names of the phones, separated by spaces: `W EH S`.
impl fmt::Display for Pronunciation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, phone) in self.phones.iter().enumerate() {
            write!(f, "{}{phone}", if index == 0 { "" } else { " " })?;
        }
        Ok(())
    }
}

/// One way to pronounce a [`Word`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Pronunciation {
    /// The phones in order, without silences.
    pub phones: Vec<Phone>,
    /// The source of the pronunciation.
    pub origin: Origin,
}

/// The source of a [`Pronunciation`], best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Origin {
    /// `{say: …}` in the text.
    Say,
    /// The project's own lexicon.
    Lexicon,
    /// The dictionary of the language.
    Dictionary,
    /// The letter-to-sound rules of the language.
    Rules,
    /// The names of the letters, one by one.
    Letters,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_out_word_has_many_equal_letters_at_an_edge_or_more_within() {
        let is_drawn_out =
            |text: &str| Word { text: text.into(), range: 0..0, pronunciations: Vec::new() }.is_drawn_out();
        for text in ["Nooo", "Aaargh", "Sssh", "Mmmm", "mmm", "Heeeelp", "Ääääh", "Нееее", "Neeeein", "Iiiih", "IIIII"]
        {
            assert!(is_drawn_out(text), "{text}");
        }
        for text in ["III", "VIII", "XXX", "XIII", "Schifffahrt", "Seeelefant", "Brennnessel", "1000", "Ooh", ""] {
            assert!(!is_drawn_out(text), "{text}");
        }
    }
}
