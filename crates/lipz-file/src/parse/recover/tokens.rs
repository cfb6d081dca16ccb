//! Reads the token that JSON expects next, if it is there.

use super::{Container, ExpectedToken, Literal, Scan, StringOutcome};
use crate::parse::syntax::{WHITE_SPACE, explain};

impl<'s> Scan<'s, '_> {
    /// Returns the text that is not read yet.
    pub(super) fn rest(&self) -> &'s str {
        self.text.get(self.at..).unwrap_or_default()
    }

    pub(super) fn byte(&self, at: usize) -> Option<u8> {
        self.text.as_bytes().get(at).copied()
    }

    pub(super) fn white_space(&mut self) {
        self.at = self.text.len() - self.rest().trim_start_matches(WHITE_SPACE).len();
    }

    /// Reads a token if it is expected. Returns whether parsing continues.
    pub(super) fn token(&mut self) -> Option<bool> {
        match (self.expected, self.byte(self.at)?) {
            (ExpectedToken::Name, b'"') => return Some(self.string()),
            (ExpectedToken::Name, b'}') if self.is_first => self.close(),
            (ExpectedToken::Colon, b':') => self.step(ExpectedToken::Value),
            (ExpectedToken::Value, b'"') => return Some(self.string()),
            (ExpectedToken::Value, b'{') => self.open(Container::Object),
            (ExpectedToken::Value, b'[') => self.open(Container::Array),
            (ExpectedToken::Value, b']') if self.is_first => self.close(),
            (ExpectedToken::Value, b'-' | b'0'..=b'9') => return Some(self.number()),
            (ExpectedToken::Value, b't') => return Some(self.word("true")),
            (ExpectedToken::Value, b'f') => return Some(self.word("false")),
            (ExpectedToken::Value, b'n') => return Some(self.word("null")),
            (ExpectedToken::Comma, b',') => self.step(self.behind_comma()),
            (ExpectedToken::Comma, b'}') if self.open.last() == Some(&Container::Object) => self.close(),
            (ExpectedToken::Comma, b']') if self.open.last() == Some(&Container::Array) => self.close(),
            _ => return None,
        }
        self.read = self.at;
        Some(true)
    }

    fn step(&mut self, expected: ExpectedToken) {
        self.at += 1;
        self.read = self.at;
        self.is_first = false;
        self.expected = expected;
    }

    pub(super) fn open(&mut self, open: Container) {
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
        self.expected = ExpectedToken::Comma;
        self.is_first = false;
        if self.open.len() == 1 {
            let value = self.text.get(self.value_start..self.at).filter(|_| !self.is_damaged);
            self.value(value.map(Literal::Json));
        }
    }

    /// Reads a string, if one is expected: a name or a value.
    fn string(&mut self) -> bool {
        let start = self.at;
        let literal = match self.read_string() {
            StringOutcome::Whole => self.text.get(start..self.at).map(Literal::Json),
            StringOutcome::Damaged => None,
            StringOutcome::Unclosed(next) => return self.resume_behind_string(next),
            StringOutcome::End => return false,
        };
        self.read = self.at;
        if self.expected == ExpectedToken::Name {
            self.named(literal);
        } else {
            self.value(literal);
        }
        true
    }

    /// Records the name of an element; `None` if it is unreadable.
    pub(super) fn named(&mut self, name: Option<Literal<'s>>) {
        if self.open.len() == 1 {
            self.name = name;
        }
        self.is_first = false;
        self.expected = ExpectedToken::Colon;
    }

    /// Records a value; `None` if it is unreadable.
    pub(super) fn value(&mut self, value: Option<Literal<'s>>) {
        self.is_first = false;
        self.expected = ExpectedToken::Comma;
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
        // A leading zero is the only digit.
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
        self.literal(start, parts, ExpectedToken::Number)
    }

    /// Reads `true`, `false` or `null`.
    fn word(&mut self, word: &str) -> bool {
        let differs = word.bytes().zip(self.at..).find(|(letter, at)| self.byte(*at) != Some(*letter));
        self.literal(self.at, differs.map_or(Ok(self.at + word.len()), |(_, at)| Err(at)), ExpectedToken::Word)
    }

    /// Reads a literal up to `end`, which is an error at the first byte that does not belong to it.
    fn literal(&mut self, start: usize, end: Result<usize, usize>, expected: ExpectedToken) -> bool {
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
