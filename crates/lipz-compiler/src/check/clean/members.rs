//! A one-pass parser for the members of a file's object, if the file is written in the most common form.

use lipz_file::text::DELIMITER;
use memchr::{memchr, memchr2, memchr3_iter};
use std::ops::Range;

/// The error for a file that the full parser has to read.
pub(super) struct UncleanFile;

/// The members of an object without escapes that contains only strings and numbers.
pub(super) struct Members<'s> {
    text: &'s str,
    at: usize,
    /// Control characters that are still to come. All of them must be between names and values.
    control_count: usize,
    /// Whether a string can have braces.
    pub(super) has_braces: bool,
}

impl<'s> Members<'s> {
    /// Returns the members of a file.
    pub(super) fn of(text: &'s str) -> Result<Members<'s>, UncleanFile> {
        let bytes = text.as_bytes();
        // Two of them are the braces of the object, and most files do not contain any more.
        let has_braces = memchr3_iter(b'{', b'}', b'\\', bytes).nth(2).is_some();
        if has_braces && memchr(b'\\', bytes).is_some() {
            return Err(UncleanFile);
        }
        Ok(Members { text, at: 0, control_count: control_count(bytes), has_braces })
    }

    /// Skips `spelled` if the file continues with it. `spelled` is white space and names, with this many control
    /// characters.
    pub(super) fn pass(&mut self, spelled: &str, control_count: usize) -> bool {
        let rest = self.text.as_bytes().get(self.at..).unwrap_or_default();
        let is_next = rest.starts_with(spelled.as_bytes());
        if is_next {
            self.at += spelled.len();
            self.control_count = self.control_count.wrapping_sub(control_count);
        }
        is_next
    }

    /// Moves to the next value. Returns its name and all bytes before it, or `None` after the last value, at the end of
    /// the file.
    pub(super) fn name(&mut self) -> Result<Option<(&'s str, &'s str)>, UncleanFile> {
        let start = self.at;
        self.white_space();
        match self.byte() {
            Some(b'{') if start == 0 => self.at += 1,
            Some(b',') if start > 0 => self.at += 1,
            Some(b'}') if start > 0 => {
                self.at += 1;
                self.white_space();
                let is_whole = self.at == self.text.len() && self.control_count == 0;
                return if is_whole { Ok(None) } else { Err(UncleanFile) };
            }
            _ => return Err(UncleanFile),
        }
        self.white_space();
        let (name, _) = self.string(|_| Ok(()))?;
        self.white_space();
        self.take(b':')?;
        self.white_space();
        Ok(Some((self.text.get(name).ok_or(UncleanFile)?, self.text.get(start..self.at).ok_or(UncleanFile)?)))
    }

    fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn take(&mut self, expected: u8) -> Result<(), UncleanFile> {
        if self.byte() != Some(expected) {
            return Err(UncleanFile);
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

    /// Returns the range of a string and the number of its segments, and passes each segment to `each`. A single pass
    /// finds the segments and the end of the string.
    pub(super) fn string(
        &mut self,
        mut each: impl FnMut(&'s str) -> Result<(), UncleanFile>,
    ) -> Result<(Range<usize>, usize), UncleanFile> {
        self.white_space();
        self.take(b'"')?;
        let bytes = self.text.as_bytes();
        let (start, mut count) = (self.at, 0);
        loop {
            let rest = bytes.get(self.at..).ok_or(UncleanFile)?;
            let end = self.at + memchr2(b'"', DELIMITER as u8, rest).ok_or(UncleanFile)?;
            each(self.text.get(self.at..end).ok_or(UncleanFile)?)?;
            self.at = end + 1;
            count += 1;
            if bytes.get(end) == Some(&b'"') {
                return Ok((start..end, count));
            }
        }
    }

    /// Returns the range of a number above 0 without sign and exponent.
    pub(super) fn number(&mut self) -> Result<Range<usize>, UncleanFile> {
        self.white_space();
        let rest = self.text.get(self.at..).ok_or(UncleanFile)?;
        let digits = |from: usize| rest.bytes().skip(from).take_while(u8::is_ascii_digit).count();
        let whole = digits(0);
        let has_fraction = rest.as_bytes().get(whole) == Some(&b'.');
        let fraction = if has_fraction { digits(whole + 1) } else { 0 };
        if whole == 0 || rest.starts_with('0') || has_fraction && fraction == 0 {
            return Err(UncleanFile);
        }
        let start = self.at;
        self.at += whole + usize::from(has_fraction) + fraction;
        Ok(start..self.at)
    }
}

/// Bytes in a chunk whose count fits into a byte, so that the compiler vectorises the loop.
const COUNTED_AT_ONCE: usize = 240;

/// Returns the number of control characters.
pub(super) fn control_count(bytes: &[u8]) -> usize {
    let count = |chunk: &[u8]| chunk.iter().fold(0_u8, |count, &byte| count.wrapping_add(u8::from(byte < b' ')));
    bytes.chunks(COUNTED_AT_ONCE).map(|chunk| usize::from(count(chunk))).sum()
}
