//! The members of a file's object, found in one pass, if they are written as nearly all are.

use memchr::{memchr, memchr2};

/// A file that is to be read by the full parser.
pub(super) struct Unclean;

/// What stands behind a name.
pub(super) enum Value<'s> {
    String(&'s str),
    Number(&'s str),
}

/// The members of an object without escapes, and with nothing but strings and numbers in it.
pub(super) struct Members<'s> {
    text: &'s str,
    at: usize,
    /// Control characters that are still to come. All of them must stand between names and values.
    control_count: usize,
    is_first: bool,
    /// Whether a string can have braces.
    pub(super) has_braces: bool,
}

impl<'s> Members<'s> {
    /// Those of a file.
    pub(super) fn of(text: &'s str) -> Result<Members<'s>, Unclean> {
        let bytes = text.as_bytes();
        if memchr(b'\\', bytes).is_some() {
            return Err(Unclean);
        }
        let (control_count, brace_count) = counts(bytes);
        let mut members = Members { text, at: 0, control_count, is_first: true, has_braces: brace_count > 2 };
        members.white_space();
        members.take(b'{')?;
        Ok(members)
    }

    /// The next member; `None` behind the last one, at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<(&'s str, Value<'s>)>, Unclean> {
        self.white_space();
        match (self.byte(), std::mem::take(&mut self.is_first)) {
            (Some(b','), false) => {
                self.at += 1;
                self.white_space();
            }
            (Some(b'"'), true) => {}
            (Some(b'}'), false) => {
                self.at += 1;
                self.white_space();
                let is_whole = self.at == self.text.len() && self.control_count == 0;
                return if is_whole { Ok(None) } else { Err(Unclean) };
            }
            _ => return Err(Unclean),
        }
        let name = self.string()?;
        self.white_space();
        self.take(b':')?;
        self.white_space();
        let value = match self.byte() {
            Some(b'"') => Value::String(self.string()?),
            _ => Value::Number(self.number()?),
        };
        Ok(Some((name, value)))
    }

    fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn take(&mut self, expected: u8) -> Result<(), Unclean> {
        if self.byte() != Some(expected) {
            return Err(Unclean);
        }
        self.at += 1;
        Ok(())
    }

    fn white_space(&mut self) {
        while let Some(byte @ (b' ' | b'\t' | b'\n' | b'\r')) = self.byte() {
            self.control_count = self.control_count.wrapping_sub(usize::from(byte != b' '));
            self.at += 1;
        }
    }

    fn string(&mut self) -> Result<&'s str, Unclean> {
        self.take(b'"')?;
        let rest = self.text.get(self.at..).ok_or(Unclean)?;
        let length = memchr(b'"', rest.as_bytes()).ok_or(Unclean)?;
        self.at += length + 1;
        rest.get(..length).ok_or(Unclean)
    }

    /// A number above 0 without sign and exponent.
    fn number(&mut self) -> Result<&'s str, Unclean> {
        let rest = self.text.get(self.at..).ok_or(Unclean)?;
        let digits = |from: usize| rest.bytes().skip(from).take_while(u8::is_ascii_digit).count();
        let whole = digits(0);
        let has_fraction = rest.as_bytes().get(whole) == Some(&b'.');
        let fraction = if has_fraction { digits(whole + 1) } else { 0 };
        if whole == 0 || rest.starts_with('0') || has_fraction && fraction == 0 {
            return Err(Unclean);
        }
        let length = whole + usize::from(has_fraction) + fraction;
        self.at += length;
        rest.get(..length).ok_or(Unclean)
    }
}

/// Bytes that are counted in a byte, which makes the loop vector code.
const COUNTED_AT_ONCE: usize = 240;

/// How many control characters there are, and how many braces.
fn counts(bytes: &[u8]) -> (usize, usize) {
    let count = |chunk: &[u8], is_counted: fn(u8) -> bool| -> usize {
        let count = chunk.iter().fold(0_u8, |count, &byte| count.wrapping_add(u8::from(is_counted(byte))));
        usize::from(count)
    };
    bytes.chunks(COUNTED_AT_ONCE).fold((0, 0), |(controls, braces), chunk| {
        let controls = controls + count(chunk, |byte| byte < b' ');
        (controls, braces + count(chunk, |byte| byte == b'{' || byte == b'}'))
    })
}

/// Whether a string has `{meta}`, or a brace alone.
pub(super) fn has_braces(string: &str) -> bool {
    memchr2(b'{', b'}', string.as_bytes()).is_some()
}
