//! What is said in a recording: words with their pronunciations.

use crate::Phone;
use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

/// What is said in a recording: words in order, with all their pronunciations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Script {
    /// The words, in the order in which they are said.
    pub words: Vec<Word>,
    /// For each `|` of the text, the index of the word that it precedes: ascending, may repeat, may equal
    /// `words.len()`.
    pub breaks: Vec<usize>,
}

/// A word of a [`Script`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Word {
    /// The word as it is written.
    pub text: String,
    /// The bytes of the text that it was made from.
    pub range: Range<usize>,
    /// All ways to say it, the most likely first. The aligner chooses the one that is heard. Without any, the
    /// word is not heard and takes no time.
    pub pronunciations: Vec<Pronunciation>,
}

impl Script {
    /// The words that no lexicon or dictionary has, each once, in the order of the text: what was chosen for them is for
    /// somebody to check. As lines of a lexicon ([`Word`]'s `Display`) they are ready to be pasted there.
    pub fn guessed(&self) -> impl Iterator<Item = &Word> {
        let mut seen = HashSet::new();
        self.words
            .iter()
            .filter(move |word| word.origin() >= Some(Origin::Rules) && seen.insert(word.text.to_lowercase()))
    }
}

impl Word {
    /// Where its first pronunciation comes from; none if it is not said.
    pub fn origin(&self) -> Option<Origin> {
        self.pronunciations.first().map(|pronunciation| pronunciation.origin)
    }
}

/// The word with its first pronunciation, as a line of a lexicon: `Wesnoth  W EH S N AO TH`.
impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.text)?;
        self.pronunciations.first().map_or(Ok(()), |pronunciation| write!(f, " {pronunciation}"))
    }
}

/// The names of its phones, with blanks between them: `W EH S`.
impl fmt::Display for Pronunciation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, phone) in self.phones.iter().enumerate() {
            write!(f, "{}{phone}", if index == 0 { "" } else { " " })?;
        }
        Ok(())
    }
}

/// One way to say a [`Word`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Pronunciation {
    /// The phones in order; none of them is silence.
    pub phones: Vec<Phone>,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where a [`Pronunciation`] comes from, best first.
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
    /// The names of its letters, one by one.
    Letters,
}
