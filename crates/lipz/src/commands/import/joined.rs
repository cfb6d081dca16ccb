//! Whether the texts of many recordings and the imported files belong together.

use super::Import;
use super::made::Made;
use super::options::Settings;
use super::text::{Folder, Texts};
use crate::console;
use crate::shared::formats;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_interop::Script;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

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
) -> Result<Option<Report>, Report> {
    let (place, what) = match (&arguments.options.recordings.script, texts) {
        (Some(script), _) => (script, "script"),
        (None, Texts::Folder(folder)) => (&folder.path, "folder of texts"),
        _ => return Ok(None),
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
    // Whoever imports one file does not expect to see all the other texts.
    if files.len() > 1 {
        let (unused, count) = match texts {
            Texts::Folder(folder) => unused_files(arguments, files, folder)?,
            _ => unused_lines(arguments, files, script),
        };
        if !unused.is_empty() {
            let (all, belong) = (console::counted(count, "text"), if unused.len() == 1 { "belongs" } else { "belong" });
            let message = format!("{} of {all} in the {what} {belong} to no imported file", unused.len());
            tell(unused.len(), message, &unused.iter().map(String::as_str).collect::<Vec<_>>());
        }
    }
    settings.apply_levels(&mut diagnostics);
    Ok((!diagnostics.is_empty()).then(|| Report::all_about(console::path(place), diagnostics)))
}

/// The texts of a folder that are those of no imported file, by their keys, and how many it has.
fn unused_files(arguments: &Import, files: &[PathBuf], folder: &Folder) -> Result<(Vec<String>, usize), Report> {
    let extension = arguments.tool_format.extension;
    let imported: HashSet<&Path> = files.iter().map(PathBuf::as_path).collect();
    // A folder can have both: `mayor.lipz.txt` is no text of `mayor.lipz`.
    let is_of_format = |path: &Path| extension.contains('.') && console::path(path).ends_with(&format!(".{extension}"));
    let mut keys = folder.keys(|path| is_of_format(path) || imported.contains(path))?;
    let count = keys.len();
    let key = |file: &PathBuf| formats::key_below(arguments.root.as_deref(), file, extension).ok();
    let used: HashSet<String> = files.iter().filter_map(key).collect();
    keys.retain(|key| !used.contains(key));
    Ok((keys, count))
}

/// The texts of a script that are those of no imported file, by their names, and how many it has.
fn unused_lines(arguments: &Import, files: &[PathBuf], script: &Script) -> (Vec<String>, usize) {
    let extension = arguments.tool_format.extension;
    let stems: Vec<String> = files.iter().map(|file| formats::stem(file, extension)).collect();
    let unused = script.names_without(files.iter().map(PathBuf::as_path).zip(stems.iter().map(String::as_str)));
    (unused.into_iter().map(str::to_owned).collect(), script.len())
}
