//! The members of a file's object, found in one pass, if they are written as nearly all are.

use lipz_file::text::DELIMITER;
use memchr::{memchr, memchr2, memchr3_iter};
use std::ops::Range;

/// A file that is to be read by the full parser.
pub(super) struct Unclean;

/// The members of an object without escapes, and with nothing but strings and numbers in it.
pub(super) struct Members<'s> {
    text: &'s str,
    at: usize,
    /// Control characters that are still to come. All of them must stand between names and values.
    control_count: usize,
    /// Whether a string can have braces.
    pub(super) has_braces: bool,
}

impl<'s> Members<'s> {
    /// Those of a file.
    pub(super) fn of(text: &'s str) -> Result<Members<'s>, Unclean> {
        let bytes = text.as_bytes();
        // Two of them are the braces of the object, and usually there are no others.
        let has_braces = memchr3_iter(b'{', b'}', b'\\', bytes).nth(2).is_some();
        if has_braces && memchr(b'\\', bytes).is_some() {
            return Err(Unclean);
        }
        Ok(Members { text, at: 0, control_count: control_count(bytes), has_braces })
    }

    /// Goes behind `spelled`, if that comes next: white space and names with so many control characters.
    pub(super) fn pass(&mut self, spelled: &str, control_count: usize) -> bool {
        let rest = self.text.as_bytes().get(self.at..).unwrap_or_default();
        let is_next = rest.starts_with(spelled.as_bytes());
        if is_next {
            self.at += spelled.len();
            self.control_count = self.control_count.wrapping_sub(control_count);
        }
        is_next
    }

    /// Goes to the next value: its name, and all that stands before it. `None` behind the last one, at the end of the file.
    pub(super) fn name(&mut self) -> Result<Option<(&'s str, &'s str)>, Unclean> {
        let start = self.at;
        self.white_space();
        match self.byte() {
            Some(b'{') if start == 0 => self.at += 1,
            Some(b',') if start > 0 => self.at += 1,
            Some(b'}') if start > 0 => {
                self.at += 1;
                self.white_space();
                let is_whole = self.at == self.text.len() && self.control_count == 0;
                return if is_whole { Ok(None) } else { Err(Unclean) };
            }
            _ => return Err(Unclean),
        }
        self.white_space();
        let (name, _) = self.string(|_| Ok(()))?;
        self.white_space();
        self.take(b':')?;
        self.white_space();
        Ok(Some((self.text.get(name).ok_or(Unclean)?, self.text.get(start..self.at).ok_or(Unclean)?)))
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

    /// Where a string is, whose segments go to `each`, and how many there are: one look at it finds all of them and its end.
    pub(super) fn string(
        &mut self,
        mut each: impl FnMut(&'s str) -> Result<(), Unclean>,
    ) -> Result<(Range<usize>, usize), Unclean> {
        self.white_space();
        self.take(b'"')?;
        let bytes = self.text.as_bytes();
        let (start, mut count) = (self.at, 0);
        loop {
            let rest = bytes.get(self.at..).ok_or(Unclean)?;
            let end = self.at + memchr2(b'"', DELIMITER as u8, rest).ok_or(Unclean)?;
            each(self.text.get(self.at..end).ok_or(Unclean)?)?;
            self.at = end + 1;
            count += 1;
            if bytes.get(end) == Some(&b'"') {
                return Ok((start..end, count));
            }
        }
    }

    /// Where a number above 0 is, without sign and exponent.
    pub(super) fn number(&mut self) -> Result<Range<usize>, Unclean> {
        self.white_space();
        let rest = self.text.get(self.at..).ok_or(Unclean)?;
        let digits = |from: usize| rest.bytes().skip(from).take_while(u8::is_ascii_digit).count();
        let whole = digits(0);
        let has_fraction = rest.as_bytes().get(whole) == Some(&b'.');
        let fraction = if has_fraction { digits(whole + 1) } else { 0 };
        if whole == 0 || rest.starts_with('0') || has_fraction && fraction == 0 {
            return Err(Unclean);
        }
        let start = self.at;
        self.at += whole + usize::from(has_fraction) + fraction;
        Ok(start..self.at)
    }
}

/// Bytes that are counted in a byte, which makes the loop vector code.
const COUNTED_AT_ONCE: usize = 240;

/// How many control characters there are.
pub(super) fn control_count(bytes: &[u8]) -> usize {
    let count = |chunk: &[u8]| chunk.iter().fold(0_u8, |count, &byte| count.wrapping_add(u8::from(byte < b' ')));
    bytes.chunks(COUNTED_AT_ONCE).map(|chunk| usize::from(count(chunk))).sum()
}
