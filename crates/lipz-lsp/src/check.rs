//! What is wrong with the text of one file, without a look at others.

use crate::project::Known;
use lipz_compiler::{Compiler, Content, Input};
use lipz_diagnostics::{Code, Diagnostic};
use std::path::Path;

/// The diagnostics of a Lipz file with this text, all of them, in the order of their places.
pub(crate) fn check(known: &Known, path: Option<&Path>, text: &str) -> Vec<Diagnostic> {
    let settings = &known.project.settings;
    // Another thread would cost more than it saves.
    let options = settings.options.clone().voices(settings.voices()).threads(1);
    // Patterns of the settings match it.
    let name = path.map_or_else(|| "file".to_owned(), |path| path.display().to_string());
    let content = Content::Bytes { name, bytes: text.as_bytes().to_vec() };
    let input = Input { key: known.key(path), content };
    let reports = Compiler::new(options).check(&[input]).reports;
    let mut found: Vec<Diagnostic> = reports.into_iter().flat_map(|report| report.diagnostics).collect();
    // Its original is another file.
    found.retain(|diagnostic| diagnostic.code != Code::DubWithoutOriginal);
    found.sort_by_key(Diagnostic::start);
    found
}
