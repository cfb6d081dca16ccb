//! Problems in a text or a lexicon.

use std::fmt;
use std::ops::Range;

/// A problem that a writer should fix in a text or a lexicon. The rest of it is used regardless.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Problem {
    /// The kind of problem.
    pub kind: ProblemKind,
    /// The affected bytes.
    pub range: Range<usize>,
}

/// The kinds of problem in a text or a lexicon.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum ProblemKind {
    /// A phone that is neither in ARPAbet nor an IPA symbol. The word is pronounced as if it had no annotation.
    UnknownPhone,
    /// `{say name: …}` with a name that is missing from the text, or has more than 16 words.
    NameNotInText,
    /// Chinese characters without a reading. Their pronunciation is a guess.
    NoReading,
    /// A line of a lexicon that has a word but no phones.
    NoPhones,
}

impl ProblemKind {
    /// Returns advice for fixing the problem.
    pub fn help(self) -> &'static str {
        match self {
            ProblemKind::UnknownPhone => {
                "write phones of the CMU Pronouncing Dictionary in capitals, such as `HH AH L OW`, or symbols of the IPA"
            }
            ProblemKind::NameNotInText => "write the name as in the text",
            ProblemKind::NoReading => {
                "write the reading after it, such as `東京{say: とうきょう}`, or into the lexicon"
            }
            ProblemKind::NoPhones => "write the phones after the word, such as `WESNOTH  W EH S N AO TH`",
        }
    }
}

impl fmt::Display for ProblemKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ProblemKind::UnknownPhone => "this is not a phone",
            ProblemKind::NameNotInText => "`say` names words that are not in the text",
            ProblemKind::NoReading => "these characters have no reading",
            ProblemKind::NoPhones => "the word has no phones",
        })
    }
}
