//! Reading of spreadsheets, XLSX and OpenDocument: the first sheet with a table, row by row.

mod cells;
mod ods;
mod parts;
mod sheets;
mod strings;
mod styles;
mod xml;

use crate::exchange::entry::{IncomingFile, ReadOptions};
use crate::formats::csv::CsvRow;
use lipz_diagnostics::{Code, Diagnostic, Span};
pub(super) use parts::exceeded;
use parts::{Parts, Refusal, most_bytes};
use sheets::{SheetTable, Sheets};
use std::collections::HashMap;
use strings::Strings;
use styles::Styles;
use xml::{PartReader, XmlStep};

/// The most rows of a sheet, as in Excel.
const MAX_ROWS: usize = 1 << 20;

/// The most sheets that are searched for a table.
const MAX_SHEETS: usize = 256;

/// The first bytes of files that are not ZIP archives: those of Excel 97, and those with a password.
const OLE2: [u8; 8] = [0xD0, 0xCF, 0x11, 0xE0, 0xA1, 0xB1, 0x1A, 0xE1];

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

/// Reads the rows of the first sheet with a table.
fn rows(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) -> Result<(), Refusal> {
    if bytes.starts_with(&OLE2) {
        return Err(Refusal {
            why: "it has a password, or is in the format of Excel 97 (.xls)".to_owned(),
            help: "open it in a spreadsheet program, and save it as .xlsx or .csv without a password",
        });
    }
    let mut parts = Parts::new(bytes)?;
    if let Some(mut content) = parts.part("content.xml")? {
        return ods::rows(&mut content, options, most_bytes(bytes.len()), incoming);
    }
    let Places { sheets, strings } = places(&mut parts)?;
    let strings = match parts.part(&strings)? {
        Some(mut part) => Strings::read(&mut part)?,
        None => Strings::default(),
    };
    let styles = match parts.part("xl/styles.xml")? {
        Some(mut part) => Styles::read(&mut part)?,
        None => Styles::default(),
    };
    let mut all = Sheets::new(options);
    all.has_comments = parts.has_cell_comments();
    for Sheet { name, path } in sheets {
        let mut part = parts.part(&path)?.ok_or("it has no sheet")?;
        let read_row = |part: &mut PartReader<'_, '_>, text: &mut String| {
            cells::row(part, (&strings, &styles), text, most_bytes(bytes.len()))
        };
        all.add(name, |sheet| sheet_rows(&mut part, sheet, read_row))?;
    }
    all.finish(incoming)
}

/// Reads the rows of a sheet, one by one, until they are not needed.
fn sheet_rows(
    part: &mut PartReader<'_, '_>,
    sheet: &mut SheetTable<'_>,
    read_row: impl Fn(&mut PartReader<'_, '_>, &mut String) -> Result<CsvRow, Refusal>,
) -> Result<(), Refusal> {
    let mut line = 0;
    while let Some(step) = part.next()? {
        if step != XmlStep::Start || part.name() != "row" {
            continue;
        }
        let number = part.attribute("r").and_then(|number| number.parse().ok()).unwrap_or(line + 1);
        if number <= line || number > MAX_ROWS {
            return Err(format!("row {number} follows row {line}").into());
        }
        sheet.move_to_line(number);
        line = number;
        let row = read_row(part, sheet.text())?;
        if !sheet.row(row) {
            break;
        }
    }
    Ok(())
}

/// A sheet of a workbook.
struct Sheet {
    name: String,
    path: String,
}

/// The parts of a workbook.
struct Places {
    sheets: Vec<Sheet>,
    strings: String,
}

/// Returns the names of the parts with the sheets, in their order, and with the shared strings.
fn places(parts: &mut Parts<'_>) -> Result<Places, Refusal> {
    let mut places = Places { sheets: Vec::new(), strings: "xl/sharedStrings.xml".to_owned() };
    let names = match parts.part("xl/workbook.xml")? {
        Some(mut workbook) => sheet_names(&mut workbook)?,
        None => Vec::new(),
    };
    let mut paths: HashMap<String, String> = HashMap::new();
    if let Some(mut relations) = parts.part("xl/_rels/workbook.xml.rels")? {
        while let Some(step) = relations.next()? {
            if step != XmlStep::Start || relations.name() != "Relationship" {
                continue;
            }
            let Some(target) = relations.attribute("Target") else { continue };
            let path = target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_owned);
            if relations.attribute("Type").is_some_and(|kind| kind.ends_with("/sharedStrings")) {
                places.strings.clone_from(&path);
            }
            paths.extend(relations.attribute("Id").map(|id| (id, path)));
        }
    }
    let sheets = names.into_iter().filter_map(|(id, name)| Some(Sheet { name, path: paths.get(&id)?.clone() }));
    places.sheets = sheets.collect();
    if places.sheets.is_empty() {
        let (name, path) = (String::new(), "xl/worksheets/sheet1.xml".to_owned());
        places.sheets.push(Sheet { name, path });
    }
    Ok(places)
}

/// Returns the IDs of a workbook's sheets in its relationships, and their names.
fn sheet_names(workbook: &mut PartReader<'_, '_>) -> Result<Vec<(String, String)>, Refusal> {
    let mut sheets = Vec::new();
    while let Some(step) = workbook.next()? {
        if step == XmlStep::Start && workbook.name() == "sheet" && sheets.len() < MAX_SHEETS {
            let name = workbook.attribute("name").unwrap_or_default();
            sheets.extend(workbook.attribute("id").map(|id| (id, name)));
        }
    }
    Ok(sheets)
}
