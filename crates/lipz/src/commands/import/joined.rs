//! Whether the texts of many recordings and the imported files belong together.

use super::Import;
use super::made::Made;
use super::options::Settings;
use super::text::Texts;
use crate::console;
use crate::shared::formats;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_interop::Script;
use std::path::PathBuf;

/// Names that a diagnostic lists.
const NAMES_SHOWN: usize = 8;

/// What about the texts that `--script` or a folder of `--text` has: files without a text, texts without a file.
pub(super) fn report(
    arguments: &Import,
    files: &[PathBuf],
    made: &[Made],
    settings: &Settings<'_>,
    texts: &Texts,
    script: &Script,
) -> Option<Report> {
    let (place, what) = match (&arguments.options.recordings.script, texts) {
        (Some(script), _) => (script, "script"),
        (None, Texts::Folder(folder)) => (folder, "folder of texts"),
        _ => return None,
    };
    let without: Vec<&str> = made.iter().filter(|made| !made.has_text).map(|made| made.stem.as_str()).collect();
    let mut diagnostics = Vec::new();
    let mut tell = |count: usize, what: String, names: &[&str]| {
        let shown: Vec<String> = names.iter().take(NAMES_SHOWN).map(|name| escape::quoted(name).to_string()).collect();
        let more = if count > shown.len() { format!(", and {} more", count - shown.len()) } else { String::new() };
        diagnostics.push(
            Diagnostic::new(Code::TextNotJoined, what)
                .note(format!("{}{more}", shown.join(", ")))
                .help("texts are found by the names of files: compare them with those that have texts"),
        );
    };
    if !without.is_empty() {
        let have = if without.len() == 1 { "has" } else { "have" };
        tell(
            without.len(),
            format!("{} of {} {have} no text in the {what}", without.len(), console::counted(made.len(), "clip")),
            &without,
        );
    }
    // Whoever imports one file does not expect to see all others of its script.
    if files.len() > 1 {
        let extension = arguments.tool_format.extension;
        let stems: Vec<String> = files.iter().map(|file| formats::stem(file, extension)).collect();
        let named = files.iter().map(PathBuf::as_path).zip(stems.iter().map(String::as_str));
        let unused = script.names_without(named);
        if !unused.is_empty() {
            let (all, belong) = (script.len(), if unused.len() == 1 { "belongs" } else { "belong" });
            let message = format!(
                "{} of {} in the script {belong} to no imported file",
                unused.len(),
                console::counted(all, "text")
            );
            tell(unused.len(), message, &unused);
        }
    }
    settings.apply_levels(&mut diagnostics);
    (!diagnostics.is_empty()).then(|| Report::all_about(console::path(place), diagnostics))
}
