//! Input files: messages about those that cannot be read, and hidden files.

use crate::console;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io;
use std::path::Path;
use walkdir::DirEntry;

/// The help for a missing file that the user named.
pub(crate) const CHECK_SPELLING: &str = "check the spelling of the path";

/// Returns the report about an unreadable file.
pub(crate) fn unreadable(path: &Path, error: &io::Error) -> Report {
    let name = console::path(path);
    let diagnostic = refused(Code::UnreadableFile, &name, error, [CHECK_SPELLING, "name the files in it"]);
    Report::about(name, diagnostic)
}

/// Returns the diagnostic for an unreadable file, with the help for a missing file and for a folder.
pub(crate) fn refused(code: Code, name: &str, error: &io::Error, [missing, folder]: [&str; 2]) -> Diagnostic {
    let diagnostic = |what: &str| Diagnostic::new(code, format!("`{name}` {what}"));
    match error.kind() {
        io::ErrorKind::NotFound => diagnostic("does not exist").help(missing),
        io::ErrorKind::IsADirectory => diagnostic("is a folder").help(folder),
        _ => diagnostic(&format!("cannot be read: {error}")),
    }
}

/// Whether an entry below a named folder is hidden. Copies made by macOS start with `._`.
pub(crate) fn is_hidden(entry: &DirEntry) -> bool {
    entry.depth() > 0 && entry.file_name().as_encoded_bytes().starts_with(b".")
}
