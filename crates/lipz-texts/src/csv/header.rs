//! What stands where in a table, as its first row says.

use super::columns::{Column, NoColumn, columns};
use super::row::Row;
use crate::ReadOptions;
use crate::entry::NoLocale;
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// The columns of a table.
#[derive(Debug)]
pub(super) struct Header {
    columns: Vec<Column>,
    pub(super) key: usize,
    pub(super) source: Option<usize>,
    pub(super) source_mark: Option<usize>,
    pub(super) language: Option<usize>,
    pub(super) state: Option<usize>,
    /// Those of translations that are wanted, by the first cell of each.
    texts: Vec<Texts>,
    /// Where the marks of locales are.
    marks: HashMap<Arc<str>, usize>,
}

/// A column of translations.
#[derive(Debug)]
pub(super) struct Texts {
    pub(super) at: usize,
    /// `None` if rows say their locale.
    pub(super) locale: Option<Arc<str>>,
    /// Where their marks are, if the locale is known.
    mark: Option<usize>,
    /// Rows that end before this cell say nothing here.
    first: usize,
}

impl Header {
    /// The columns that a row names; `None` if there is none with keys, or none with translations.
    pub(super) fn read(row: &Row, options: &ReadOptions, diagnostics: &mut Vec<Diagnostic>) -> Option<Header> {
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
                diagnostics.push(diagnostic.note(note).help(help));
            }
            found.push(column.unwrap_or(Column::Other));
        }
        let missing = |what: &str, help: &str| {
            Diagnostic::at(Code::ExchangeSyntax, row.span(0), format!("no column has {what}")).help(help)
        };
        let Some(key) = found.iter().position(|column| *column == Column::Key) else {
            diagnostics.push(missing("the keys of clips", "call it `key`"));
            return None;
        };
        if !found.iter().any(|column| matches!(column, Column::Text | Column::Locale(_))) {
            diagnostics.push(missing("translations", "call each by its locale, as in de-de"));
            return None;
        }
        Some(Header::new(found, key, options))
    }

    fn new(columns: Vec<Column>, key: usize, options: &ReadOptions) -> Header {
        let find = |column: &Column| columns.iter().position(|other| other == column);
        // Of two columns about one locale, the first counts.
        let named = columns.iter().enumerate().rev().filter_map(|(at, column)| match column {
            Column::Mark(locale) => Some((Arc::clone(locale), at)),
            _ => None,
        });
        let marks: HashMap<Arc<str>, usize> = named.collect();
        let mut known = HashSet::new();
        let texts = columns.iter().enumerate().filter_map(|(at, column)| {
            let (locale, mark, first) = match column {
                Column::Locale(locale) if options.wants(locale) => {
                    let mark = marks.get(locale).copied();
                    (Some(Arc::clone(locale)), mark, mark.map_or(at, |mark| mark.min(at)))
                }
                Column::Text => (None, None, 0),
                _ => return None,
            };
            // A mark without a text is told once.
            let first = if known.insert(column) { first } else { at };
            Some(Texts { at, locale, mark, first })
        });
        let mut texts: Vec<Texts> = texts.collect();
        texts.sort_by_key(|column| column.first);
        Header {
            key,
            source: find(&Column::Source),
            source_mark: find(&Column::SourceMark),
            language: find(&Column::Language),
            state: find(&Column::State),
            texts,
            marks,
            columns,
        }
    }

    /// How many columns there are.
    pub(super) fn count(&self) -> usize {
        self.columns.len()
    }

    /// Whether an import reads the cells of a column.
    pub(super) fn is_read(&self, at: usize, options: &ReadOptions) -> bool {
        match self.columns.get(at) {
            None | Some(Column::Other) => false,
            Some(Column::Locale(locale) | Column::Mark(locale)) => options.wants(locale),
            Some(_) => true,
        }
    }

    /// The columns of translations in which a row with so many cells can have something: looking at all of them for each row
    /// would take longer than reading the file.
    pub(super) fn texts_of(&self, cell_count: usize) -> impl Iterator<Item = &Texts> {
        self.texts.iter().take_while(move |column| column.first < cell_count)
    }

    /// Where the marks of the translations in a column are; of one whose rows say their locale, the marks of this one.
    pub(super) fn mark(&self, column: &Texts, locale: &str) -> Option<usize> {
        column.locale.as_ref().map_or_else(|| self.marks.get(locale).copied(), |_| column.mark)
    }
}
