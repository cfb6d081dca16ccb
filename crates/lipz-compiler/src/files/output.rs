//! Writing a bank so that the old one stays intact until the new one is complete.

use crate::files::Replace;
use crate::files::path::display;
use crate::files::temporary::{Leftovers, TemporaryFile, folder_of, sync_folders, sync_temporary};
use crate::util::parallel;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::File;
use std::io;
use std::path::Path;

/// Replaces the file at `path` with `bytes`: writes a temporary file in the same folder, syncs it and renames it.
/// Whenever the process or the machine stops, `path` is either the old file or the new one. A temporary file
/// `.NAME.….lipztmp` may be left next to it, which is removed when something is written there an hour later. Folders
/// are created and links followed. The new file gets the permissions of the old one and, as far as the system permits,
/// its owner, group and extended attributes. Other hard links to it keep the old content.
///
/// # Errors
/// Errors of the file system, and if `path` is a folder, a pipe or a device. It stays unchanged.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Report> {
    synced(path, bytes).and_then(replace).map_err(|error| failed(path, &error))
}

/// Replaces a file if `check` finds no errors. The check runs while the temporary file is written and synced, before it
/// is renamed.
#[cfg(any(feature = "build", feature = "cache"))]
pub(crate) fn replace_file_if(
    path: &Path,
    bytes: &[u8],
    check: impl FnOnce() -> Result<(), Report> + Send,
) -> Result<(), Report> {
    let (written, checked) = parallel::join(|| synced(path, bytes), check);
    checked?;
    written.and_then(replace).map_err(|error| failed(path, &error))
}

/// Replaces a file with content from `write`, if `check`, which runs during syncing, finds no errors. A file that
/// already has these bytes is checked as well, but not replaced unless `replace` requires it. Errors of `write` leave
/// `path` unchanged too. Returns whether the file was replaced.
pub(crate) fn replace_file_with<W, E: From<io::Error> + Send>(
    path: &Path,
    when: Replace,
    write: impl FnOnce(&mut File) -> Result<W, E>,
    check: impl FnOnce() -> Result<(), E> + Send,
) -> Result<(W, bool), E> {
    let (file, written) = TemporaryFile::beside_with(path, write)?;
    if when == Replace::IfDifferent && file.has_contents_of(path) {
        check()?;
        return Ok((written, false));
    }
    let (synced, checked) = parallel::join(|| sync_temporary(std::iter::once(&file)), check);
    checked?;
    synced?;
    replace(file)?;
    Ok((written, true))
}

/// Returns the temporary file with these bytes, synced to disk.
fn synced(path: &Path, bytes: &[u8]) -> io::Result<TemporaryFile> {
    let file = TemporaryFile::beside(path, bytes)?;
    sync_temporary(std::iter::once(&file))?;
    Ok(file)
}

fn replace(file: TemporaryFile) -> io::Result<()> {
    let folders = [file.rename()?];
    sync_folders(&folders);
    Leftovers::default().remove(&folders);
    Ok(())
}

/// Returns the report that the file at `path` cannot be written.
pub(crate) fn failed(path: &Path, error: &io::Error) -> Report {
    let shown = display(path);
    let message = format!("`{shown}` cannot be written: {}", why(path, error));
    let diagnostic = Diagnostic::new(Code::OutputFailed, message).note("an existing file is unchanged");
    Report::about(
        shown,
        match help(error) {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        },
    )
}

/// Returns help for an error whose system message does not suggest any.
fn help(error: &io::Error) -> Option<&'static str> {
    match error.kind() {
        io::ErrorKind::PermissionDenied => Some("choose a folder that you may write to, or change its permissions"),
        io::ErrorKind::ReadOnlyFilesystem => Some("choose a folder on a writable file system"),
        io::ErrorKind::FileTooLarge => Some("raise the system's limit for the size of a file"),
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            Some("free some space, or choose a different folder")
        }
        _ => None,
    }
}

/// Returns the reason why the file at `path` cannot be written.
fn why(path: &Path, error: &io::Error) -> String {
    let folder = folder_of(path);
    if let Some(file) = file_in_the_way(folder) {
        return format!("`{}` is a file, not a folder", display(file));
    }
    // The error of a temporary file contains its path, which is meaningless to users.
    let message = error.to_string();
    message.split(" at path ").next().unwrap_or(&message).to_owned()
}

/// Returns the part of a folder's path that is a file.
pub(crate) fn file_in_the_way(folder: &Path) -> Option<&Path> {
    folder.ancestors().find(|part| part.metadata().is_ok_and(|metadata| !metadata.is_dir()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn what_to_do_about_errors_of_the_system() {
        let help = |kind: io::ErrorKind| failed(Path::new("a"), &kind.into()).diagnostics[0].help.clone();
        assert!(help(io::ErrorKind::PermissionDenied).is_some_and(|help| help.contains("that you may write to")));
        assert!(help(io::ErrorKind::StorageFull).is_some_and(|help| help.contains("free some space")));
        assert!(help(io::ErrorKind::FileTooLarge).is_some_and(|help| help.contains("limit for the size of a file")));
        assert_eq!(help(io::ErrorKind::Other), None);
    }

    #[test]
    fn without_consent_nothing_changes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("old.lipzbank");
        replace_file(&path, b"old").unwrap();
        let refused = || Err(Report::about("", Diagnostic::new(Code::BankDamaged, "refused")));
        let report = replace_file_if(&path, b"new", refused).unwrap_err();
        assert_eq!(report.diagnostics[0].message, "refused");
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    }

    #[test]
    fn a_file_that_is_filled_replaces_another_one_only_with_consent() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("old.lipzbank");
        replace_file(&path, b"old").unwrap();
        let replaced = |when, bytes: &'static [u8], consents: bool| {
            let check = || if consents { Ok(()) } else { Err(io::Error::other("refused")) };
            replace_file_with(&path, when, |file| file.write_all(bytes), check).map(|((), is_new)| is_new).ok()
        };
        assert_eq!(replaced(Replace::Always, b"new", false), None);
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(replaced(Replace::IfDifferent, b"old", false), None, "also a file that stays is checked");
        assert_eq!(replaced(Replace::IfDifferent, b"old", true), Some(false));
        assert_eq!(replaced(Replace::IfDifferent, b"odd", true), Some(true));
        assert_eq!(replaced(Replace::Always, b"odd", true), Some(true));
        assert_eq!(std::fs::read(&path).unwrap(), b"odd");
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    }
}
