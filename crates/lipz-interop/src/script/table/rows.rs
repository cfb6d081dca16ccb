//! Rows of CSV with the positions of their cells. Unlike most readers of CSV, this one refuses open quotes, which would
//! silently join rows.

use lipz_diagnostics::{Code, Diagnostic, Span};
use std::borrow::Cow;

/// A cell: its value and position.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Cell<'t> {
    pub(super) text: Cow<'t, str>,
    /// With its quotes.
    pub(super) span: Span,
}

/// The rows of a table, without empty lines. After an error, there are no more rows.
pub(super) struct Rows<'t> {
    text: &'t str,
    delimiter: u8,
    has_quotes: bool,
    /// The offset of the next row.
    at: usize,
}

impl<'t> Rows<'t> {
    pub(super) fn new(text: &'t str, delimiter: u8) -> Rows<'t> {
        Rows { text, delimiter, has_quotes: true, at: 0 }
    }

    /// Reads quotes as text.
    pub(super) fn without_quotes(self) -> Rows<'t> {
        Rows { has_quotes: false, ..self }
    }

    fn rest(&self, at: usize) -> &'t str {
        self.text.get(at..).unwrap_or_default()
    }

    /// Returns the cell at `at`, which ends before a delimiter, a line break or the end of the text.
    fn cell(&self, at: usize) -> Result<Cell<'t>, Box<Diagnostic>> {
        let rest = self.rest(at);
        if let Some(quoted) = rest.strip_prefix('"').filter(|_| self.has_quotes) {
            return self.quoted(at, quoted);
        }
        let end = rest.bytes().position(|byte| self.is_end(byte)).unwrap_or(rest.len());
        let text = rest.get(..end).unwrap_or_default();
        Ok(Cell { text: Cow::Borrowed(text), span: Span::new(at, at + end) })
    }

    /// Returns the cell in quotes at `at`. In it, `""` stands for a quote.
    fn quoted(&self, at: usize, quoted: &'t str) -> Result<Cell<'t>, Box<Diagnostic>> {
        let mut end = 0;
        loop {
            let Some(quote) = quoted.get(end..).and_then(|rest| rest.find('"')) else {
                let found = Diagnostic::at(Code::ForeignSyntax, Span::new(at, at + 1), "the quote is not closed");
                return Err(Box::new(found.help("add a `\"` at the end of the text; write quotes in it as `\"\"`")));
            };
            end += quote;
            if !quoted[end + 1..].starts_with('"') {
                break;
            }
            end += 2;
        }
        let blanks = quoted[end + 1..].bytes().take_while(|byte| *byte == b' ').count();
        let after = at + end + 2 + blanks;
        let next = self.rest(after).chars().next().filter(|next| !next.is_ascii() || !self.is_end(*next as u8));
        if let Some(next) = next {
            let span = Span::new(after, after + next.len_utf8());
            let found = Diagnostic::at(Code::ForeignSyntax, span, "text follows a closing quote");
            let found = found.also(Span::new(at, at + 1), "the quote opens here");
            return Err(Box::new(found.help("close the text at its end; write quotes in it as `\"\"`")));
        }
        let text = &quoted[..end];
        let text = if text.contains('"') { text.replace("\"\"", "\"").into() } else { Cow::Borrowed(text) };
        Ok(Cell { text, span: Span::new(at, after) })
    }

    fn is_end(&self, byte: u8) -> bool {
        byte == self.delimiter || matches!(byte, b'\r' | b'\n')
    }
}

impl<'t> Iterator for Rows<'t> {
    type Item = Result<Vec<Cell<'t>>, Box<Diagnostic>>;

    fn next(&mut self) -> Option<Self::Item> {
        self.at += self.rest(self.at).bytes().take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
        if self.at >= self.text.len() {
            return None;
        }
        let mut cells = Vec::new();
        loop {
            let cell = match self.cell(self.at) {
                Ok(cell) => cell,
                Err(error) => {
                    self.at = self.text.len();
                    return Some(Err(error));
                }
            };
            self.at = cell.span.end as usize;
            cells.push(cell);
            if self.rest(self.at).as_bytes().first() != Some(&self.delimiter) {
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
        let text = "a,\"b, \"\"c\"\"\"\r\n\r\n,\"\" ,d\n";
        let rows: Vec<Vec<Cell<'_>>> = Rows::new(text, b',').map(Result::unwrap).collect();
        let texts: Vec<Vec<&str>> = rows.iter().map(|row| row.iter().map(|cell| &*cell.text).collect()).collect();
        assert_eq!(texts, [vec!["a", "b, \"c\""], vec!["", "", "d"]]);
        let written = |cell: &Cell<'_>| &text[cell.span.start as usize..cell.span.end as usize];
        assert_eq!(rows.iter().flatten().map(written).collect::<Vec<_>>(), ["a", "\"b, \"\"c\"\"\"", "", "\"\" ", "d"]);
        let raw = Rows::new("a\t\"b\" c\n", b'\t').without_quotes().next().unwrap().unwrap();
        assert_eq!(raw[1].text, "\"b\" c");
    }

    #[test]
    fn wrong_quotes_are_errors_at_their_positions() {
        for (text, message, start) in [
            ("a,\"b\nc,d\n", "the quote is not closed", 2),
            ("a,\"b\nc,\"d\"\n", "text follows a closing quote", 8),
            ("a,\"b\" c\n", "text follows a closing quote", 6),
        ] {
            let found: Vec<Diagnostic> = Rows::new(text, b',').filter_map(|row| Some(*row.err()?)).collect();
            assert_eq!(found.len(), 1, "{text}");
            assert_eq!((found[0].message.as_str(), found[0].start()), (message, start), "{text}");
        }
    }
}
