//! Matching of the texts of many recordings with the imported files.

use super::ImportVisemes;
use super::options::Settings;
use super::pending_clip::PendingClip;
use super::text::{TextFolder, TextSource};
use crate::console;
use crate::shared::formats;
use lipz_compiler::key::folded;
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_interop::Script;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// The most names that a diagnostic lists.
const NAMES_SHOWN: usize = 8;

/// Reports files without a text in `--script`, and texts without a file.
pub(super) fn report(
    arguments: &ImportVisemes,
    files: &[PathBuf],
    made: &[PendingClip],
    settings: &Settings<'_>,
    texts: &TextSource,
    script: &Script,
) -> Result<Option<Report>, Report> {
    let (place, what) = match (&arguments.options.recordings.script, texts) {
        (_, TextSource::Folder(folder)) => (&folder.path, "folder of texts"),
        (Some(script), TextSource::OfFiles) => (script, "script"),
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
                .help("compare the names of the files with those of the texts"),
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
    // An import of a single file does not need all other texts.
    if files.len() > 1 {
        let (unused, count) = match texts {
            TextSource::Folder(folder) => unused_files(arguments, files, folder)?,
            _ => unused_lines(arguments, files, script),
        };
        if !unused.is_empty() {
            let (all, does) = (console::counted(count, "text"), if unused.len() == 1 { "does" } else { "do" });
            let message = format!("{} of {all} in the {what} {does} not belong to an imported file", unused.len());
            tell(unused.len(), message, &unused.iter().map(String::as_str).collect::<Vec<_>>());
        }
    }
    settings.apply_levels(&mut diagnostics);
    Ok((!diagnostics.is_empty()).then(|| Report::all_about(console::path(place), diagnostics)))
}

/// Returns the keys of the texts in a folder that match no imported file, and the number of its texts.
fn unused_files(
    arguments: &ImportVisemes,
    files: &[PathBuf],
    folder: &TextFolder,
) -> Result<(Vec<String>, usize), Report> {
    let extension = arguments.tool_format.extension;
    let imported: HashSet<&Path> = files.iter().map(PathBuf::as_path).collect();
    // A folder can contain both: `mayor.lipz.txt` is not the text of `mayor.lipz`.
    let is_of_format = |path: &Path| extension.contains('.') && console::path(path).ends_with(&format!(".{extension}"));
    let mut keys = folder.keys(|path| is_of_format(path) || imported.contains(path))?;
    let count = keys.len();
    let key = |file: &PathBuf| formats::key_below(arguments.root.as_deref(), file, extension).ok();
    let used: HashSet<String> = files.iter().filter_map(key).map(|key| folded(&key)).collect();
    keys.retain(|key| !used.contains(&folded(key)));
    Ok((keys, count))
}

/// Returns the names of the texts in a script that match no imported file, and the number of its texts.
fn unused_lines(arguments: &ImportVisemes, files: &[PathBuf], script: &Script) -> (Vec<String>, usize) {
    let extension = arguments.tool_format.extension;
    let stems: Vec<String> = files.iter().map(|file| formats::stem(file, extension)).collect();
    let unused = script.names_without(files.iter().map(PathBuf::as_path).zip(stems.iter().map(String::as_str)));
    (unused.into_iter().map(str::to_owned).collect(), script.len())
}
