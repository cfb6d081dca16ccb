//! The columns of a table, from its first row.

use super::columns::{CsvColumn, CsvDialect, NoColumn, columns};
use super::row::CsvRow;
use crate::exchange::entry::{NoLocale, ReadOptions};
use lipz_diagnostics::{Code, Diagnostic, bound, escape};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// The columns of a table.
#[derive(Debug)]
pub(super) struct CsvHeader {
    columns: Vec<CsvColumn>,
    pub(super) key: usize,
    pub(super) source: Option<usize>,
    pub(super) source_mark: Option<usize>,
    pub(super) language: Option<usize>,
    pub(super) state: Option<usize>,
    pub(super) fuzzy: Option<usize>,
    pub(super) take: Option<usize>,
    pub(super) dialect: CsvDialect,
    /// The columns of wanted translations, sorted by the first cell of each.
    texts: Vec<TranslationColumn>,
    /// The locales of all columns with translations.
    locales: Arc<[Arc<str>]>,
    /// The columns of the marks of locales.
    marks: HashMap<Arc<str>, usize>,
}

/// A column of translations.
#[derive(Debug)]
pub(super) struct TranslationColumn {
    pub(super) at: usize,
    /// `None` if each row states its locale.
    pub(super) locale: Option<Arc<str>>,
    /// The column of their marks, if the locale is known.
    mark: Option<usize>,
    /// The columns of the comments of translators and of their marks, if the locale is known.
    pub(super) comments: [Option<usize>; 2],
    /// Rows that end before this cell have no content for this column.
    first: usize,
}

impl CsvHeader {
    /// Reads the columns from a row; `None` if keys or translations are missing.
    pub(super) fn read(row: &CsvRow, options: &ReadOptions, diagnostics: &mut Vec<Diagnostic>) -> Option<CsvHeader> {
        let names: Vec<&str> = row.cells.iter().map(String::as_str).collect();
        let (mut found, mut target) = (Vec::new(), None);
        for (at, column) in columns(&names, options).into_iter().enumerate() {
            if let (Err(why), false) = (&column, options.wants_takes) {
                let name = escape::quoted(names.get(at).copied().unwrap_or_default());
                target = target.or_else(|| (*why == NoColumn::Target).then(|| name.clone()));
                let (note, help) = match why {
                    NoColumn::Unknown => (
                        "its name is not a locale, nor that of a column that lipz or a known tool writes",
                        "name a column of texts after its locale, as in de-de",
                    ),
                    NoColumn::Locale => (NoLocale::NOTE, NoLocale::HELP),
                    NoColumn::Target => {
                        ("the file does not name the locale of this column", "name it with `--locale`, as in de-de")
                    }
                };
                let message = format!("the column {name} is not imported");
                let diagnostic = Diagnostic::at(Code::ExchangeLoss, row.span(at), message);
                diagnostics.push(diagnostic.note(note).help(help));
                bound::limit_many(diagnostics);
            }
            found.push(column.unwrap_or(CsvColumn::Other));
        }
        let missing = |what: &str, help: &str| {
            Diagnostic::at(Code::ExchangeSyntax, row.span(0), format!("no column has {what}")).help(help)
        };
        let Some(key) = found.iter().position(|column| *column == CsvColumn::Key) else {
            diagnostics.push(missing("the keys of clips", "name it `key`"));
            return None;
        };
        if options.wants_takes {
            let takes: Vec<usize> =
                (0..).zip(&found).filter(|(_, column)| **column == CsvColumn::Take).map(|(at, _)| at).collect();
            match takes.as_slice() {
                [_] => {}
                [] => {
                    let help = "name it `take`, or choose the takes in a script of `lipz export recording-script`";
                    diagnostics.push(missing("the chosen takes", help));
                    return None;
                }
                [_, second, ..] => {
                    let found =
                        Diagnostic::at(Code::ExchangeSyntax, row.span(*second), "a second column has the name `take`");
                    diagnostics.push(found.help("delete or rename one of the two"));
                    return None;
                }
            }
        } else if !found.iter().any(|column| matches!(column, CsvColumn::Text | CsvColumn::Locale(_))) {
            let help = match target {
                Some(name) => format!("name the locale of the column {name} with `--locale`, as in de-de"),
                None => "name each column after its locale, as in de-de".to_owned(),
            };
            diagnostics.push(missing("translations", &help));
            return None;
        }
        let dialect = CsvDialect::new(&names, &found);
        Some(CsvHeader::new(found, key, dialect, options))
    }

