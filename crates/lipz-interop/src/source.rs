//! The common parts of text format readers: decoding, lines with positions, numbers.

use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// Returns the text of a file. A byte order mark, which tools on Windows write, is skipped.
pub(crate) fn text<'s>(bytes: &'s [u8], diagnostics: &mut Vec<Diagnostic>) -> Option<&'s str> {
    lipz_file::decode_marked(bytes, diagnostics)
}

/// Returns the lines of a text without their ends, with their offsets in bytes.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    lines_of(text, '\n').map(|line| Line { text: line.text.strip_suffix('\r').unwrap_or(line.text), ..line })
}

/// Returns the lines of a text that end with this character, without it, with their offsets in bytes.
pub(crate) fn lines_of(text: &str, end: char) -> impl Iterator<Item = Line<'_>> {
    let mut start = 0;
    text.split_inclusive(end).map(move |line| {
        let at = start;
        start += line.len();
        Line { text: line.strip_suffix(end).unwrap_or(line), at }
    })
}

/// A part of a text with its position: a line, or a field of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'s> {
    pub(crate) text: &'s str,
    /// Its offset in bytes.
    pub(crate) at: usize,
}

impl<'s> Line<'s> {
    /// Returns its span.
    pub(crate) fn span(self) -> Span {
        Span::new(self.at, self.at + self.text.len())
    }

    /// Returns it without spaces at its ends.
    pub(crate) fn trimmed(self) -> Line<'s> {
        let start = self.text.len() - self.text.trim_start().len();
        Line { text: self.text.trim(), at: self.at + start }
    }

    /// Returns the parts before and after the first `separator`, trimmed.
    pub(crate) fn split_once(self, separator: char) -> Option<(Line<'s>, Line<'s>)> {
        let (before, after) = self.text.split_once(separator)?;
        let behind = self.at + before.len() + separator.len_utf8();
        Some((Line { text: before, at: self.at }.trimmed(), Line { text: after, at: behind }.trimmed()))
    }

    /// Returns the fields separated by whitespace.
    pub(crate) fn fields(self) -> impl Iterator<Item = Line<'s>> {
        let start = self.text.as_ptr() as usize;
        self.text.split_whitespace().map(move |text| Line { text, at: self.at + (text.as_ptr() as usize - start) })
    }

    /// Returns a diagnostic about it.
    pub(crate) fn diagnostic(self, code: Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(code, self.span(), message)
    }

    /// Returns the diagnostic for a value that the format does not allow here.
    pub(crate) fn not(self, what: &str) -> Diagnostic {
        let message = match self.text.is_empty() {
            true => format!("{what} is missing"),
            false => format!("{} is not {what}", escape::quoted(self.text)),
        };
        self.diagnostic(Code::ForeignSyntax, message)
    }

    /// Parses a number of frames or units.
    pub(crate) fn number(self, what: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<u64> {
        let number = self.text.parse().ok();
        if number.is_none() {
            diagnostics.push(self.not(what));
        }
        number
    }
}

/// Returns the diagnostic for a file that ends too early.
pub(crate) fn cut_off(text: &str, missing: &str) -> Diagnostic {
    let end = text.trim_end().len();
    Diagnostic::at(Code::ForeignCutOff, Span::new(end, end), format!("the file ends too early: {missing}"))
        .help("make or copy the file again; the copy or the tool may have been interrupted")
}
