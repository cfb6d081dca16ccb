//! What JSON expects next, read if it is there.

use super::{Expected, Literal, Open, Read, Scan};
use crate::parse::syntax::{WHITE_SPACE, explain};

impl<'s> Scan<'s, '_> {
    /// The text that is not read yet.
    pub(super) fn rest(&self) -> &'s str {
        self.text.get(self.at..).unwrap_or_default()
    }

    pub(super) fn byte(&self, at: usize) -> Option<u8> {
        self.text.as_bytes().get(at).copied()
    }

    pub(super) fn white_space(&mut self) {
        self.at = self.text.len() - self.rest().trim_start_matches(WHITE_SPACE).len();
    }

    /// Reads a token if it is what was expected, and says whether reading goes on.
    pub(super) fn token(&mut self) -> Option<bool> {
        match (self.expected, self.byte(self.at)?) {
            (Expected::Name, b'"') => return Some(self.string()),
            (Expected::Name, b'}') if self.is_first => self.close(),
            (Expected::Colon, b':') => self.step(Expected::Value),
            (Expected::Value, b'"') => return Some(self.string()),
            (Expected::Value, b'{') => self.open(Open::Object),
            (Expected::Value, b'[') => self.open(Open::Array),
            (Expected::Value, b']') if self.is_first => self.close(),
            (Expected::Value, b'-' | b'0'..=b'9') => return Some(self.number()),
            (Expected::Value, b't') => return Some(self.word("true")),
            (Expected::Value, b'f') => return Some(self.word("false")),
            (Expected::Value, b'n') => return Some(self.word("null")),
            (Expected::Comma, b',') => self.step(self.behind_comma()),
            (Expected::Comma, b'}') if self.open.last() == Some(&Open::Object) => self.close(),
            (Expected::Comma, b']') if self.open.last() == Some(&Open::Array) => self.close(),
            _ => return None,
        }
        self.read = self.at;
        Some(true)
    }

    fn step(&mut self, expected: Expected) {
        self.at += 1;
        self.read = self.at;
        self.is_first = false;
        self.expected = expected;
    }

    pub(super) fn open(&mut self, open: Open) {
        if self.open.len() == 1 {
            (self.value_start, self.is_damaged) = (self.at, false);
        }
        self.open.push(open);
        self.step(self.behind_comma());
        self.is_first = true;
    }

    fn close(&mut self) {
        self.at += 1;
        self.open.pop();
        self.expected = Expected::Comma;
        self.is_first = false;
        if self.open.len() == 1 {
            let value = self.text.get(self.value_start..self.at).filter(|_| !self.is_damaged);
            self.value(value.map(Literal::Json));
        }
    }

    /// A string, if it is expected: a name or a value.
    fn string(&mut self) -> bool {
        let start = self.at;
        let literal = match self.read_string() {
            Read::Whole => self.text.get(start..self.at).map(Literal::Json),
            Read::Damaged => None,
            Read::Unclosed(next) => return self.resume_behind_string(next),
            Read::End => return false,
        };
        self.read = self.at;
        if self.expected == Expected::Name {
            self.named(literal);
        } else {
            self.value(literal);
        }
        true
    }

    /// The name of an element has been read; none if it cannot be.
    pub(super) fn named(&mut self, name: Option<Literal<'s>>) {
        if self.open.len() == 1 {
            self.name = name;
        }
        self.is_first = false;
        self.expected = Expected::Colon;
    }

    /// A value has been read; none if it cannot be.
    pub(super) fn value(&mut self, value: Option<Literal<'s>>) {
        self.is_first = false;
        self.expected = Expected::Comma;
        if self.open.len() != 1 {
            self.is_damaged |= value.is_none();
            return;
        }
        self.has_last = false;
        match (self.name.take(), value) {
            (Some(name), Some(value)) => {
                self.found.members.push((name, value));
                self.has_last = true;
            }
            _ => self.found.is_complete = false,
        }
    }

    fn number(&mut self) -> bool {
        let start = self.at;
        let digits =
            |at: usize| (at..).take_while(|&at| self.byte(at).is_some_and(|byte| byte.is_ascii_digit())).count();
        let at = start + usize::from(self.byte(start) == Some(b'-'));
        // A leading zero stands alone.
        let mut parts = Ok(if self.byte(at) == Some(b'0') { at + 1 } else { at + digits(at) });
        let some_digits = |at: usize| match digits(at) {
            0 => Err(at),
            count => Ok(at + count),
        };
        if parts == Ok(at) {
            parts = Err(at);
        }
        let parts = parts.and_then(|at| match self.byte(at) {
            Some(b'0'..=b'9') => Err(at),
            Some(b'.') => some_digits(at + 1),
            _ => Ok(at),
        });
        let parts = parts.and_then(|at| match self.byte(at) {
            Some(b'e' | b'E') => some_digits(at + 1 + usize::from(matches!(self.byte(at + 1), Some(b'+' | b'-')))),
            _ => Ok(at),
        });
        self.literal(start, parts, Expected::Number)
    }

    /// One of JSON's words.
    fn word(&mut self, word: &str) -> bool {
        let differs = word.bytes().zip(self.at..).find(|(letter, at)| self.byte(*at) != Some(*letter));
        self.literal(self.at, differs.map_or(Ok(self.at + word.len()), |(_, at)| Err(at)), Expected::Word)
    }

    /// A literal up to its end, or with the first byte that does not belong to it.
    fn literal(&mut self, start: usize, end: Result<usize, usize>, expected: Expected) -> bool {
        match end {
            Ok(end) => {
                (self.at, self.read) = (end, end);
                self.value(self.text.get(start..end).map(Literal::Json));
                true
            }
            Err(at) if at >= self.text.len() => {
                self.at = self.text.len();
                self.end();
                false
            }
            Err(at) => {
                self.at = at;
                self.mistake(explain(&self.place(), expected))
            }
        }
    }
}
