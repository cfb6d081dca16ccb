//! A row of a table, and the translations in it.

use super::columns::CsvDialect;
use super::header::{CsvHeader, TranslationColumn};
use crate::exchange::entry::{self, ChosenTake, Entry, IncomingFile, ReadOptions, Words};
use crate::exchange::{Mark, State};
use lipz_diagnostics::{Code, Diagnostic, Span};
use lipz_file::table::Cell;
use std::ops::Range;
use std::sync::Arc;

/// The prefix of all keys in Yarn Spinner.
pub(super) const YARN_LINE: &str = "line:";
/// The end of all keys in a dialogue script of Unreal.
const RECORDING: &str = ".wav";
/// The prefix of translations whose source text has changed, in Yarn Spinner.
const NEEDS_UPDATE: &str = "(NEEDS UPDATE) ";

/// A row, and the positions of its cells.
#[derive(Debug, Default)]
pub(crate) struct CsvRow {
    /// The contents of its cells.
    pub(crate) cells: Vec<String>,
    /// The ranges of its cells, in bytes from `start`.
    pub(crate) places: Vec<Range<usize>>,
    /// The offset of the row in the text.
    pub(crate) start: usize,
    /// The diagnostics of cells, used if their columns are read.
    pub(crate) faults: Vec<(usize, Diagnostic)>,
}

impl CsvRow {
    /// Returns the row with these cells, and with positions in the whole text.
    pub(super) fn new(cells: Vec<Cell<'_>>) -> CsvRow {
        let places = cells.iter().map(|cell| cell.span.range()).collect();
        let cells = cells.into_iter().map(|cell| cell.text.into_owned()).collect();
        CsvRow { cells, places, ..CsvRow::default() }
    }

    /// Returns the position of a cell without quotes, or the start of the row if there is no such cell.
    pub(crate) fn span(&self, at: usize) -> Span {
        let place = self.places.get(at).cloned().unwrap_or(0..0);
        Span::new(self.start + place.start, self.start + place.end)
    }

    fn words(&self, at: usize) -> Words {
        Words { text: self.cells.get(at).cloned().unwrap_or_default(), span: self.span(at) }
    }

    fn mark(&self, at: Option<usize>) -> Option<Mark> {
        self.cells.get(at?)?.parse().ok()
    }

    /// Adds the translations of a row. Locales with neither text nor mark have no entry, because rows may be much
    /// shorter than the header. Only a row without any text or mark gets an entry, with which its key and source are
    /// compared.
    pub(super) fn entries(&self, header: &CsvHeader, options: &ReadOptions, incoming: &mut IncomingFile) {
        let key = self.words(header.key);
        if options.wants_takes {
            return self.take(key, header, incoming);
        }
        if key.text.is_empty() {
            if self.cells.iter().any(|cell| !cell.is_empty()) {
                let message = "the row has no key and is not imported";
                incoming.diagnostics.push(Diagnostic::at(Code::ExchangeLoss, self.span(0), message));
            }
            return;
        }
        let source = header.source.map(|at| Arc::new(self.words(at)));
        let source_mark = self.mark(header.source_mark);
        let state = header.state.and_then(|at| State::from_name(&self.cells.get(at)?.trim().to_ascii_lowercase()));
        let fuzzy = header.fuzzy.and_then(|at| self.cells.get(at)).map(|cell| cell.trim().to_ascii_lowercase());
        let state = state.or(fuzzy.map(|cell| match cell.as_str() {
            "" | "false" | "0" => State::Translated,
            _ => State::Initial,
        }));
        let is_of_yarn = header.dialect == CsvDialect::Yarn;
        let row_locale = self.locale(header.language, options, incoming);
        let own = match header.dialect {
            CsvDialect::Yarn => key.text.strip_prefix(YARN_LINE).unwrap_or(&key.text),
            CsvDialect::DialogueScript => key.text.strip_suffix(RECORDING).unwrap_or(&key.text),
            _ => &key.text,
        };
        let (id, segment) = entry::id(own);
        let key = Arc::new(Words { text: id.to_owned(), span: key.span });
        let entry = |column: &TranslationColumn| {
            // These do not include columns of other locales, but rows may have any locale.
            let locale = column.locale.clone().or_else(|| row_locale.clone().filter(|locale| options.wants(locale)))?;
            let mut text = self.words(column.at);
            let is_outdated = is_of_yarn && text.text.starts_with(NEEDS_UPDATE);
            if is_outdated {
                text.text.replace_range(..NEEDS_UPDATE.len(), "");
            }
            let state = if is_outdated { Some(State::Initial) } else { state };
            let [comments, comments_mark] = column.comments;
            let has_comments = comments.is_some();
            let comments = comments.and_then(|at| self.cells.get(at)).into_iter().flat_map(|cell| cell.lines());
            Some(Entry {
                key: Arc::clone(&key),
                segment,
                source: source.clone(),
                source_mark,
                state: if text.text.is_empty() { State::Initial } else { state.unwrap_or(State::Translated) },
                says_state: state.is_some(),
                text,
                mark: self.mark(header.mark(column, &locale)),
                comments: comments.map(str::trim).filter(|line| !line.is_empty()).map(str::to_owned).collect(),
                // Without their column, no comment was deleted.
                comments_mark: comments_mark.filter(|_| has_comments).and_then(|at| self.mark(Some(at))),
                locale,
                is_of_table: true,
                ..Entry::default()
            })
        };
        let before = incoming.entries.len();
        let has_something =
            |entry: &Entry| !entry.text.text.is_empty() || entry.mark.is_some() || !entry.comments.is_empty();
        incoming.entries.extend(header.texts_of(self.cells.len()).filter_map(entry).filter(has_something));
        if incoming.entries.len() == before {
            incoming.entries.extend(header.texts_of(usize::MAX).find_map(entry));
        }
        // Columns were sorted by their marks, which may come before the texts.
        incoming.entries[before..].sort_by_key(|entry| entry.text.span);
    }

    /// Adds the chosen take of a row.
    fn take(&self, mut key: Words, header: &CsvHeader, incoming: &mut IncomingFile) {
        let Some(name) = header.take.map(|at| self.words(at)).filter(|take| !take.text.trim().is_empty()) else {
            return;
        };
        if key.text.trim().is_empty() {
            let message = "the row has a take, but no key";
            let found = Diagnostic::at(Code::ExchangeSyntax, name.span, message);
            incoming.diagnostics.push(found.help("write the key of the clip, or delete the take"));
            return;
        }
        // Recording sheets of Yarn Spinner.
        if let Some(own) = key.text.trim().strip_prefix(YARN_LINE) {
            key.text = own.to_owned();
        }
        incoming.takes.push(ChosenTake { key: key.into(), locales: Arc::clone(header.locales()), name });
    }

    /// Returns the locale of the row, if a column states it.
    fn locale(&self, column: Option<usize>, options: &ReadOptions, incoming: &mut IncomingFile) -> Option<Arc<str>> {
        let language = self.words(column?);
        let locale = options.locale(&language.text).map(Arc::from);
        locale.map_err(|why| incoming.diagnostics.push(why.diagnostic(&language.text, language.span))).ok()
    }
}
