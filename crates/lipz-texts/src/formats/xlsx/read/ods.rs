//! The sheets of an OpenDocument spreadsheet (`.ods`), which are all in one part.
//!
//! OASIS OpenDocument 1.3, part 3, sections 6 (text) and 9 (tables).

use super::MAX_ROWS;
use super::cells::{MAX_COLUMNS, not_text, push};
use super::parts::Refusal;
use super::sheets::{SheetTable, Sheets};
use super::xml::{PartReader, XmlStep};
use crate::exchange::entry::{IncomingFile, ReadOptions};
use crate::formats::csv::CsvRow;

/// Reads the first sheet with a table.
pub(super) fn rows(
    part: &mut PartReader<'_, '_>,
    options: &ReadOptions,
    most_bytes: u64,
    incoming: &mut IncomingFile,
) -> Result<(), Refusal> {
    let mut sheets = Sheets::new(options);
    while let Some(step) = part.next()? {
        if step == XmlStep::Start && part.name() == "table" {
            let name = part.attribute("name").unwrap_or_default();
            let mut has_comments = false;
            sheets.add(name, |sheet| sheet_rows(part, sheet, most_bytes, &mut has_comments))?;
            sheets.has_comments |= has_comments;
        }
    }
    sheets.finish(incoming)
}

/// Reads the rows of the table that has just begun.
fn sheet_rows(
    part: &mut PartReader<'_, '_>,
    sheet: &mut SheetTable<'_>,
    most_bytes: u64,
    has_comments: &mut bool,
) -> Result<(), Refusal> {
    // Rows may be in groups.
    let (mut depth, mut line, mut is_needed) = (1_usize, 0_usize, true);
    while depth > 0 {
        match part.next()? {
            Some(XmlStep::Start) if part.name() == "table-row" => {
                let repeats = repeats(part, "number-rows-repeated");
                let row = row(part, most_bytes, has_comments)?;
                let is_empty = row.iter().all(|cell| cell.text.is_empty() && cell.other_form.is_none());
                let copies = if is_empty { 0 } else { repeats };
                for number in line..line.saturating_add(copies) {
                    if !is_needed {
                        break;
                    }
                    if number >= MAX_ROWS {
                        return Err(format!("it has more than {MAX_ROWS} rows").into());
                    }
                    sheet.move_to_line(number + 1);
                    let row = csv_row(&row, sheet.text());
                    is_needed = sheet.row(row);
                    if sheet.text().len() as u64 > most_bytes {
                        return Err(Refusal::too_large("its cells have", most_bytes));
                    }
                }
                line = line.saturating_add(repeats);
            }
            Some(XmlStep::Start) => depth += 1,
            Some(XmlStep::End) => depth -= 1,
            Some(XmlStep::Text | XmlStep::Other) => {}
            None => break,
        }
    }
    Ok(())
}

/// A cell.
#[derive(Clone)]
struct OdsCell {
    text: String,
    /// The content of a cell that is not a text, although its author may have typed one.
    other_form: Option<&'static str>,
}

/// Reads the row that has just begun, without the empty cells at its end.
fn row(part: &mut PartReader<'_, '_>, most_bytes: u64, has_comments: &mut bool) -> Result<Vec<OdsCell>, Refusal> {
    let mut row = Vec::new();
    // Sheets end with thousands of empty cells.
    let (mut empty, mut bytes) = (0_usize, 0_u64);
    while let Some(step) = part.next()? {
        match step {
            XmlStep::Start if matches!(part.name(), "table-cell" | "covered-table-cell") => {
                let repeats = repeats(part, "number-columns-repeated");
                let cell = cell(part, has_comments)?;
                if cell.text.is_empty() && cell.other_form.is_none() {
                    empty = empty.saturating_add(repeats);
                    continue;
                }
                if row.len().saturating_add(empty).saturating_add(repeats) > MAX_COLUMNS {
                    return Err(format!("a row has more than {MAX_COLUMNS} cells").into());
                }
                bytes = bytes.saturating_add((cell.text.len() as u64).saturating_mul(repeats as u64));
                if bytes > most_bytes {
                    return Err(Refusal::too_large("the cells of a row have", most_bytes));
                }
                let blank = OdsCell { text: String::new(), other_form: None };
                row.extend(std::iter::repeat_n(blank, empty));
                row.extend(std::iter::repeat_n(cell, repeats));
                empty = 0;
            }
            XmlStep::Start => part.skip()?,
            XmlStep::End => break,
            XmlStep::Text | XmlStep::Other => {}
        }
    }
    Ok(row)
}

