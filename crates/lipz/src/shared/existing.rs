//! Lipz files that exist where a command writes: what is in them stays, or is named before it is lost.

use crate::console;
use crate::interrupt::Files;
use crate::shared::formats;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_file::format::{LineEnding, Style, rewrite};
use lipz_file::rate::Rate;
use lipz_file::{Document, Value};
use lipz_types::VisemeType;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A Lipz file that exists.
pub(crate) struct Existing {
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Existing {
    /// The file at a path, if there is one.
    pub(crate) fn find(path: &Path) -> Result<Option<Existing>, Report> {
        match fs::read(path) {
            Ok(bytes) => Ok(Some(Existing { path: path.to_owned(), bytes })),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(formats::unreadable(path, &error)),
        }
    }

    /// Its elements. Its errors are reported; its warnings are for `lipz check`.
    pub(crate) fn document(&self) -> Result<Document<'_>, Report> {
        let lipz_file::Parsed { document, diagnostics, .. } = lipz_file::parse(&self.bytes);
        let is_whole = !diagnostics.iter().any(Diagnostic::is_error);
        document.filter(|_| is_whole).ok_or_else(|| self.report(diagnostics))
    }

    /// The frame rate and the viseme type that it names.
    pub(crate) fn rate_and_type(&self) -> Result<(Option<Rate>, Option<VisemeType>), Report> {
        let document = self.document()?;
        let rate = match document.get("fps").map(|fps| &fps.value) {
            Some(Value::Number(number)) => lipz_file::rate::parse(&number.text),
            _ => None,
        };
        Ok((rate, document.string("viseme_type").and_then(|name| name.parse().ok())))
    }

    /// A report about it.
    pub(crate) fn report(&self, diagnostics: Vec<Diagnostic>) -> Report {
        Report::from_bytes(console::path(&self.path), &self.bytes, diagnostics)
    }

    /// Gives it other elements than it has. Whatever did not change stays as it is spelled.
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

    /// Replaces it by another document.
    pub(crate) fn replace(&self, files: &Files, text: &str) -> Result<(), Report> {
        files.replace(&self.path, text.as_bytes())
    }

    /// What is lost if another document takes its place, apart from its mouth; `None` if nothing is.
    pub(crate) fn loss(&self, by: &Document<'_>) -> Option<Diagnostic> {
        let shown = console::path(&self.path);
        let Ok(document) = self.document() else {
            let message = format!("`{shown}` is replaced: what it had cannot be read");
            return Some(Diagnostic::new(Code::ClipReplaced, message));
        };
        let lost: Vec<String> = document.lost_in(by).map(|name| escape::quoted(name).to_string()).collect();
        let message = format!("`{shown}` is replaced, without its {}", lost.join(", "));
        (!lost.is_empty()).then(|| Diagnostic::new(Code::ClipReplaced, message))
    }
}
