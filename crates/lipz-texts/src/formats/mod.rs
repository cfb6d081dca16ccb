//! The formats, with common functions to read and write them.

pub(crate) mod csv;
mod json;
mod po;
mod xliff;
#[cfg(feature = "xlsx")]
pub(crate) mod xlsx;

use crate::exchange::entry::{Entry, IncomingFile, ReadOptions};
use crate::exchange::write_options::{Shape, WriteOptions};
use crate::exchange::{Exchange, Mark};
use lipz_diagnostics::{Code, Diagnostic, bound};
use std::collections::HashSet;

/// A format for exchange with translators.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Format {
    /// gettext PO: a file per locale.
    Po,
    /// XLIFF 2.1: a file per locale, with a unit per clip and a segment for each of its segments.
    Xliff,
    /// XLIFF 1.2, for tools without support for later versions: a file per locale.
    Xliff12,
    /// Comma-separated values (RFC 4180). `;` and tabs can also be read.
    Csv,
    /// A spreadsheet with the same columns, for Excel, LibreOffice and Google Sheets. OpenDocument spreadsheets (`.ods`)
    /// can also be read.
    #[cfg(feature = "xlsx")]
    Xlsx,
    /// All exchanged data, for programs.
    Json,
}

/// The result of writing.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct WriteResult {
    /// One file for all locales, or one for each of them.
    pub files: Vec<WrittenFile>,
    /// The losses.
    pub diagnostics: Vec<Diagnostic>,
}

/// A file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct WrittenFile {
    /// The locale of the file; `None` if it contains all.
    pub locale: Option<String>,
    /// The content of the file.
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

    /// Returns the format of a file with this extension, in either case.
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
            // `.xls` files are recognised, and refused with a reason.
            "xlsx" | "ods" | "xls" => Format::Xlsx,
            "json" => Format::Json,
            _ => return None,
        })
    }

    /// Returns the extension of files in this format. The versions of XLIFF share one, because the file states its
    /// version.
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

    /// Whether a file only contains translations into one locale.
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

/// Writes the file or files of an exchange. The same texts always produce the same bytes.
pub fn write(format: Format, exchange: &Exchange, options: &WriteOptions) -> WriteResult {
    let mut written = WriteResult::default();
    let one = |locale: Option<usize>, diagnostics: &mut Vec<Diagnostic>| match (format, locale) {
        (Format::Po, Some(at)) => po::write(exchange, at, options, diagnostics),
        (Format::Xliff, Some(at)) => xliff::write_2_1(exchange, at),
        (Format::Xliff12, Some(at)) => xliff::write_1_2(exchange, at, options.division),
        (Format::Csv, locale) => csv::write(exchange, locale, options, diagnostics),
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

/// Reads the entries of a file with arbitrary content.
pub fn read(format: Format, bytes: &[u8], options: &ReadOptions) -> IncomingFile {
    let mut incoming = IncomingFile::default();
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
        let message = format!("texts in {} are not imported because it is the source locale", options.source_locale);
        let diagnostic = Diagnostic::at(Code::ExchangeLoss, first.text.span, message)
            .help("edit them in the Lipz files, or name a different source locale with `--from`");
        incoming.diagnostics.push(diagnostic);
    }
    incoming.entries.retain(|entry: &Entry| options.wants(&entry.locale));
    incoming.entries.iter_mut().for_each(Entry::find_variant);
    keep_comments(&mut incoming);
    incoming
}

/// Keeps the comments of translators if a tool has removed all of them: several clips had comments, and no entry has any.
fn keep_comments(incoming: &mut IncomingFile) {
    let clips: HashSet<&str> = (incoming.entries.iter())
        .filter(|entry| entry.comments_mark.is_some_and(|mark| mark != Mark::of_comments(&[])))
        .map(|entry| entry.key.text.as_str())
        .collect();
    if clips.len() < 2 || incoming.entries.iter().any(|entry| !entry.comments.is_empty()) {
        return;
    }
    let message = format!("the comments of translators on {} clips are missing, and are kept", clips.len());
    let help = "the program that saved the file may have removed them; delete unwanted comments in lipz-texts.txt";
    incoming.diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help(help));
    for entry in &mut incoming.entries {
        entry.comments_mark = None;
    }
}
