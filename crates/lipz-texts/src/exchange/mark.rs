//! Marks: eight characters that identify the text at the time of export.

use sha2::{Digest, Sha256};
use std::fmt;
use std::str::FromStr;
use twox_hash::XxHash3_64;

/// The mark of an empty text. It must not start with a character that makes a cell a formula.
const NONE: &str = "none";

/// The mark of a text: empty, or the low half of the XXH3-64 of its UTF-8, as eight hexadecimal digits. It detects
/// whether a text has changed; two texts have the same mark once in four billion times.
///
/// ```
/// use lipz_texts::Mark;
/// let mark = Mark::of("Guten Abend.");
/// assert_eq!(mark.to_string().parse(), Ok(mark));
/// assert_eq!(Mark::of("").to_string(), "none");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Mark(Option<u32>);

impl Mark {
    /// Returns the mark of a text.
    pub fn of(text: &str) -> Mark {
        let low = |hash: u64| u32::try_from(hash & u64::from(u32::MAX)).unwrap_or_default();
        Mark((!text.is_empty()).then(|| low(XxHash3_64::oneshot(text.as_bytes()))))
    }

    /// Returns the mark of translators' comments.
    pub(crate) fn of_comments(comments: &[String]) -> Mark {
        Mark::of(&comments.join("\n"))
    }

    /// Returns the mark of a text in Yarn Spinner: the first 32 bits of its SHA-256.
    pub(crate) fn of_yarn(text: &str) -> Mark {
        let first = |hash: &[u8]| hash.first_chunk().map(|bytes| u32::from_be_bytes(*bytes));
        Mark(first(&Sha256::digest(text.as_bytes())).filter(|_| !text.is_empty()))
    }

    /// Whether this is the mark of a text, made by lipz or by Yarn Spinner.
    pub(crate) fn is_of(self, text: &str) -> bool {
        self == Mark::of(text) || self == Mark::of_yarn(text)
    }
}

impl fmt::Display for Mark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(hash) => write!(f, "{hash:08x}"),
            None => f.write_str(NONE),
        }
    }
}

impl FromStr for Mark {
    type Err = ();

    fn from_str(text: &str) -> Result<Mark, ()> {
        match text.trim() {
            NONE => Ok(Mark(None)),
            digits if digits.len() == 8 => u32::from_str_radix(digits, 16).map(|hash| Mark(Some(hash))).map_err(drop),
            _ => Err(()),
        }
    }
}
