//! Writing a bank so that the old one stays whole until the new one is.

use crate::temporary::{Leftovers, TemporaryFile, folder_of, sync_folders, sync_temporary};
use crate::{Replace, discover, parallel};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::File;
use std::io;
use std::path::Path;

/// Replaces the file at `path` by `bytes`: writes a temporary file in the same folder, syncs it and
/// renames it. Whenever the process or the machine stops, `path` is the old file or the new one; what
/// may be left is a file `.NAME.….lipztmp` beside it, which goes when something is written there an hour later. Folders
/// are made and links followed. What replaces a file gets its permissions and, as far as the system lets us, its owner,
/// group and extended attributes; another hard link to it stays what it was.
///
/// # Errors
/// Whatever the file system refuses, and a `path` that is a folder, a pipe or a device; it is
/// unchanged then.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Report> {
    synced(path, bytes).and_then(replace).map_err(|error| failed(path, &error))
}

/// The same, if `check` finds nothing: it runs while the temporary file is written and synced, and
/// without its consent that is never renamed.
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

/// The same with a file that `write` fills, if `check`, which runs while that is brought to disk, finds nothing. If it has
/// these bytes already, it is checked all the same, and left alone if that is asked for; tells whether it was replaced. What `write` finds wrong leaves `path` as it
/// is, too.
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

/// The temporary file with these bytes, on disk.
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

/// The report that the file at `path` cannot be written.
pub(crate) fn failed(path: &Path, error: &io::Error) -> Report {
    let shown = discover::display(path);
    let message = format!("`{shown}` cannot be written: {}", why(path, error));
    let diagnostic = Diagnostic::new(Code::OutputFailed, message).note("whatever was there before is unchanged");
    Report::about(
        shown,
        match help(error) {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        },
    )
}

/// What to do about an error that the message of the system does not say itself.
fn help(error: &io::Error) -> Option<&'static str> {
    match error.kind() {
        io::ErrorKind::PermissionDenied => Some("name a folder that you may write to, or have its owner let you"),
        io::ErrorKind::ReadOnlyFilesystem => Some("name a place that can be written to"),
        io::ErrorKind::FileTooLarge => Some("the system limits how long a file may be: have it allow longer ones"),
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => Some("make room there, or name another place"),
        _ => None,
    }
}

/// Why the file at `path` cannot be written.
fn why(path: &Path, error: &io::Error) -> String {
    let folder = folder_of(path);
    if let Some(file) = file_in_the_way(folder) {
        return format!("`{}` is a file, not a folder", discover::display(file));
    }
    // The error of a temporary file tells its path, which says nothing to anybody.
    let message = error.to_string();
    message.split(" at path ").next().unwrap_or(&message).to_owned()
}

/// The part of a folder's path that is a file.
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
        assert!(help(io::ErrorKind::StorageFull).is_some_and(|help| help.contains("make room")));
        assert!(help(io::ErrorKind::FileTooLarge).is_some_and(|help| help.contains("how long a file may be")));
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
