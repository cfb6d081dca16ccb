//! The sheets of a workbook, of which the first one with a table is imported.

use super::parts::Refusal;
use crate::exchange::entry::{IncomingFile, ReadOptions};
use crate::formats::csv::{CsvRow, CsvTable};
use lipz_diagnostics::{Code, Diagnostic, escape};

/// The sheets that were read.
pub(super) struct Sheets<'o> {
    options: &'o ReadOptions,
    /// The content of the first sheet with a table.
    table: Option<IncomingFile>,
    /// The content of the first sheet, while none has a table.
    first: Option<IncomingFile>,
    /// The names of other sheets with a table.
    others: Vec<String>,
    /// Whether cells have comments.
    pub(super) has_comments: bool,
}

impl<'o> Sheets<'o> {
    pub(super) fn new(options: &'o ReadOptions) -> Sheets<'o> {
        Sheets { options, table: None, first: None, others: Vec::new(), has_comments: false }
    }

    /// Adds a sheet, whose rows `read` passes on. After the first sheet with a table, only the header is needed.
    pub(super) fn add(
        &mut self,
        name: String,
        read: impl FnOnce(&mut SheetTable<'o>) -> Result<(), Refusal>,
    ) -> Result<(), Refusal> {
        let needs_rows = self.table.is_none();
        let (table, incoming) = (CsvTable::new(self.options), IncomingFile::default());
        let mut sheet = SheetTable { table, incoming, line: 0, needs_rows };
        read(&mut sheet)?;
        let has_header = sheet.table.has_header();
        sheet.table.finish(&mut sheet.incoming);
        match (has_header, needs_rows) {
            (true, true) => self.table = Some(sheet.incoming),
            (true, false) => self.others.push(name),
            (false, _) => _ = self.first.get_or_insert(sheet.incoming),
        }
        Ok(())
    }

    /// Returns the content of the first sheet with a table, or the problems of the first sheet.
    pub(super) fn finish(self, incoming: &mut IncomingFile) -> Result<(), Refusal> {
        *incoming = self.table.or(self.first).ok_or("it has no sheet")?;
        if self.has_comments && !self.options.wants_takes {
            let message = "comments on cells are not imported";
            let help = "write comments into the column for them, such as `comment de-de`";
            incoming.diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help(help));
        }
        if self.others.is_empty() {
            return Ok(());
        }
        let names: Vec<String> = self.others.iter().map(|name| escape::quoted(name).to_string()).collect();
        let (sheets, is) = if names.len() == 1 { ("sheet", "is") } else { ("sheets", "are") };
        let message = format!("the {sheets} {} {is} not imported", names.join(", "));
        let diagnostic = Diagnostic::new(Code::ExchangeLoss, message);
        incoming.diagnostics.push(diagnostic.help("save each sheet with translations as a separate file"));
        Ok(())
    }
}

/// A sheet that is being read.
pub(super) struct SheetTable<'o> {
    table: CsvTable<'o>,
    incoming: IncomingFile,
    /// The number of the last row.
    line: usize,
    needs_rows: bool,
}

impl SheetTable<'_> {
    /// Moves to the line of a row, so that the text has a line for each row of the sheet.
    pub(super) fn move_to_line(&mut self, line: usize) {
        self.incoming.text.extend(std::iter::repeat_n('\n', line - self.line - usize::from(self.line == 0)));
        self.line = line;
    }

    /// Returns the text to which the cells of a row are appended.
    pub(super) fn text(&mut self) -> &mut String {
        &mut self.incoming.text
    }

    /// Adds a row. Returns whether the next one is needed.
    pub(super) fn row(&mut self, row: CsvRow) -> bool {
        let goes_on = self.table.row(row, &mut self.incoming);
        goes_on && (self.needs_rows || !self.table.has_header())
    }
}
