//! Input files that the user names, which may be devices without an end: their bytes, and messages about those that
//! cannot be read.

use crate::console;
use lipz_compiler::settings::NamedFile;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::{File, FileType};
use std::io::{self, Read};
use std::path::Path;
use walkdir::DirEntry;

/// The help for a missing file that the user named.
pub(crate) const CHECK_SPELLING: &str = "check the spelling of the path";

/// The longest file. Files of other tools have at most some megabytes.
pub(crate) const MAX_BYTES: u64 = 1 << 30;

/// Reads a file, or a pipe to its end.
///
/// # Errors
/// If it cannot be read, is a device such as `/dev/zero`, or is longer than [`MAX_BYTES`].
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if is_device(metadata.file_type()) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is a device"));
    }
    read_from(file, metadata.len())
}

/// Reads a stream to its end.
///
/// # Errors
/// If it cannot be read, or is longer than [`MAX_BYTES`]. A stream is not read if the expected length already is.
pub(crate) fn read_from(stream: impl Read, expected_bytes: u64) -> io::Result<Vec<u8>> {
    let too_long = || io::Error::new(io::ErrorKind::FileTooLarge, format!("it is longer than {} MiB", MAX_BYTES >> 20));
    let mut bytes = Vec::new();
    if expected_bytes > MAX_BYTES
        || bytes.try_reserve_exact(usize::try_from(expected_bytes).unwrap_or(usize::MAX)).is_err()
    {
        return Err(too_long());
    }
    stream.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES { Err(too_long()) } else { Ok(bytes) }
}

/// Reads a file of UTF-8.
///
/// # Errors
/// Those of [`read`], and if it contains other bytes.
pub(crate) fn read_text(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error.utf8_error()))
}

/// Reads a file that a setting names.
///
/// # Errors
/// If it cannot be read: the report, at the name of the file in the settings.
pub(crate) fn read_named(file: &NamedFile) -> Result<Vec<u8>, Report> {
    let help = ["correct the path, or restore the file", "name a file in it"];
    read(file.path())
        .map_err(|error| file.report(refused(Code::SettingValue, &console::path(file.path()), &error, help)))
}

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
        io::ErrorKind::PermissionDenied => {
            diagnostic(&format!("cannot be read: {error}")).help("check its permissions")
        }
        _ => diagnostic(&format!("cannot be read: {error}")),
    }
}

/// Whether an entry below a named folder is hidden. Copies made by macOS start with `._`.
pub(crate) fn is_hidden(entry: &DirEntry) -> bool {
    entry.depth() > 0 && entry.file_name().as_encoded_bytes().starts_with(b".")
}

#[cfg(unix)]
fn is_device(file_type: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    file_type.is_char_device() || file_type.is_block_device()
}

#[cfg(not(unix))]
fn is_device(_file_type: FileType) -> bool {
    false
}
