//! Scripts in tables: CSV, and the tables of Yarn Spinner and Ren'Py.

mod columns;
mod spoken;

use super::{LineText, Purpose, Script, without_extension};
use columns::{Columns, TableOrigin};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::table::{Cell, Rows};

/// The prefix of the IDs of Yarn Spinner.
const YARN_LINE: &str = "line:";

/// Reads the rows of a table.
pub(super) fn of_rows(text: &str, purpose: Purpose<'_>) -> (Script, Vec<Diagnostic>) {
    let (mut script, mut found) = (Script::default(), Vec::new());
    let columns = match columns::find(text, purpose) {
        Ok(columns) => columns,
        Err(diagnostic) => return (script, vec![*diagnostic]),
    };
    let rows = Rows::new(text, columns.delimiter);
    // Ren'Py separates columns with tabs and writes quotes as they are.
    let is_renpy = columns.origin == TableOrigin::RenPy;
    let mut rows = if is_renpy { rows.without_quotes() } else { rows };
    let head = rows.next().and_then(Result::ok).unwrap_or_default();
    let (mut has_rows, mut has_names) = (false, false);
    for row in rows {
        match row {
            Ok(row) if row.iter().all(|cell| cell.text.trim().is_empty()) => {}
            Ok(row) => {
                has_rows = true;
                has_names |= row.get(columns.name).is_some_and(|cell| !cell.text.trim().is_empty());
                let is_of_recordings = purpose == Purpose::Recordings;
                let (column_count, row_span) = (head.len(), span(text, &row));
                let reading = RowReader { columns, column_count, row_span, is_of_recordings };
                reading.add(&row, &mut script, &mut found);
            }
            Err(fault) => {
                has_rows = true;
                found.push(fault.diagnostic(Code::ForeignSyntax));
            }
        }
    }
    if !has_rows {
        let found_head =
            Diagnostic::at(Code::ForeignSyntax, span(text, &head), "no row follows the names of the columns");
        found.push(found_head.help("add the lines of the script, one in each row"));
    } else if is_renpy && !has_names && found.is_empty() {
        let without = Diagnostic::at(Code::ForeignSyntax, span(text, &head), "no row of the table has an identifier");
        let without = without.note("rows without an identifier are menus and other strings, which are not spoken");
        found.push(without.help("extract the dialogue in Ren'Py's launcher as a tab-delimited spreadsheet"));
    }
    (script, found)
}

/// A row that is being read.
struct RowReader {
    columns: Columns,
    column_count: usize,
    row_span: Span,
    /// Whether the texts are transcripts of recordings.
    is_of_recordings: bool,
}

impl RowReader {
    /// Adds the row to the script.
    fn add(&self, row: &[Cell<'_>], script: &mut Script, found: &mut Vec<Diagnostic>) {
        let RowReader { columns, column_count, row_span, .. } = *self;
        if let Some(extra) = row.iter().skip(column_count).find(|cell| !cell.text.trim().is_empty()) {
            let message = format!("the row has more cells than the first line, which names {column_count}");
            let help = "put a text with the character that separates columns in quotes, or name the column";
            found.push(Diagnostic::at(Code::ForeignSyntax, extra.span, message).help(help));
            return;
        }
        let written = row.get(columns.name).map_or("", |cell| cell.text.trim());
        let name = match columns.is_id {
            true => written.strip_prefix(YARN_LINE).unwrap_or(written),
            false => without_extension(written),
        };
        let is_renpy = columns.origin == TableOrigin::RenPy;
        let missing = match row.get(columns.text) {
            Some(text) if !name.is_empty() => {
                let mut text = if is_renpy { without_escapes(&text.text) } else { text.text.clone().into_owned() };
                let parts = spoken::parts(&text, columns.origin);
                if self.is_of_recordings && columns.origin == TableOrigin::YarnSpinner {
                    text = spoken::without_speaker(&text).to_owned();
                }
                if !script.add(name, LineText { text, parts }, row_span) {
                    let message = format!("{} has a different text in a row above", escape::quoted(written));
                    let odd = Diagnostic::at(Code::ForeignOddity, row_span, message);
                    found.push(odd.note("the first text is used"));
                }
                return;
            }
            // Menus and other strings.
            Some(_) if is_renpy => return,
            Some(_) if columns.is_id => "ID",
            Some(_) => "file name",
            None => "text",
        };
        let help = "write both, or remove the row; put a text with commas in quotes";
        found.push(Diagnostic::at(Code::ForeignSyntax, row_span, format!("the row has no {missing}")).help(help));
    }
}

/// Returns the position of a row; of its first line, if it has several.
fn span(text: &str, row: &[Cell<'_>]) -> Span {
    let (start, end) = row.first().zip(row.last()).map_or((0, 0), |(first, last)| (first.span.start, last.span.end));
    let written = text.get(start as usize..end as usize).unwrap_or_default();
    let length = written.lines().next().map_or(0, str::len);
    Span::new(start as usize, start as usize + length)
}

/// Returns a text of Ren'Py without its escapes. Line breaks become spaces.
fn without_escapes(text: &str) -> String {
    let (mut plain, mut characters) = (String::with_capacity(text.len()), text.chars());
    while let Some(character) = characters.next() {
        let escaped = if character == '\\' { characters.next() } else { None };
        plain.push(match escaped {
            Some('n' | 'r' | 't' | 'v' | 'f') => ' ',
            Some(escaped) => escaped,
            None => character,
        });
    }
    plain
}

#[cfg(test)]
mod tests;
