//! The script as a spreadsheet, with a second sheet for the totals of each character.

use super::{RecordingScript, seconds};
use crate::formats::csv::LOCK;
use crate::formats::xlsx::dated_workbook;
use rust_xlsxwriter::{Format, FormatAlign, Worksheet, XlsxError};

/// The columns of the second sheet.
const CUES: [&str; 5] = ["speaker", "lines", "words", "sessions", "original seconds"];

impl RecordingScript {
    /// Returns the script as a spreadsheet. It is ready to print on A4 in landscape.
    ///
    /// # Errors
    /// The reason why the lines do not fit into a spreadsheet.
    pub fn xlsx(&self) -> Result<Vec<u8>, String> {
        self.workbook().map_err(|error| error.to_string())
    }

    fn workbook(&self) -> Result<Vec<u8>, XlsxError> {
        let mut workbook = dated_workbook()?;
        let sheet = workbook.add_worksheet().set_name("script")?;
        table(sheet, &self.rows())?;
        self.set_widths(sheet)?;
        let cues = self.cues().into_iter().map(|cues| {
            let seconds = cues.original_us.map(seconds).unwrap_or_default();
            vec![cues.character, cues.lines.to_string(), cues.words.to_string(), cues.sessions.to_string(), seconds]
        });
        let head = CUES.map(str::to_owned).to_vec();
        let cues: Vec<Vec<String>> = std::iter::once(head).chain(cues).collect();
        table(workbook.add_worksheet().set_name("characters")?, &cues)?;
        workbook.save_to_buffer()
    }

    fn set_widths(&self, sheet: &mut Worksheet) -> Result<(), XlsxError> {
        for (column, name) in (0..).zip(&self.rows()[0]) {
            if name.starts_with(LOCK) {
                sheet.set_column_hidden(column)?;
                continue;
            }
            let is_text = *name == self.source_locale || Some(name) == self.locale.as_ref();
            sheet.set_column_width(column, if is_text { 44 } else { 12 })?;
        }
        Ok(())
    }
}

/// Writes the rows as texts, with a header that stays visible and is printed on each page.
fn table(sheet: &mut Worksheet, rows: &[Vec<String>]) -> Result<(), XlsxError> {
    let head = Format::new().set_bold().set_text_wrap();
    let text = Format::new().set_text_wrap().set_align(FormatAlign::Top).set_num_format("@");
    for (row, cells) in (0..).zip(rows) {
        for (column, cell) in (0..).zip(cells) {
            sheet.write_string_with_format(row, column, cell, if row == 0 { &head } else { &text })?;
        }
    }
    sheet.set_freeze_panes(1, 0)?;
    sheet.set_repeat_rows(0, 0)?;
    sheet.set_landscape().set_paper_size(9).set_print_fit_to_pages(1, 0);
    Ok(())
}
