//! Reading of tables: rows with the position of every cell, from CSV files and spreadsheets.

use super::cell;
use super::columns::CsvDialect;
use super::escape::unescaped;
use super::header::CsvHeader;
use super::row::CsvRow;
use crate::exchange::decode;
use crate::exchange::entry::{IncomingFile, ReadOptions};
use lipz_diagnostics::{Code, Diagnostic, Span, bound};
use lipz_file::table::Rows;
use std::cmp::Ordering;

/// The characters that may separate cells. Spreadsheets write `;` where a comma is the decimal point.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// Returns the character that separates the cells of a line: the first of the most frequent ones.
pub(crate) fn separator_of(line: &str) -> u8 {
    let count = |separator: &u8| line.bytes().filter(|byte| byte == separator).count();
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',')
}

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
    let mut table = CsvTable::new(options);
    for row in Rows::new(text, separator(text, options)) {
        let mut row = match row {
            Ok(cells) => CsvRow::new(cells),
            Err(fault) => {
                incoming.diagnostics.push(fault.diagnostic(Code::ExchangeSyntax));
                return;
            }
        };
        let dialect = table.header.as_ref().map_or(CsvDialect::Sheet, |header| header.dialect);
        for cell in &mut row.cells {
            let text = match dialect {
                CsvDialect::Sheet => cell::text(cell).to_owned(),
                CsvDialect::Plain | CsvDialect::Yarn | CsvDialect::DialogueScript => continue,
                CsvDialect::Escaped => unescaped(cell).into_owned(),
            };
            *cell = text;
        }
        incoming.diagnostics.extend(table.length(&row));
        if !table.row(row, incoming) {
            return;
        }
    }
    table.finish(incoming);
}

/// Returns the character that separates the cells of the header, which is in one of the first lines.
fn separator(text: &str, options: &ReadOptions) -> u8 {
    let names_keys = |line: &&str| {
        let names: Vec<&str> = line.split(char::from(separator_of(line))).map(|name| name.trim_matches('"')).collect();
        CsvHeader::names_keys(&names, options)
    };
    let header = text.lines().take(MOST_ROWS_ABOVE + 1).find(names_keys);
    separator_of(header.or(text.lines().next()).unwrap_or_default())
}

/// The most rows above the header, such as titles and empty rows.
const MOST_ROWS_ABOVE: usize = 20;

/// A table that is being read. Its header names the columns. Other rows may be above it.
pub(crate) struct CsvTable<'o> {
    options: &'o ReadOptions,
    header: Option<CsvHeader>,
    /// The number of rows above the header.
    above: usize,
    /// The positions of those with content.
    titles: Vec<Span>,
    /// The reasons why the first row is not a header.
    first: Vec<Diagnostic>,
    /// Whether the reason why no row is a header has been reported.
    is_refused: bool,
}

impl<'o> CsvTable<'o> {
    pub(crate) fn new(options: &'o ReadOptions) -> CsvTable<'o> {
        CsvTable { options, header: None, above: 0, titles: Vec::new(), first: Vec::new(), is_refused: false }
    }

    /// Whether the columns are known.
    #[cfg(feature = "xlsx")]
    pub(crate) fn has_header(&self) -> bool {
        self.header.is_some()
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
        let goes_on = match &self.header {
            Some(header) => {
                row.entries(header, self.options, incoming);
                true
            }
            None => self.header(&row, incoming),
        };
        bound::limit_many(&mut incoming.diagnostics);
        goes_on
    }

    /// Reads the header, or a row above it. Returns false if there is no header.
    fn header(&mut self, row: &CsvRow, incoming: &mut IncomingFile) -> bool {
        let mut found = Vec::new();
        self.header = CsvHeader::read(row, self.options, &mut found);
        if self.header.is_some() {
            incoming.diagnostics.append(&mut found);
            incoming.diagnostics.extend(self.rows_above());
            return true;
        }
        let names: Vec<&str> = row.cells.iter().map(String::as_str).collect();
        if CsvHeader::names_keys(&names, self.options) {
            self.first.clear();
            incoming.diagnostics.append(&mut found);
            self.is_refused = true;
            return false;
        }
        if self.above == 0 {
            self.first = found;
        }
        self.above += 1;
        if let Some(first) = row.cells.iter().position(|cell| !cell.is_empty()) {
            self.titles.push(row.span(first));
        }
        let goes_on = self.above <= MOST_ROWS_ABOVE;
        if !goes_on {
            incoming.diagnostics.append(&mut self.first);
            self.is_refused = true;
        }
        goes_on
    }

    /// Reports the rows above the header.
    fn rows_above(&self) -> Option<Diagnostic> {
        if self.options.wants_takes {
            return None; // a title of the script
        }
        let message = match self.titles.len() {
            1 => "the row above the header is not imported".to_owned(),
            count => format!("{count} rows above the header are not imported"),
        };
        Some(Diagnostic::at(Code::ExchangeLoss, *self.titles.first()?, message))
    }

    /// Reports a table without a header.
    pub(crate) fn finish(&mut self, incoming: &mut IncomingFile) {
        if self.header.is_some() || self.is_refused {
            return;
        }
        if !self.first.is_empty() {
            incoming.diagnostics.append(&mut self.first);
        } else {
            incoming.diagnostics.push(
                Diagnostic::new(Code::ExchangeSyntax, "the file has no header")
                    .help("name the columns in the first row: key, en-us, de-de"),
            );
        }
    }
}
