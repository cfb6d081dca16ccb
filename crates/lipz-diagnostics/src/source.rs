//! Positions in source files: byte spans, lines and columns.

use std::ops::Range;

/// A part of a source file, in bytes of its text (without a byte order mark).
///
/// ```
/// use lipz_diagnostics::Span;
/// assert_eq!(&"{ \"fps\": 24 }"[Span::new(2, 7).range()], "\"fps\"");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// The byte after the last one.
    pub end: u32,
}

impl Span {
    /// Returns the span from `start` up to, but not including, `end`. Files are shorter than 4 GiB, see
    /// `lipz_file::MAX_FILE_BYTES`; longer ones saturate.
    pub fn new(start: usize, end: usize) -> Span {
        let clamp = |offset| u32::try_from(offset).unwrap_or(u32::MAX);
        Span { start: clamp(start), end: clamp(end) }
    }

    /// Returns the character of `text` at `place`, or its end. The inverse of [`Source::line_column`], for parsers that
    /// report no offsets.
    ///
    /// ```
    /// use lipz_diagnostics::{LineColumn, Span};
    /// assert_eq!(Span::of_character("a\n\u{fc}b", LineColumn { line: 2, column: 1 }), Span::new(2, 4));
    /// ```
    pub fn of_character(text: &str, place: LineColumn) -> Span {
        let index = |number: u32| (number as usize).saturating_sub(1);
        let line_start: usize = text.split_inclusive('\n').take(index(place.line)).map(str::len).sum();
        let line = &text[line_start..];
        let start = line_start + line.char_indices().nth(index(place.column)).map_or(line.len(), |(at, _)| at);
        let length = text[start..].chars().next().map_or(0, char::len_utf8);
        Span::new(start, start + length)
    }

    /// Returns the span as a range, for slicing.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A line and a column, both from 1. Columns count characters.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct LineColumn {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters (Unicode scalar values), from 1.
    pub column: u32,
}

/// A source file: its name in messages, and its text if there is one.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Source {
    /// Path as given by the user, with `/`.
    pub path: String,
    /// The text, without a byte order mark. Bytes that are not UTF-8 are replaced.
    pub text: String,
}

impl Source {
    /// Returns a file with this name and text.
    pub fn new(path: impl Into<String>, text: impl Into<String>) -> Source {
        Source { path: path.into(), text: text.into() }
    }

    /// Returns line and column of a byte offset; offsets past the end lead to the end. Reads the text up to there. For
    /// thousands of positions, store the starts of lines, as [`render`](crate::render) does.
    pub fn line_column(&self, offset: u32) -> LineColumn {
        let mut offset = (offset as usize).min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &self.text[..offset];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let count = |number: usize| u32::try_from(number + 1).unwrap_or(u32::MAX);
        LineColumn {
            line: count(before.bytes().filter(|&byte| byte == b'\n').count()),
            column: count(before[line_start..].chars().count()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let source = Source { path: String::new(), text: "a\nüö|x".into() };
        assert_eq!(source.line_column(0), LineColumn { line: 1, column: 1 });
        assert_eq!(source.line_column(6), LineColumn { line: 2, column: 3 });
        assert_eq!(source.line_column(5), LineColumn { line: 2, column: 2 });
        assert_eq!(source.line_column(99), LineColumn { line: 2, column: 5 });
    }
}
