//! The formats, and one way to read and to write them all.

use crate::csv::{self, Shape};
#[cfg(feature = "xlsx")]
use crate::xlsx;
use crate::{Division, Entry, Exchange, Incoming, ReadOptions, json, po, xliff};
use lipz_diagnostics::{Code, Diagnostic, bound};

/// A format of files for translators.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Format {
    /// gettext PO: a file for each locale.
    Po,
    /// XLIFF 2.1: a file for each locale, a unit for each clip, a segment for each of its segments.
    Xliff,
    /// XLIFF 1.2, for tools that know no other: a file for each locale.
    Xliff12,
    /// Comma-separated values (RFC 4180); on reading also with `;` or tabs.
    Csv,
    /// A spreadsheet with the same columns, for Excel, LibreOffice and Google Sheets.
    #[cfg(feature = "xlsx")]
    Xlsx,
    /// All that is exchanged, for programs.
    Json,
}

/// How a file is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct WriteOptions {
    /// Whether it has a text for each clip or for each segment. Formats that know segments have both.
    pub division: Division,
    /// The columns of a CSV.
    pub shape: Shape,
    /// Whether cells of a CSV are written as they are, even if a spreadsheet takes them for formulas.
    pub raw_cells: bool,
}

impl WriteOptions {
    /// A text for each clip, and columns for spreadsheets.
    #[must_use]
    pub fn new() -> WriteOptions {
        WriteOptions::default()
    }

    /// Sets whether there is a text for each clip or for each segment.
    #[must_use]
    pub fn division(self, division: Division) -> WriteOptions {
        WriteOptions { division, ..self }
    }

    /// Sets the columns of a CSV.
    #[must_use]
    pub fn shape(self, shape: Shape) -> WriteOptions {
        WriteOptions { shape, ..self }
    }

    /// Sets whether cells of a CSV are written as they are.
    #[must_use]
    pub fn raw_cells(self, raw_cells: bool) -> WriteOptions {
        WriteOptions { raw_cells, ..self }
    }
}

/// What was written.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Written {
    /// One file for all locales, or one for each.
    pub files: Vec<WrittenFile>,
    /// What the format cannot hold.
    pub diagnostics: Vec<Diagnostic>,
}

/// A file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct WrittenFile {
    /// The locale of the file; `None` if it has all.
    pub locale: Option<String>,
    /// What is in it.
    pub bytes: Vec<u8>,
}

impl Format {
    /// All formats.
    pub const ALL: &[Format] = &[
        Format::Po,
        Format::Xliff,
        Format::Xliff12,
        Format::Csv,
        #[cfg(feature = "xlsx")]
        Format::Xlsx,
        Format::Json,
    ];

    /// The format of a file with this extension, in any case.
    ///
    /// ```
    /// use lipz_texts::Format;
    /// assert_eq!(Format::of_extension("PO"), Some(Format::Po));
    /// assert_eq!(Format::of_extension("docx"), None);
    /// ```
    pub fn of_extension(extension: &str) -> Option<Format> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "po" | "pot" => Format::Po,
            "xlf" | "xliff" => Format::Xliff,
            "csv" | "tsv" | "txt" => Format::Csv,
            #[cfg(feature = "xlsx")]
            "xlsx" => Format::Xlsx,
            "json" => Format::Json,
            _ => return None,
        })
    }

    /// The extension of files in this format. The versions of XLIFF share one: a file says which it is.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Po => "po",
            Format::Xliff | Format::Xliff12 => "xlf",
            Format::Csv => "csv",
            #[cfg(feature = "xlsx")]
            Format::Xlsx => "xlsx",
            Format::Json => "json",
        }
    }

    /// Whether a file has the translations into one locale only.
    pub fn is_of_one_locale(self, options: &WriteOptions) -> bool {
        match self {
            Format::Po | Format::Xliff | Format::Xliff12 => true,
            Format::Csv => options.shape == Shape::Yarn,
            #[cfg(feature = "xlsx")]
            Format::Xlsx => false,
            Format::Json => false,
        }
    }
}

/// The file or files of an exchange. The same texts give the same bytes.
pub fn write(format: Format, exchange: &Exchange, options: &WriteOptions) -> Written {
    let mut written = Written::default();
    let one = |locale: Option<usize>, diagnostics: &mut Vec<Diagnostic>| match (format, locale) {
        (Format::Po, Some(at)) => po::write(exchange, at, options.division, diagnostics),
        (Format::Xliff, Some(at)) => xliff::write_2_1(exchange, at),
        (Format::Xliff12, Some(at)) => xliff::write_1_2(exchange, at, options.division),
        (Format::Csv, locale) => csv::write(exchange, locale, options),
        #[cfg(feature = "xlsx")]
        (Format::Xlsx, _) => xlsx::write(exchange, options, diagnostics),
        (Format::Json, _) => json::write(exchange),
        (_, None) => Vec::new(),
    };
    if !format.is_of_one_locale(options) {
        let bytes = one(None, &mut written.diagnostics);
        written.files.push(WrittenFile { locale: None, bytes });
        return written;
    }
    for (at, locale) in exchange.locales.iter().enumerate() {
        let bytes = one(Some(at), &mut written.diagnostics);
        written.files.push(WrittenFile { locale: Some(locale.clone()), bytes });
    }
    written
}

/// The entries of a file, whatever its bytes are.
pub fn read(format: Format, bytes: &[u8], options: &ReadOptions) -> Incoming {
    let mut incoming = Incoming::default();
    match format {
        Format::Po => po::read(bytes, options, &mut incoming),
        Format::Xliff | Format::Xliff12 => xliff::read(bytes, options, &mut incoming),
        Format::Csv => csv::read(bytes, options, &mut incoming),
        #[cfg(feature = "xlsx")]
        Format::Xlsx => xlsx::read(bytes, options, &mut incoming),
        Format::Json => json::read(bytes, options, &mut incoming),
    }
    bound::limit(&mut incoming.diagnostics);
    incoming.diagnostics.sort_by_key(Diagnostic::start);
    if incoming.diagnostics.iter().any(Diagnostic::is_error) {
        incoming.entries = Vec::new();
    }
    let is_source = |entry: &&Entry| *entry.locale == *options.source_locale && !entry.text.text.is_empty();
    if let Some(first) = incoming.entries.iter().find(is_source) {
        let message = format!("texts in {} are translated, and not imported", options.source_locale);
        let diagnostic = Diagnostic::at(Code::ExchangeLoss, first.text.span, message)
            .help("edit them in the Lipz files; `--from` names another locale that was translated");
        incoming.diagnostics.push(diagnostic);
    }
    incoming.entries.retain(|entry: &Entry| options.wants(&entry.locale));
    incoming
}