/// Reads the cell that has just begun. A number has its stored value, other content the text that the sheet shows.
fn cell(part: &mut PartReader<'_, '_>, has_comments: &mut bool) -> Result<OdsCell, Refusal> {
    let kinds: Vec<String> = part.attributes("value-type").collect();
    let value = part.attribute("value");
    let other_form = match kinds.first().map(String::as_str) {
        _ if kinds.iter().any(|kind| kind == "error") => Some("an error"),
        Some("boolean") => Some("a truth value"),
        Some("date") => Some("a date"),
        Some("time") => Some("a time"),
        Some("percentage") => Some("a percentage"),
        Some("currency") => Some("an amount of money"),
        Some("float") if value.as_ref().is_some_and(|value| value.contains(['e', 'E'])) => {
            Some("a number with an exponent")
        }
        _ => None,
    };
    let (mut text, mut paragraphs) = (String::new(), 0);
    while let Some(step) = part.next()? {
        match step {
            XmlStep::Start if part.name() == "p" => {
                if paragraphs > 0 {
                    text.push('\n');
                }
                paragraphs += 1;
                add_paragraph(part, &mut text)?;
            }
            XmlStep::Start => {
                // The others are pictures.
                *has_comments |= part.name() == "annotation";
                part.skip()?;
            }
            XmlStep::End => break,
            XmlStep::Text | XmlStep::Other => {}
        }
    }
    let is_number = kinds.first().is_some_and(|kind| kind == "float");
    Ok(OdsCell { text: value.filter(|_| is_number).unwrap_or(text), other_form })
}

/// Appends the text of the paragraph that has just begun.
fn add_paragraph(part: &mut PartReader<'_, '_>, text: &mut String) -> Result<(), Refusal> {
    let mut depth = 1_usize;
    while depth > 0 {
        match part.next()? {
            Some(XmlStep::Text) => text.push_str(part.text()),
            Some(XmlStep::Start) => {
                depth += 1;
                match part.name() {
                    "s" => text.extend(std::iter::repeat_n(' ', repeats(part, "c").min(MAX_SPACES))),
                    "tab" => text.push('\t'),
                    "line-break" => text.push('\n'),
                    // Notes and phonetic readings.
                    "annotation" | "note" | "ruby-text" => {
                        part.skip()?;
                        depth -= 1;
                    }
                    _ => {}
                }
            }
            Some(XmlStep::End) => depth -= 1,
            Some(XmlStep::Other) => {}
            None => break,
        }
    }
    Ok(())
}

/// The most spaces that one element stands for.
const MAX_SPACES: usize = 1 << 10;

/// Returns how often the cell or row that has just begun is repeated, including the first time.
fn repeats(part: &PartReader<'_, '_>, name: &str) -> usize {
    part.attribute(name).and_then(|count| count.parse().ok()).unwrap_or(1)
}

fn csv_row(cells: &[OdsCell], text: &mut String) -> CsvRow {
    let mut row = CsvRow { start: text.len(), ..CsvRow::default() };
    for (at, cell) in cells.iter().enumerate() {
        push(&mut row, if cell.other_form.is_some() { "" } else { &cell.text }, text);
        row.faults.extend(cell.other_form.map(|what| (at, not_text(row.span(at), what))));
    }
    row
}
