//! Reading tables: rows with the place of every cell, from CSV files and spreadsheets.

use super::cell;
use super::columns::{Column, NoColumn, columns};
use super::scan::scan;
use crate::entry::{self, NoLocale};
use crate::{Entry, Incoming, Mark, ReadOptions, State, Words, decode};
use csv::{ReaderBuilder, StringRecord};
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use std::cmp::Ordering;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

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
        let row = Row { cells, places: scanned.places, start };
        incoming.diagnostics.extend(table.length(&row));
        if !table.row(&row, incoming) {
            return;
        }
    }
    table.finish(incoming);
}

/// A row, and where its cells stand.
#[derive(Debug, Default)]
pub(crate) struct Row {
    /// What is in its cells.
    pub(crate) cells: Vec<String>,
    /// Where they are, in bytes from `start`.
    pub(crate) places: Vec<Range<usize>>,
    /// Where the row starts in the text.
    pub(crate) start: usize,
}

/// A table as far as it is read: the first row names its columns.
pub(crate) struct Table<'o> {
    options: &'o ReadOptions,
    columns: Option<Vec<Column>>,
}

impl<'o> Table<'o> {
    pub(crate) fn new(options: &'o ReadOptions) -> Table<'o> {
        Table { options, columns: None }
    }

    /// The diagnostic for a row with more or fewer cells than the header.
    fn length(&self, row: &Row) -> Option<Diagnostic> {
        let needs = self.columns.as_ref()?.len();
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
    pub(crate) fn row(&mut self, row: &Row, incoming: &mut Incoming) -> bool {
        match &self.columns {
            Some(columns) => row.entries(columns, self.options, incoming),
            None => self.columns = header(row, self.options, incoming),
        }
        bound::limit_many(&mut incoming.diagnostics);
        self.columns.is_some()
    }

    /// Reports that there was no row.
    pub(crate) fn finish(&self, incoming: &mut Incoming) {
        if self.columns.is_none() {
            incoming.diagnostics.push(
                Diagnostic::new(Code::ExchangeSyntax, "the file has no header")
                    .help("its first row names the columns: key, en-us, de-de"),
            );
        }
    }
}

/// The columns; `None` if there is none with keys.
fn header(row: &Row, options: &ReadOptions, incoming: &mut Incoming) -> Option<Vec<Column>> {
    let names: Vec<&str> = row.cells.iter().map(String::as_str).collect();
    let mut found = Vec::new();
    for (at, column) in columns(&names, options).into_iter().enumerate() {
        if let Err(why) = &column {
            let name = escape::quoted(names.get(at).copied().unwrap_or_default());
            let (note, help) = match why {
                NoColumn::Unknown => (
                    "it is neither a locale nor a column that lipz or another tool writes",
                    "call a column of texts by its locale, as in de-de",
                ),
                NoColumn::Locale => (NoLocale::NOTE, NoLocale::HELP),
            };
            let message = format!("the column {name} is not imported");
            let diagnostic = Diagnostic::at(Code::ExchangeLoss, row.span(at), message);
            incoming.diagnostics.push(diagnostic.note(note).help(help));
        }
        found.push(column.unwrap_or(Column::Other));
    }
    let missing = |what: &str, help: &str| {
        Some(Diagnostic::at(Code::ExchangeSyntax, row.span(0), format!("no column has {what}")).help(help))
    };
    let is_text = |column: &Column| matches!(column, Column::Text | Column::Locale(_));
    let wrong = match &found {
        all if !all.contains(&Column::Key) => missing("the keys of clips", "call it `key`"),
        all if !all.iter().any(is_text) => missing("translations", "call each by its locale, as in de-de"),
        _ => None,
    };
    let is_wrong = wrong.is_some();
    incoming.diagnostics.extend(wrong);
    (!is_wrong).then_some(found)
}

impl Row {
    /// Where a cell stands, without quotes; the start of the row if there is none.
    pub(crate) fn span(&self, at: usize) -> Span {
        let place = self.places.get(at).cloned().unwrap_or(0..0);
        Span::new(self.start + place.start, self.start + place.end)
    }

    fn words(&self, at: usize) -> Words {
        Words { text: self.cells.get(at).cloned().unwrap_or_default(), span: self.span(at) }
    }

    /// Adds the translations of a row.
    fn entries(&self, columns: &[Column], options: &ReadOptions, incoming: &mut Incoming) {
        let find = |column: &Column| columns.iter().position(|other| other == column);
        let mark = |at: Option<usize>| self.cells.get(at?)?.parse::<Mark>().ok();
        let Some(key) = find(&Column::Key).map(|at| self.words(at)) else { return };
        if key.text.is_empty() {
            if self.cells.iter().any(|cell| !cell.is_empty()) {
                let message = "a row has no key, and is not imported";
                incoming.diagnostics.push(Diagnostic::at(Code::ExchangeLoss, self.span(0), message));
            }
            return;
        }
        let source = find(&Column::Source).map(|at| Arc::new(self.words(at)));
        let source_mark = mark(find(&Column::SourceMark));
        let state =
            find(&Column::State).and_then(|at| State::from_name(&self.cells.get(at)?.trim().to_ascii_lowercase()));
        let row_locale = self.locale(find(&Column::Language), options, incoming);
        let (id, segment) = entry::id(&key.text);
        let key = Arc::new(Words { text: id.to_owned(), span: key.span });
        // Of two columns about one locale, the first counts.
        let named = columns.iter().enumerate().rev().filter_map(|(at, column)| match column {
            Column::Mark(locale) => Some((&**locale, at)),
            _ => None,
        });
        let marks: HashMap<&str, usize> = named.collect();
        for (at, column) in columns.iter().enumerate() {
            let locale = match column {
                Column::Locale(locale) => Some(Arc::clone(locale)),
                Column::Text => row_locale.clone(),
                _ => continue,
            };
            let Some(locale) = locale.filter(|locale| options.wants(locale)) else { continue };
            let text = self.words(at);
            incoming.entries.push(Entry {
                key: Arc::clone(&key),
                segment,
                source: source.clone(),
                source_mark,
                state: if text.text.is_empty() { State::Initial } else { state.unwrap_or(State::Translated) },
                says_state: state.is_some(),
                text,
                mark: mark(marks.get(&*locale).copied()),
                locale,
                is_of_table: true,
                ..Entry::default()
            });
        }
    }

    /// The locale of the row, if a column says it.
    fn locale(&self, column: Option<usize>, options: &ReadOptions, incoming: &mut Incoming) -> Option<Arc<str>> {
        let language = self.words(column?);
        let locale = options.locale(&language.text).map(Arc::from);
        locale.map_err(|why| incoming.diagnostics.push(why.diagnostic(&language.text, language.span))).ok()
    }
}
