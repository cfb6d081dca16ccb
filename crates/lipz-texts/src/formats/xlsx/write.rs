//! Writing of XLSX files.

use super::MAX_UNPACKED_BYTES;
use super::read::exceeded;
use crate::exchange::Exchange;
use crate::exchange::write_options::{Shape, WriteOptions};
use crate::formats::csv::{LOCK, rows};
use lipz_diagnostics::{Code, Diagnostic, escape};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, FormatAlign, Workbook, Worksheet, XlsxError};

/// The most UTF-16 code units in a cell of Excel.
const CELL_UNITS: usize = 32_767;

/// The size of a cell in the parts of a file, in addition to its text.
const CELL_BYTES: u64 = 64;

/// The width of the columns with texts, in characters.
const TEXT_WIDTH: u16 = 48;

/// Returns the file with all locales.
pub(crate) fn write(exchange: &Exchange, options: &WriteOptions, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let options = options.clone().shape(Shape::Sheet);
    let rows: Vec<Vec<String>> = rows(exchange, None, &options);
    // A cell also has a position and a format.
    let needed = rows.iter().flatten().map(|cell| cell.len() as u64 + CELL_BYTES).sum::<u64>();
    if needed > MAX_UNPACKED_BYTES {
        let message = format!("the spreadsheet would have more than {} megabytes unpacked", MAX_UNPACKED_BYTES >> 20);
        diagnostics.push(refusal(message));
        return Vec::new();
    }
    let made = workbook(&rows, &exchange.source_locale, diagnostics);
    let made = made.map_err(|error| format!("the texts do not fit into a spreadsheet: {error}"));
    // The reader's limit applies, because it would reject such a compression ratio as malicious.
    let is_read = |file: Vec<u8>| match exceeded(&file) {
        Some(most) => Err(format!(
            "lipz could not read the spreadsheet because it has more than {} megabytes unpacked",
            most >> 20
        )),
        None => Ok(file),
    };
    made.and_then(is_read).unwrap_or_else(|message| {
        diagnostics.push(refusal(message));
        Vec::new()
    })
}

/// Returns the diagnostic for texts that cannot be written.
fn refusal(message: String) -> Diagnostic {
    let mut diagnostic =
        Diagnostic::new(Code::ExchangeLoss, message).help("export fewer locales or clips at a time, or CSV");
    diagnostic.severity = lipz_diagnostics::Severity::Error;
    diagnostic
}

/// Returns an empty workbook with a fixed date, so that the same texts always produce the same file.
pub(crate) fn dated_workbook() -> Result<Workbook, XlsxError> {
    let mut workbook = Workbook::new();
    let created = ExcelDateTime::from_ymd(2000, 1, 1)?;
    workbook.set_properties(&DocProperties::new().set_creation_datetime(&created));
    Ok(workbook)
}

fn workbook(rows: &[Vec<String>], source: &str, diagnostics: &mut Vec<Diagnostic>) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = dated_workbook()?;
    let sheet = workbook.add_worksheet().set_name("texts")?;
    sheet.set_freeze_panes(1, 1)?;
    columns(sheet, rows.first().map_or(&[], Vec::as_slice), source)?;
    let (head, text) =
        (Format::new().set_bold(), Format::new().set_text_wrap().set_align(FormatAlign::Top).set_num_format("@"));
    for (row, cells) in (0..).zip(rows) {
        for (column, cell) in (0..).zip(cells) {
            if cell.encode_utf16().count() > CELL_UNITS {
                let key = escape::quoted(cells.first().map_or("", String::as_str));
                let message = format!("a text of {key} has more than {CELL_UNITS} characters and is left out");
                diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help("export it as PO or XLIFF"));
            } else if !cell.is_empty() {
                // Strings are never formulas here.
                sheet.write_string_with_format(row, column, cell, if row == 0 { &head } else { &text })?;
            }
        }
    }
    workbook.save_to_buffer()
}

/// Makes columns with texts wide, and hides those with marks, which must not be changed.
fn columns(sheet: &mut Worksheet, names: &[String], source: &str) -> Result<(), XlsxError> {
    let first_text = names.iter().position(|name| name == source).unwrap_or(names.len());
    for (column, name) in (0..).zip(names) {
        if name.starts_with(LOCK) {
            sheet.set_column_hidden(column)?;
        } else if usize::from(column) >= first_text {
            // Empty cells as well, so that a spreadsheet keeps what translators type.
            sheet.set_column_format(column, &Format::new().set_num_format("@"))?;
            sheet.set_column_width(column, TEXT_WIDTH)?;
        } else {
            sheet.set_column_width(column, 16)?;
        }
    }
    Ok(())
}
