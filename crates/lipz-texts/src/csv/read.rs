//! Reading tables: rows with the place of every cell, from CSV files and spreadsheets.

use super::cell;
use super::header::Header;
use super::row::Row;
use super::scan::scan;
use crate::{Incoming, ReadOptions, decode};
use csv::{ReaderBuilder, StringRecord};
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use std::cmp::Ordering;

/// What may separate cells. Spreadsheets write `;` where a comma is the sign before decimals.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// Reads a file of any bytes.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut Incoming) {
    let Some(text) = decode::text(bytes, None, &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    rows(&text, options, incoming);
    incoming.text = text.into_owned();
}

fn rows(text: &str, options: &ReadOptions, incoming: &mut Incoming) {
    let first_line = text.lines().next().unwrap_or_default();
    let count = |separator: &u8| first_line.bytes().filter(|byte| byte == separator).count();
    // The first of equal ones.
    let separator = SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',');
    let mut reader =
        ReaderBuilder::new().delimiter(separator).has_headers(false).flexible(true).from_reader(text.as_bytes());
    let mut table = Table::new(options);
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
            // From here on nobody knows which cell is whose.
            incoming.diagnostics.push(fault.diagnostic(start));
            return;
        }
        let cells = record.iter().map(|cell| cell::text(cell).to_owned()).collect();
        let row = Row { cells, places: scanned.places, start, ..Row::default() };
        incoming.diagnostics.extend(table.length(&row));
        if !table.row(row, incoming) {
            return;
        }
    }
    table.finish(incoming);
}

/// A table as far as it is read: the first row names its columns.
pub(crate) struct Table<'o> {
    options: &'o ReadOptions,
    header: Option<Header>,
}

impl<'o> Table<'o> {
    pub(crate) fn new(options: &'o ReadOptions) -> Table<'o> {
        Table { options, header: None }
    }

    /// The diagnostic for a row with more or fewer cells than the header.
    fn length(&self, row: &Row) -> Option<Diagnostic> {
        let needs = self.header.as_ref()?.count();
        let has = row.cells.len();
        let (at, help) = match has.cmp(&needs) {
            Ordering::Equal => return None,
            Ordering::Greater => (needs, "put a text with separators between quotes: \"Stop, you!\""),
            Ordering::Less => {
                (has - 1, "was the file cut off? each row has a cell for each column, if only an empty one")
            }
        };
        let message = format!("the row has {has} cells, the header {needs}");
        Some(Diagnostic::at(Code::ExchangeSyntax, row.span(at), message).help(help))
    }

    /// Reads the next row; false if the others say nothing, because the columns are not known.
    pub(crate) fn row(&mut self, mut row: Row, incoming: &mut Incoming) -> bool {
        let is_read = |at: usize| self.header.as_ref().is_none_or(|header| header.is_read(at, self.options));
        let faults = std::mem::take(&mut row.faults).into_iter().filter(|(at, _)| is_read(*at));
        incoming.diagnostics.extend(faults.map(|(_, fault)| fault));
        match &self.header {
            Some(header) => row.entries(header, self.options, incoming),
            None => self.header = Header::read(&row, self.options, &mut incoming.diagnostics),
        }
        bound::limit_many(&mut incoming.diagnostics);
        self.header.is_some()
    }

    /// Reports that there was no row.
    pub(crate) fn finish(&self, incoming: &mut Incoming) {
        if self.header.is_none() {
            incoming.diagnostics.push(
                Diagnostic::new(Code::ExchangeSyntax, "the file has no header")
                    .help("its first row names the columns: key, en-us, de-de"),
            );
        }
    }
}
