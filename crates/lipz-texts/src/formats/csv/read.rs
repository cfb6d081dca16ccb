//! Reading of tables: rows with the position of every cell, from CSV files and spreadsheets.

use super::cell;
use super::columns::CsvDialect;
use super::escape::unescaped;
use super::header::CsvHeader;
use super::row::CsvRow;
use super::scan::scan;
use crate::exchange::decode;
use crate::exchange::entry::{IncomingFile, ReadOptions};
use csv::{ReaderBuilder, StringRecord};
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use std::cmp::Ordering;

/// The characters that may separate cells. Spreadsheets write `;` where a comma is the decimal point.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// Reads a file with arbitrary content.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) {
    let Some(text) = decode::text(bytes, None, &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    rows(&text, options, incoming);
    incoming.text = text.into_owned();
}

fn rows(text: &str, options: &ReadOptions, incoming: &mut IncomingFile) {
    let first_line = text.lines().next().unwrap_or_default();
    let count = |separator: &u8| first_line.bytes().filter(|byte| byte == separator).count();
    // The first of equally frequent ones.
    let separator = SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',');
    let mut reader =
        ReaderBuilder::new().delimiter(separator).has_headers(false).flexible(true).from_reader(text.as_bytes());
    let mut table = CsvTable::new(options);
    let mut record = StringRecord::new();
    loop {
        let start = usize::try_from(reader.position().byte()).unwrap_or(usize::MAX);
        match reader.read_record(&mut record) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => {
                let message = format!("the file is not CSV: {}", escape::text(&error.to_string()));
                incoming.diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, Span::new(start, start), message));
                return;
            }
        }
        let end = usize::try_from(reader.position().byte()).unwrap_or(usize::MAX);
        let scanned = scan(text.get(start..end).unwrap_or_default(), separator);
        if let Some(fault) = scanned.fault {
            // The columns of all further cells are uncertain.
            incoming.diagnostics.push(fault.diagnostic(start));
            return;
        }
        let dialect = table.header.as_ref().map_or(CsvDialect::Sheet, |header| header.dialect);
        let text = |cell: &str| match dialect {
            CsvDialect::Sheet => cell::text(cell).to_owned(),
            CsvDialect::Plain | CsvDialect::Yarn => cell.to_owned(),
            CsvDialect::Escaped => unescaped(cell).into_owned(),
        };
        let cells = record.iter().map(text).collect();
        let row = CsvRow { cells, places: scanned.places, start, ..CsvRow::default() };
        incoming.diagnostics.extend(table.length(&row));
        if !table.row(row, incoming) {
            return;
        }
    }
    table.finish(incoming);
}

/// A table that is being read. The first row names its columns.
pub(crate) struct CsvTable<'o> {
    options: &'o ReadOptions,
    header: Option<CsvHeader>,
}

impl<'o> CsvTable<'o> {
    pub(crate) fn new(options: &'o ReadOptions) -> CsvTable<'o> {
        CsvTable { options, header: None }
    }

    /// Returns the diagnostic for a row with more or fewer cells than the header.
    fn length(&self, row: &CsvRow) -> Option<Diagnostic> {
        let needs = self.header.as_ref()?.count();
        let has = row.cells.len();
        let (at, help) = match has.cmp(&needs) {
            Ordering::Equal => return None,
            Ordering::Greater => (needs, "put a text with separators between quotes: \"Stop, you!\""),
            Ordering::Less => {
                (has - 1, "write a cell for each column, even if empty, or copy the file again if it was cut off")
            }
        };
        let message = format!("the row has {has} cells, but the header has {needs}");
        Some(Diagnostic::at(Code::ExchangeSyntax, row.span(at), message).help(help))
    }

    /// Reads the next row. Returns false if further rows cannot be used, because the columns are unknown.
    pub(crate) fn row(&mut self, mut row: CsvRow, incoming: &mut IncomingFile) -> bool {
        let is_read = |at: usize| self.header.as_ref().is_none_or(|header| header.is_read(at, self.options));
        let faults = std::mem::take(&mut row.faults).into_iter().filter(|(at, _)| is_read(*at));
        incoming.diagnostics.extend(faults.map(|(_, fault)| fault));
        match &self.header {
            Some(header) => row.entries(header, self.options, incoming),
            None => self.header = CsvHeader::read(&row, self.options, &mut incoming.diagnostics),
        }
        bound::limit_many(&mut incoming.diagnostics);
        self.header.is_some()
    }

    /// Reports a table without rows.
    pub(crate) fn finish(&self, incoming: &mut IncomingFile) {
        if self.header.is_none() {
            incoming.diagnostics.push(
                Diagnostic::new(Code::ExchangeSyntax, "the file has no header")
                    .help("name the columns in the first row: key, en-us, de-de"),
            );
        }
    }
}
