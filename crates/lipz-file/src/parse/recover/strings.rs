//! Strings with errors.

use super::{ExpectedToken, Scan};
use crate::parse::syntax::{self, starts_element};

/// The result of reading a string.
pub(super) enum StringOutcome {
    /// It is a valid JSON string.
    Whole,
    /// It ends, but contains an error, which is reported.
    Damaged,
    /// It is not closed, and the next element starts here.
    Unclosed(usize),
    /// The file ends inside it.
    End,
}

impl Scan<'_, '_> {
    /// Reads the string at this position, and reports its errors.
    pub(super) fn read_string(&mut self) -> StringOutcome {
        let mut is_whole = true;
        self.at += 1;
        loop {
            let special = self.rest().bytes().position(|byte| matches!(byte, b'"' | b'\\' | 0..=0x1F));
            let Some(special) = special else { return self.ends_in_string(is_whole) };
            self.at += special;
            match self.byte(self.at) {
                Some(b'"') => {
                    self.at += 1;
                    return if is_whole { StringOutcome::Whole } else { StringOutcome::Damaged };
                }
                Some(b'\\') => match self.escape_length() {
                    Ok(length) => self.at += length,
                    Err(at) if at >= self.text.len() => return self.ends_in_string(is_whole),
                    Err(at) => {
                        is_whole = false;
                        self.report(syntax::escape(&self.place()));
                        self.at = at;
                    }
                },
                control => {
                    is_whole = false;
                    self.report(syntax::control_character(&self.place()));
                    if matches!(control, Some(b'\n' | b'\r')) {
                        self.white_space();
                        if self.rest().is_empty() {
                            return self.ends_in_string(false);
                        }
                        if starts_element(self.rest()) || self.rest().starts_with('}') {
                            return StringOutcome::Unclosed(self.at);
                        }
                    } else {
                        let run = self.byte(self.at).map_or('\0', char::from);
                        self.at = self.text.len() - self.rest().trim_start_matches(run).len();
                    }
                }
            }
        }
    }

    /// Returns the length of the escape at this position, or the point to continue if it is not valid in JSON.
    fn escape_length(&self) -> Result<usize, usize> {
        let digits =
            |at: usize| (at..at + 4).take_while(|&at| self.byte(at).is_some_and(|b| b.is_ascii_hexdigit())).count();
        match self.byte(self.at + 1) {
            Some(b'"' | b'\\' | b'/' | b'b' | b'f' | b'n' | b'r' | b't') => Ok(2),
            Some(b'u') => match digits(self.at + 2) {
                4 => Ok(6),
                count => Err(self.at + 2 + count),
            },
            // The remaining bytes of a multi-byte character are part of the string.
            Some(letter) if letter >= b' ' => Err(self.text.ceil_char_boundary(self.at + 2)),
            Some(_) => Err(self.at + 1),
            None => Err(self.text.len()),
        }
    }

    /// Ends the file inside a string, and reports that unless the string has another error.
    fn ends_in_string(&mut self, is_whole: bool) -> StringOutcome {
        self.at = self.text.len();
        self.is_sure &= is_whole;
        self.end();
        StringOutcome::End
    }

    /// Continues with the element after a string that is not closed.
    pub(super) fn resume_behind_string(&mut self, next: usize) -> bool {
        self.expected = ExpectedToken::Value;
        self.damaged();
        self.is_sure = false;
        self.resume(next)
    }
}
