//! Writing a bank so that the old one stays whole until the new one is.

use crate::{discover, parallel};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Replaces the file at `path` by `bytes`: writes a temporary file in the same folder, syncs it and
/// renames it. Whenever the process or the machine stops, `path` is the old file or the new one; what
/// may be left is a file `.NAME.….tmp` beside it. Folders are made, links followed,
/// permissions kept.
///
/// # Errors
/// Whatever the file system refuses, and a `path` that is a folder, a pipe or a device; it is
/// unchanged then.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Report> {
    TemporaryFile::synced(path, bytes).and_then(TemporaryFile::replace).map_err(|error| failed(path, &error))
}

/// The same, if `check` finds nothing: it runs while the temporary file is written and synced, and
/// without its consent that is never renamed.
pub(crate) fn replace_file_if(
    path: &Path,
    bytes: &[u8],
    check: impl FnOnce() -> Result<(), Report> + Send,
) -> Result<(), Report> {
    let (written, checked) = parallel::join(|| TemporaryFile::synced(path, bytes), check);
    checked?;
    written.and_then(TemporaryFile::replace).map_err(|error| failed(path, &error))
}

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

/// The folder in which the file at `path` lies.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The file that `path` names, through links; an error if it is something else than a file.
fn target(path: &Path) -> io::Result<PathBuf> {
    match path.metadata() {
        Ok(metadata) if metadata.is_file() => path.canonicalize(),
        Ok(metadata) if metadata.is_dir() => Err(io::Error::other("it is a folder")),
        Ok(_) => Err(io::Error::other("it is a pipe or a device, not a file")),
        Err(_) if path.is_symlink() => Err(io::Error::other("it is a link to a file that does not exist")),
        Err(_) => Ok(path.to_owned()),
    }
}

/// A new file beside the one that it will replace. It is removed if it does not.
#[derive(Debug)]
pub(crate) struct TemporaryFile {
    temporary: NamedTempFile,
    target: PathBuf,
}

impl TemporaryFile {
    /// The file with these bytes, on disk.
    fn synced(path: &Path, bytes: &[u8]) -> io::Result<TemporaryFile> {
        let file = TemporaryFile::beside(path, bytes)?;
        file.temporary.as_file().sync_all()?;
        Ok(file)
    }

    /// The file with these bytes, not yet on disk.
    pub(crate) fn beside(path: &Path, bytes: &[u8]) -> io::Result<TemporaryFile> {
        let target = target(path)?;
        let folder = folder_of(&target);
        std::fs::create_dir_all(folder)?;
        let prefix = format!(".{}.", target.file_name().unwrap_or_default().to_string_lossy());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".tmp");
        #[cfg(unix)]
        {
            // Temporary files are private by default; a bank is as public as the umask allows.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut temporary = builder.tempfile_in(folder)?;
        temporary.write_all(bytes)?;
        if let Ok(metadata) = target.metadata() {
            temporary.as_file().set_permissions(metadata.permissions())?;
        }
        Ok(TemporaryFile { temporary, target })
    }

    fn replace(self) -> io::Result<()> {
        let folder = self.rename()?;
        sync_folders(vec![folder]);
        Ok(())
    }

    /// Gives it its name, and returns the folder in which that is.
    pub(crate) fn rename(self) -> io::Result<PathBuf> {
        self.temporary.persist(&self.target).map_err(|error| error.error)?;
        Ok(folder_of(&self.target).to_owned())
    }
}

/// From so many files on, syncing the whole file system is faster than syncing one after the other, each of which
/// waits for its journal.
#[cfg(target_os = "linux")]
const MANY: usize = 8;

/// Brings temporary files to disk.
pub(crate) fn sync_temporary<'t>(files: impl ExactSizeIterator<Item = &'t TemporaryFile>) -> io::Result<()> {
    sync_files(files.map(|file| file.temporary.as_file()))
}

/// Makes renames in these folders last. Some file systems cannot: the files are there all the same.
pub(crate) fn sync_folders(mut folders: Vec<PathBuf>) {
    folders.sort_unstable();
    folders.dedup();
    if cfg!(unix) {
        let open: Vec<File> = folders.iter().filter_map(|folder| File::open(folder).ok()).collect();
        let _ = sync_files(open.iter());
    }
}

#[cfg(target_os = "linux")]
fn sync_files<'f>(files: impl ExactSizeIterator<Item = &'f File>) -> io::Result<()> {
    use std::os::unix::fs::MetadataExt;
    if files.len() < MANY {
        return each_synced(files);
    }
    // Usually they are on one.
    let mut file_systems = Vec::new();
    for file in files {
        let device = file.metadata()?.dev();
        if !file_systems.contains(&device) {
            rustix::fs::syncfs(file)?;
            file_systems.push(device);
        }
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn sync_files<'f>(files: impl ExactSizeIterator<Item = &'f File>) -> io::Result<()> {
    each_synced(files)
}

fn each_synced<'f>(mut files: impl Iterator<Item = &'f File>) -> io::Result<()> {
    files.try_for_each(File::sync_all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_to_do_about_errors_of_the_system() {
        let help = |kind: io::ErrorKind| failed(Path::new("a"), &kind.into()).diagnostics[0].help.clone();
        assert!(help(io::ErrorKind::PermissionDenied).is_some_and(|help| help.contains("that you may write to")));
        assert!(help(io::ErrorKind::StorageFull).is_some_and(|help| help.contains("make room")));
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
}