    /// Whether one of these cells names the column of keys, as in a header.
    pub(super) fn names_keys(names: &[&str], options: &ReadOptions) -> bool {
        columns(names, options).contains(&Ok(CsvColumn::Key))
    }

    fn new(columns: Vec<CsvColumn>, key: usize, dialect: CsvDialect, options: &ReadOptions) -> CsvHeader {
        let find = |column: &CsvColumn| columns.iter().position(|other| other == column);
        // Of two columns for one locale, the first counts.
        let named = columns.iter().enumerate().rev().filter_map(|(at, column)| match column {
            CsvColumn::Mark(locale) => Some((Arc::clone(locale), at)),
            _ => None,
        });
        let marks: HashMap<Arc<str>, usize> = named.collect();
        let mut known = HashSet::new();
        let texts = columns.iter().enumerate().filter_map(|(at, column)| {
            let (locale, mark, comments, first) = match column {
                CsvColumn::Locale(locale) if options.wants(locale) => {
                    let mark = marks.get(locale).copied();
                    let comments =
                        [CsvColumn::Comments(Arc::clone(locale)), CsvColumn::CommentMark(Arc::clone(locale))];
                    let comments = comments.map(|column| find(&column));
                    let first = [mark, comments[0]].into_iter().flatten().fold(at, usize::min);
                    (Some(Arc::clone(locale)), mark, comments, first)
                }
                CsvColumn::Text => (None, None, [None; 2], 0),
                _ => return None,
            };
            // A mark without a text is reported once.
            let first = if known.insert(column) { first } else { at };
            Some(TranslationColumn { at, locale, mark, comments, first })
        });
        let mut texts: Vec<TranslationColumn> = texts.collect();
        texts.sort_by_key(|column| column.first);
        let locales = columns.iter().filter_map(|column| match column {
            CsvColumn::Locale(locale) if **locale != *options.source_locale => Some(Arc::clone(locale)),
            _ => None,
        });
        let locales = locales.collect();
        CsvHeader {
            key,
            source: find(&CsvColumn::Source),
            source_mark: find(&CsvColumn::SourceMark),
            language: find(&CsvColumn::Language),
            state: find(&CsvColumn::State),
            fuzzy: find(&CsvColumn::Fuzzy),
            take: find(&CsvColumn::Take),
            dialect,
            texts,
            locales,
            marks,
            columns,
        }
    }

    /// Returns the number of columns.
    pub(super) fn count(&self) -> usize {
        self.columns.len()
    }

    /// Whether an import reads the cells of a column.
    pub(super) fn is_read(&self, at: usize, options: &ReadOptions) -> bool {
        match self.columns.get(at) {
            Some(column) if options.wants_takes => matches!(column, CsvColumn::Key | CsvColumn::Take),
            None | Some(CsvColumn::Other | CsvColumn::Take) => false,
            Some(
                CsvColumn::Locale(locale)
                | CsvColumn::Mark(locale)
                | CsvColumn::Comments(locale)
                | CsvColumn::CommentMark(locale),
            ) => options.wants(locale),
            Some(_) => true,
        }
    }

    /// Returns the locales of all columns with translations.
    pub(super) fn locales(&self) -> &Arc<[Arc<str>]> {
        &self.locales
    }

    /// Returns the columns of translations that may have content in a row with so many cells. Iterating over all
    /// columns for each row would take longer than reading the file.
    pub(super) fn texts_of(&self, cell_count: usize) -> impl Iterator<Item = &TranslationColumn> {
        self.texts.iter().take_while(move |column| column.first < cell_count)
    }

    /// Returns the column of the marks for a column of translations. If rows state their locale, it is that of this
    /// locale.
    pub(super) fn mark(&self, column: &TranslationColumn, locale: &str) -> Option<usize> {
        column.locale.as_ref().map_or_else(|| self.marks.get(locale).copied(), |_| column.mark)
    }
}
