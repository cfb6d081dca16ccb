//! Rows of CSV (RFC 4180) with the positions of their cells, for scripts and the files of translators.
//!
//! Most readers of CSV accept a quote that is not closed, which joins all further rows into one cell. This one refuses
//! it.
//!
//! ```
//! use lipz_file::table::Rows;
//! let rows: Vec<_> = Rows::new("key,de-de\na,\"Ja, \"\"gern\"\".\"\n", b',').collect::<Result<_, _>>()?;
//! assert_eq!(rows[1][1].text, "Ja, \"gern\".");
//! # Ok::<(), lipz_file::table::QuoteFault>(())
//! ```

use lipz_diagnostics::{Code, Diagnostic, Span};
use std::borrow::Cow;

/// A cell: its value and position.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Cell<'t> {
    /// The value: without the quotes around it, and with one quote for each two in it.
    pub text: Cow<'t, str>,
    /// The bytes of the table between the quotes, or all of the cell.
    pub span: Span,
    /// The offset of the character after the cell.
    end: usize,
}

/// An ambiguous quote. The columns of all cells after it are uncertain.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct QuoteFault {
    /// The opening quote of the cell.
    quote: Span,
    /// The text after its closing quote; `None` if no quote closes the cell.
    behind: Option<Span>,
}

impl QuoteFault {
    /// Returns the error, with this code.
    pub fn diagnostic(self, code: Code) -> Diagnostic {
        match self.behind {
            None => Diagnostic::at(code, self.quote, "the cell that starts with this quote is not closed").help(
                "close the cell with `\"`, write a quote in the text twice (`\"\"`), or copy the file again if it was cut \
                off",
            ),
            Some(behind) => Diagnostic::at(code, behind, "text follows the quote that closes a cell")
                .also(self.quote, "the cell starts here")
                .help("put a separator after the quote, or write a quote in the text twice: `\"\"`"),
        }
    }
}

/// Iterates over the rows of a table and skips empty lines. Ends after the first error.
#[derive(Clone, Debug)]
pub struct Rows<'t> {
    text: &'t str,
    separator: u8,
    has_quotes: bool,
    /// The offset of the next row.
    at: usize,
}

impl<'t> Rows<'t> {
    /// Returns the rows of a table, whose cells this ASCII character separates.
    pub fn new(text: &'t str, separator: u8) -> Rows<'t> {
        Rows { text, separator, has_quotes: true, at: 0 }
    }

    /// Reads quotes as text.
    #[must_use]
    pub fn without_quotes(self) -> Rows<'t> {
        Rows { has_quotes: false, ..self }
    }

    fn rest(&self, at: usize) -> &'t str {
        self.text.get(at..).unwrap_or_default()
    }

    /// Returns the cell at `at`, which ends before a separator, a line break or the end of the text.
    fn cell(&self, at: usize) -> Result<Cell<'t>, QuoteFault> {
        let rest = self.rest(at);
        if let Some(quoted) = rest.strip_prefix('"').filter(|_| self.has_quotes) {
            return self.quoted(at, quoted);
        }
        let length = rest.bytes().position(|byte| self.is_end(byte)).unwrap_or(rest.len());
        let end = at + length;
        Ok(Cell { text: rest.get(..length).unwrap_or_default().into(), span: Span::new(at, end), end })
    }

    /// Returns the cell whose opening quote is at `at`, before `quoted`.
    fn quoted(&self, at: usize, quoted: &'t str) -> Result<Cell<'t>, QuoteFault> {
        let quote = Span::new(at, at + 1);
        let mut length = 0;
        loop {
            let next = quoted.get(length..).and_then(|rest| rest.find('"'));
            length += next.ok_or(QuoteFault { quote, behind: None })?;
            if quoted.as_bytes().get(length + 1) != Some(&b'"') {
                break;
            }
            length += 2;
        }
        let end = at + length + 2;
        let behind = self.rest(end).chars().next();
        if let Some(behind) = behind.filter(|next| !next.is_ascii() || !self.is_end(*next as u8)) {
            return Err(QuoteFault { quote, behind: Some(Span::new(end, end + behind.len_utf8())) });
        }
        let text = quoted.get(..length).unwrap_or_default();
        let text = if text.contains('"') { text.replace("\"\"", "\"").into() } else { text.into() };
        Ok(Cell { text, span: Span::new(at + 1, end - 1), end })
    }

    fn is_end(&self, byte: u8) -> bool {
        byte == self.separator || matches!(byte, b'\r' | b'\n')
    }
}

impl<'t> Iterator for Rows<'t> {
    type Item = Result<Vec<Cell<'t>>, QuoteFault>;

    fn next(&mut self) -> Option<Self::Item> {
        self.at += self.rest(self.at).bytes().take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
        if self.at >= self.text.len() {
            return None;
        }
        let mut cells = Vec::new();
        loop {
            let cell = match self.cell(self.at) {
                Ok(cell) => cell,
                Err(fault) => {
                    self.at = self.text.len();
                    return Some(Err(fault));
                }
            };
            self.at = cell.end;
            cells.push(cell);
            if self.rest(self.at).as_bytes().first() != Some(&self.separator) {
                return Some(Ok(cells));
            }
            self.at += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_positions() {
        let text = "a,\"b, \"\"c\"\"\n\"\r\n\r\n,\"\",d \"e\"\n";
        let rows: Vec<Vec<Cell<'_>>> = Rows::new(text, b',').map(Result::unwrap).collect();
        let texts: Vec<Vec<&str>> = rows.iter().map(|row| row.iter().map(|cell| &*cell.text).collect()).collect();
        assert_eq!(texts, [vec!["a", "b, \"c\"\n"], vec!["", "", "d \"e\""]]);
        let written = |cell: &Cell<'_>| &text[cell.span.start as usize..cell.span.end as usize];
        assert_eq!(rows.iter().flatten().map(written).collect::<Vec<_>>(), ["a", "b, \"\"c\"\"\n", "", "", "d \"e\""]);
        let raw = Rows::new("a\t\"b\" c\n", b'\t').without_quotes().next().unwrap().unwrap();
        assert_eq!(raw[1].text, "\"b\" c");
        assert_eq!(Rows::new("\r\n\na,", b',').next().unwrap().unwrap().len(), 2);
    }

    #[test]
    fn ambiguous_quotes_are_errors_at_their_positions() {
        for (text, behind, start, length) in [
            ("a,\"b\nc,d\n", false, 2, 1),
            ("a,\"", false, 2, 1),
            ("a,\"b\nc,\"d\"\n", true, 8, 1),
            ("a,\"b\" c\n", true, 5, 1),
            ("\"b\"\u{e4},\"c\n", true, 3, 2),
        ] {
            let faults: Vec<QuoteFault> = Rows::new(text, b',').filter_map(Result::err).collect();
            let [fault] = faults.as_slice() else { panic!("{text}: {faults:?}") };
            let place = fault.behind.unwrap_or(fault.quote);
            assert_eq!((fault.behind.is_some(), place), (behind, Span::new(start, start + length)), "{text}");
        }
    }
}
