//! The rows of CSV with the positions of their cells.

use super::row::CsvRow;
use super::scan::scan;
use csv::{Reader, ReaderBuilder, StringRecord};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};

/// The characters that may separate cells. Spreadsheets write `;` where a comma is the decimal point.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// Returns the character that separates the cells of a line: the first of the most frequent ones.
pub(crate) fn separator_of(line: &str) -> u8 {
    let count = |separator: &u8| line.bytes().filter(|byte| byte == separator).count();
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',')
}

/// The rows of a table. After an ambiguous quote, there are no more rows, because the columns of all further cells are
/// uncertain.
pub(crate) struct CsvRows<'t> {
    text: &'t str,
    separator: u8,
    reader: Reader<&'t [u8]>,
    record: StringRecord,
    is_over: bool,
}

impl<'t> CsvRows<'t> {
    pub(crate) fn new(text: &'t str, separator: u8) -> CsvRows<'t> {
        let mut builder = ReaderBuilder::new();
        let reader = builder.delimiter(separator).has_headers(false).flexible(true).from_reader(text.as_bytes());
        CsvRows { text, separator, reader, record: StringRecord::new(), is_over: false }
    }

    /// Returns the position of the reader in the text.
    fn offset(&self) -> usize {
        usize::try_from(self.reader.position().byte()).unwrap_or(usize::MAX)
    }
}

impl Iterator for CsvRows<'_> {
    type Item = Result<CsvRow, Box<Diagnostic>>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over {
            return None;
        }
        let start = self.offset();
        match self.reader.read_record(&mut self.record) {
            Ok(true) => {}
            Ok(false) => return None,
            Err(error) => {
                self.is_over = true;
                let message = format!("the file is not CSV: {}", escape::text(&error.to_string()));
                return Some(Err(Diagnostic::at(Code::ExchangeSyntax, Span::new(start, start), message).into()));
            }
        }
        let scanned = scan(self.text.get(start..self.offset()).unwrap_or_default(), self.separator);
        if let Some(fault) = scanned.fault {
            self.is_over = true;
            return Some(Err(fault.diagnostic(start).into()));
        }
        let cells = self.record.iter().map(str::to_owned).collect();
        Some(Ok(CsvRow { cells, places: scanned.places, start, ..CsvRow::default() }))
    }
}
