//! Strings of digits: the loops and power transfers of babble.

use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use std::fmt;

/// The maximal number of digits, because a record of the bank has 16 bits for it.
const MAX_DIGITS: usize = u16::MAX as usize;

/// A loop or a power transfer: one or more digits.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Digits(String);

/// Why a text is not a loop.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotDigits {
    /// The text is empty.
    Empty,
    /// A character other than a digit, and its offset in bytes.
    Foreign(char, usize),
    /// There are more digits than a bank can store.
    TooMany,
}

impl Digits {
    /// Parses the digits in `text`.
    ///
    /// ```
    /// use lipz_file::digits::{Digits, NotDigits};
    /// assert_eq!(Digits::parse("0123").map(|digits| digits.to_string()), Ok("0123".to_owned()));
    /// assert_eq!(Digits::parse("01x3"), Err(NotDigits::Foreign('x', 2)));
    /// ```
    ///
    /// # Errors
    /// If there are characters other than digits from 0 to 9, no digits, or more than 65,535 digits.
    pub fn parse(text: &str) -> Result<Digits, NotDigits> {
        if let Some((at, foreign)) = text.char_indices().find(|(_, c)| !c.is_ascii_digit()) {
            return Err(NotDigits::Foreign(foreign, at));
        }
        match text.len() {
            0 => Err(NotDigits::Empty),
            1..=MAX_DIGITS => Ok(Digits(text.to_owned())),
            _ => Err(NotDigits::TooMany),
        }
    }

    /// Returns the digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl NotDigits {
    /// Returns the diagnostic for the setting `name`, whose value is at `value`. `text_start` is the offset of the
    /// value's text in bytes, if it has no escapes: then only the foreign character is marked.
    pub fn diagnostic(self, name: &str, value: Span, text_start: Option<usize>) -> Diagnostic {
        let (what, help) = match self {
            NotDigits::Empty => ("is empty".to_owned(), "write at least one digit; 0 alone keeps the morph still"),
            NotDigits::Foreign(c, _) => {
                let what = format!("contains {}, which is not a digit", escape::character(c));
                (what, "write digits from 0 to 9, one for each position of the morph")
            }
            NotDigits::TooMany => ("has too many digits".to_owned(), "write at most 65,535 digits"),
        };
        let span = match (self, text_start) {
            (NotDigits::Foreign(c, at), Some(start)) => Span::new(start + at, start + at + c.len_utf8()),
            _ => value,
        };
        Diagnostic::at(Code::BabbleDigits, span, format!("`{}` {what}", escape::text(name))).help(help)
    }
}
