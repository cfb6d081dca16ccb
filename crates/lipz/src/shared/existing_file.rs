//! Existing Lipz files at the output path of a command: their contents are kept, or named before they are lost.

use crate::console;
use crate::interrupt::Files;
use crate::shared::input_file;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::rate::Rate;
use lipz_file::{Document, Value};
use lipz_types::VisemeType;
use std::io;
use std::path::{Path, PathBuf};

/// An existing Lipz file.
pub(crate) struct ExistingFile {
    path: PathBuf,
    bytes: Vec<u8>,
}

impl ExistingFile {
    /// Returns the file at a path, if there is one.
    pub(crate) fn find(path: &Path) -> Result<Option<ExistingFile>, Report> {
        match input_file::read(path) {
            Ok(bytes) => Ok(Some(ExistingFile { path: path.to_owned(), bytes })),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(input_file::unreadable(path, &error)),
        }
    }

    /// Returns its elements, or a report with its errors. `lipz check` reports its warnings.
    pub(crate) fn document(&self) -> Result<Document<'_>, Report> {
        let lipz_file::ParsedFile { document, diagnostics, .. } = lipz_file::parse(&self.bytes);
        let is_whole = !diagnostics.iter().any(Diagnostic::is_error);
        document.filter(|_| is_whole).ok_or_else(|| self.report(diagnostics))
    }

    /// Returns its frame rate and its viseme type, where it sets them.
    pub(crate) fn rate_and_type(&self) -> Result<(Option<Rate>, Option<VisemeType>), Report> {
        let document = self.document()?;
        let rate = match document.get("fps").map(|fps| &fps.value) {
            Some(Value::Number(number)) => lipz_file::rate::parse(&number.text),
            _ => None,
        };
        Ok((rate, document.string("viseme_type").and_then(|name| name.parse().ok())))
    }

    /// Returns a report about it.
    pub(crate) fn report(&self, diagnostics: Vec<Diagnostic>) -> Report {
        Report::from_bytes(console::path(&self.path), &self.bytes, diagnostics)
    }

    /// Replaces its elements. Unchanged elements keep their spelling.
    pub(crate) fn update(
        &self,
        files: &Files,
        before: &Document<'_>,
        after: &Document<'_>,
        locale: Option<&str>,
    ) -> Result<(), Report> {
        let text = String::from_utf8_lossy(&self.bytes);
        let style = Style { default_locale: locale, line_ending: LineEnding::detect(&text) };
        let after = rewrite(&text, before, after, style);
        files.rewrite(&self.path, &self.bytes, after.as_bytes())
    }

    /// Replaces the whole document.
    pub(crate) fn replace(&self, files: &Files, text: &str) -> Result<(), Report> {
        files.replace(&self.path, text.as_bytes())
    }

    /// Returns a diagnostic about the contents, apart from visemes, that a replacement would lose; `None` if there are
    /// none.
    pub(crate) fn loss(&self, by: &Document<'_>) -> Option<Diagnostic> {
        let shown = console::path(&self.path);
        let Ok(document) = self.document() else {
            let message = format!("`{shown}` is replaced, but its old contents cannot be read");
            return Some(Diagnostic::new(Code::ClipReplaced, message));
        };
        let lost: Vec<String> = document.lost_in(by).map(|name| escape::quoted(name).to_string()).collect();
        let message = format!("`{shown}` is replaced without its {}", lost.join(", "));
        (!lost.is_empty()).then(|| Diagnostic::new(Code::ClipReplaced, message))
    }
}
