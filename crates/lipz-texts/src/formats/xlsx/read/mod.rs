//! Reading of XLSX files: the first sheet, row by row.

mod cells;
mod parts;
mod strings;
mod styles;
mod xml;

use crate::exchange::entry::{IncomingFile, ReadOptions};
use crate::formats::csv::CsvTable;
use lipz_diagnostics::{Code, Diagnostic, Span};
pub(super) use parts::exceeded;
use parts::{Parts, Refusal, most_bytes};
use strings::Strings;
use styles::Styles;
use xml::{PartReader, XmlStep};

/// The most rows of a sheet, as in Excel.
const MAX_ROWS: usize = 1 << 20;

/// Reads a file with arbitrary content. Positions refer to a text with a line per row of the sheet, and tabs between
/// its cells.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) {
    if let Err(Refusal { why, help }) = rows(bytes, options, incoming) {
        incoming.diagnostics.push(
            Diagnostic::at(
                Code::ExchangeSyntax,
                Span::default(),
                format!("the file cannot be read as a spreadsheet: {why}"),
            )
            .help(help),
        );
    }
}

/// Reads the rows of the first sheet, one by one.
fn rows(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) -> Result<(), Refusal> {
    let most_bytes = most_bytes(bytes.len());
    let mut parts = Parts::new(bytes)?;
    let (sheet, strings) = places(&mut parts)?;
    let strings = match parts.part(&strings)? {
        Some(mut part) => Strings::read(&mut part)?,
        None => Strings::default(),
    };
    let styles = match parts.part("xl/styles.xml")? {
        Some(mut part) => Styles::read(&mut part)?,
        None => Styles::default(),
    };
    let mut sheet = parts.part(&sheet)?.ok_or("it has no sheet")?;
    let (mut table, mut line) = (CsvTable::new(options), 0);
    while let Some(step) = sheet.next()? {
        if step != XmlStep::Start || sheet.name() != "row" {
            continue;
        }
        let number = sheet.attribute("r").and_then(|number| number.parse().ok()).unwrap_or(line + 1);
        if number <= line || number > MAX_ROWS {
            return Err(format!("row {number} follows row {line}").into());
        }
        incoming.text.extend(std::iter::repeat_n('\n', number - line - usize::from(line == 0)));
        line = number;
        let row = cells::row(&mut sheet, (&strings, &styles), &mut incoming.text, most_bytes)?;
        if !table.row(row, incoming) {
            return Ok(());
        }
    }
    table.finish(incoming);
    Ok(())
}

/// Returns the names of the parts with the first sheet and with the shared strings.
fn places(parts: &mut Parts<'_>) -> Result<(String, String), Refusal> {
    let (mut sheet, mut strings) = ("xl/worksheets/sheet1.xml".to_owned(), "xl/sharedStrings.xml".to_owned());
    let id = match parts.part("xl/workbook.xml")? {
        Some(mut workbook) => id_of_first_sheet(&mut workbook)?,
        None => None,
    };
    let Some(mut relations) = parts.part("xl/_rels/workbook.xml.rels")? else { return Ok((sheet, strings)) };
    while let Some(step) = relations.next()? {
        if step != XmlStep::Start || relations.name() != "Relationship" {
            continue;
        }
        let Some(target) = relations.attribute("Target") else { continue };
        let path = target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_owned);
        if id.is_some() && relations.attribute("Id") == id {
            sheet = path;
        } else if relations.attribute("Type").is_some_and(|kind| kind.ends_with("/sharedStrings")) {
            strings = path;
        }
    }
    Ok((sheet, strings))
}

/// Returns the ID of a workbook's first sheet in its relationships.
fn id_of_first_sheet(workbook: &mut PartReader<'_, '_>) -> Result<Option<String>, Refusal> {
    let (mut id, mut is_found) = (None, false);
    while let Some(step) = workbook.next()? {
        if step == XmlStep::Start && workbook.name() == "sheet" && !is_found {
            (id, is_found) = (workbook.attribute("id"), true);
        }
    }
    Ok(id)
}
