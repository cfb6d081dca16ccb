//! The positions of a row's cells, and its validity according to RFC 4180.

use lipz_diagnostics::{Code, Diagnostic, Span};
use std::ops::Range;

/// A row as written.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Scan {
    /// The cells without their quotes, in bytes from the start of the row.
    pub(super) places: Vec<Range<usize>>,
    /// An ambiguous quote.
    pub(super) fault: Option<QuoteFault>,
}

/// The problem of a quote, in bytes from the start of the row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum QuoteFault {
    /// This quote is not closed, so the rest of the file is one cell.
    Open(usize),
    /// There is text after a closing quote.
    Behind {
        /// The start of the cell.
        quote: usize,
        /// The position of the problem.
        at: usize,
        /// The length of the character there.
        length: usize,
    },
}

impl QuoteFault {
    /// Returns the diagnostic for a row that starts at `start`.
    pub(super) fn diagnostic(self, start: usize) -> Diagnostic {
        let long = |at: usize, length: usize| Span::new(start + at, start + at + length);
        let span = |at: usize| long(at, 1);
        match self {
            QuoteFault::Open(at) => {
                Diagnostic::at(Code::ExchangeSyntax, span(at), "the cell that starts with this quote is not closed")
                    .help(
                        "close the cell with `\"`, write a quote in the text twice (`\"\"`), or copy the file again \
                        if it was cut off",
                    )
            }
            QuoteFault::Behind { quote, at, length } => {
                Diagnostic::at(Code::ExchangeSyntax, long(at, length), "text follows the quote that closes a cell")
                    .also(span(quote), "the cell starts here")
                    .help("put a separator after the quote, or write a quote in the text twice: `\"\"`")
            }
        }
    }
}

/// Scans a row. `raw` may start with blank lines.
pub(super) fn scan(raw: &str, separator: u8) -> Scan {
    // A blank line before a row is read with the row.
    let start = raw.len() - raw.trim_start_matches(['\n', '\r']).len();
    let bytes = raw.as_bytes();
    let mut scan = Scan::default();
    let (mut first, mut at, mut is_quoted) = (start, start, false);
    loop {
        let is_behind = at > first && !is_quoted && bytes.get(first) == Some(&b'"');
        match bytes.get(at) {
            Some(b'"') if is_quoted => {
                // Two quotes stand for one in the text.
                if bytes.get(at + 1) == Some(&b'"') { at += 1 } else { is_quoted = false }
            }
            Some(b'"') if at == first => is_quoted = true,
            Some(_) if is_quoted => {}
            Some(byte) if *byte != separator && !matches!(byte, b'\n' | b'\r') => {
                if is_behind && scan.fault.is_none() {
                    // Include the whole character.
                    let at = raw.floor_char_boundary(at);
                    let length = raw.get(at..).and_then(|rest| rest.chars().next()).map_or(1, char::len_utf8);
                    scan.fault = Some(QuoteFault::Behind { quote: first, at, length });
                }
            }
            None if is_quoted => {
                scan.fault = scan.fault.or(Some(QuoteFault::Open(first)));
                scan.places.push(first + 1..at);
                return scan;
            }
            end => {
                let inner = match bytes.get(first..at) {
                    Some([b'"', .., b'"']) => first + 1..at - 1,
                    _ => first..at,
                };
                scan.places.push(inner);
                if end != Some(&separator) {
                    return scan;
                }
                first = at + 1;
            }
        }
        at += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(raw: &str) -> Vec<&str> {
        let scan = scan(raw, b',');
        assert_eq!(scan.fault, None, "{raw}");
        scan.places.into_iter().map(|place| &raw[place]).collect()
    }

    #[test]
    fn cells_are_without_their_quotes() {
        assert_eq!(cells("a,\"b, \"\"c\"\"\n\",\"\",d\r\n"), ["a", "b, \"\"c\"\"\n", "", "d"]);
        assert_eq!(cells("\r\n\na,\n"), ["a", ""]);
        assert_eq!(cells("a \"b\" c"), ["a \"b\" c"], "a quote inside of a cell without quotes is one");
    }

    #[test]
    fn quotes_that_nobody_can_be_sure_about() {
        let fault = |raw: &str| scan(raw, b',').fault;
        assert_eq!(fault("a,\"b\nc,d\n"), Some(QuoteFault::Open(2)));
        assert_eq!(fault("a,\""), Some(QuoteFault::Open(2)));
        assert_eq!(fault("a,\"b\" c\n"), Some(QuoteFault::Behind { quote: 2, at: 5, length: 1 }));
        assert_eq!(fault("\"b\"\u{e4},\"c\n"), Some(QuoteFault::Behind { quote: 0, at: 3, length: 2 }));
    }
}
