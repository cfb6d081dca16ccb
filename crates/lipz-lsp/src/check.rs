//! The check of one file, without the rest of its project.

use crate::project::KnownProject;
use lipz_compiler::{Compiler, Content, Input};
use lipz_diagnostics::{Code, Diagnostic};
use std::path::Path;

/// Returns all diagnostics of a Lipz file with this text, ordered by position.
pub(crate) fn check(known: &KnownProject, path: Option<&Path>, text: &str) -> Vec<Diagnostic> {
    let settings = &known.project.settings;
    // A second thread would cost more time than it saves.
    let options = settings.options.clone().voices(settings.voices()).threads(1);
    // Patterns of the settings are matched with this name.
    let name = path.map_or_else(|| "file".to_owned(), |path| path.display().to_string());
    let content = Content::Bytes { name, bytes: text.as_bytes().to_vec() };
    let input = Input { key: known.key(path), content };
    let reports = Compiler::new(options).check(&[input]).reports;
    let mut found: Vec<Diagnostic> = reports.into_iter().flat_map(|report| report.diagnostics).collect();
    // The original is in a different file.
    found.retain(|diagnostic| diagnostic.code != Code::DubWithoutOriginal);
    found.sort_by_key(Diagnostic::start);
    found
}
