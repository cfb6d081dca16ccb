//! What is odd about a text or a lexicon.

use std::fmt;
use std::ops::Range;

/// Something that a writer should know about a text or a lexicon. Everything else in it is used.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Problem {
    /// What it is.
    pub kind: ProblemKind,
    /// The bytes that it is about.
    pub range: Range<usize>,
}

/// What may be odd about a text or a lexicon.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum ProblemKind {
    /// A phone that is neither one of ARPAbet nor a symbol of the IPA. The word is said as if nothing had been written.
    UnknownPhone,
    /// `{say name: …}` with a name that is not in the text, or that is longer than 16 words.
    NameNotInText,
    /// Chinese characters that nothing tells how to read. What is said of them is a guess.
    NoReading,
    /// A line of a lexicon with a word and no phones.
    NoPhones,
}

impl ProblemKind {
    /// What to do about it.
    pub fn help(self) -> &'static str {
        match self {
            ProblemKind::UnknownPhone => {
                "write phones of the CMU Pronouncing Dictionary in capitals, such as `HH AH L OW`, or symbols of the IPA"
            }
            ProblemKind::NameNotInText => "write the name as it stands in the text",
            ProblemKind::NoReading => {
                "write the reading behind it, such as `東京{say: とうきょう}`, or into the lexicon"
            }
            ProblemKind::NoPhones => "write the phones behind the word, such as `WESNOTH  W EH S N AO TH`",
        }
    }
}

impl fmt::Display for ProblemKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ProblemKind::UnknownPhone => "this is no phone",
            ProblemKind::NameNotInText => "`say` names words that are not in the text",
            ProblemKind::NoReading => "nothing tells how these characters are read",
            ProblemKind::NoPhones => "the word has no phones",
        })
    }
}
