//! Where the cells of a row stand, and whether it is a row as RFC 4180 has them.

use lipz_diagnostics::{Code, Diagnostic, Span};
use std::ops::Range;

/// A row as it is spelled.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Scan {
    /// The cells without the quotes around them, in bytes from the start of the row.
    pub(super) places: Vec<Range<usize>>,
    /// Quotes that nobody can be sure about.
    pub(super) fault: Option<Fault>,
}

/// What is wrong with quotes, in bytes from the start of the row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fault {
    /// The quote here never closes: the rest of the file is one cell.
    Open(usize),
    /// Something stands behind a closing quote.
    Behind {
        /// Where the cell begins.
        quote: usize,
        /// What is wrong.
        at: usize,
    },
}

impl Fault {
    /// The diagnostic, for a row that starts here.
    pub(super) fn diagnostic(self, start: usize) -> Diagnostic {
        let span = |at: usize| Span::new(start + at, start + at + 1);
        match self {
            Fault::Open(at) => {
                Diagnostic::at(Code::ExchangeSyntax, span(at), "the cell that begins with this quote does not end")
                    .help("was the file cut off? a `\"` closes the cell; a quote in the text is written twice: `\"\"`")
            }
            Fault::Behind { quote, at } => {
                Diagnostic::at(Code::ExchangeSyntax, span(at), "text stands behind the quote that closes a cell")
                    .also(span(quote), "the cell begins here")
                    .help("close the cell before; a quote in the text is written twice: `\"\"`")
            }
        }
    }
}

/// Reads a row; `raw` may have blank lines before it.
pub(super) fn scan(raw: &str, separator: u8) -> Scan {
    // A blank line before a row belongs to what is read with it.
    let start = raw.len() - raw.trim_start_matches(['\n', '\r']).len();
    let bytes = raw.as_bytes();
    let mut scan = Scan::default();
    let (mut first, mut at, mut is_quoted) = (start, start, false);
    loop {
        let is_behind = at > first && !is_quoted && bytes.get(first) == Some(&b'"');
        match bytes.get(at) {
            Some(b'"') if is_quoted => {
                // Two quotes are one of the text.
                if bytes.get(at + 1) == Some(&b'"') { at += 1 } else { is_quoted = false }
            }
            Some(b'"') if at == first => is_quoted = true,
            Some(_) if is_quoted => {}
            Some(byte) if *byte != separator && !matches!(byte, b'\n' | b'\r') => {
                if is_behind && scan.fault.is_none() {
                    // The whole character.
                    let at = raw.floor_char_boundary(at);
                    scan.fault = Some(Fault::Behind { quote: first, at });
                }
            }
            None if is_quoted => {
                scan.fault = scan.fault.or(Some(Fault::Open(first)));
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
        assert_eq!(fault("a,\"b\nc,d\n"), Some(Fault::Open(2)));
        assert_eq!(fault("a,\""), Some(Fault::Open(2)));
        assert_eq!(fault("a,\"b\" c\n"), Some(Fault::Behind { quote: 2, at: 5 }));
        assert_eq!(fault("\"b\"\u{e4},\"c\n"), Some(Fault::Behind { quote: 0, at: 3 }));
    }
}
