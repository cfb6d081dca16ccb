//! Writing a bank so that the old one stays whole until the new one is.

use crate::{Report, discover};
use lipz::{Code, Diagnostic};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Replaces the file at `path` by `bytes`: writes a temporary file in the same folder, syncs it and
/// renames it. Whenever the process or the machine stops, `path` is the old file or the new one; what
/// may be left is a file `.NAME.….tmp` beside it. Folders are made, links followed,
/// permissions kept.
///
/// # Errors
/// Whatever the file system refuses, and a `path` that is a folder, a pipe or a device; it is
/// unchanged then.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Report> {
    replace(path, bytes).map_err(|error| {
        let shown = discover::display(path);
        let headline = format!("`{shown}` cannot be written: {}", why(path, &error));
        let finding = Diagnostic::new(Code::OutputFailed, headline);
        Report::about(shown, finding.note("whatever was there before is unchanged"))
    })
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

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let path = &target(path)?;
    let folder = folder_of(path);
    std::fs::create_dir_all(folder)?;
    let prefix = format!(".{}.", path.file_name().unwrap_or_default().to_string_lossy());
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
    if let Ok(metadata) = path.metadata() {
        temporary.as_file().set_permissions(metadata.permissions())?;
    }
    temporary.as_file().sync_all()?;
    temporary.persist(path).map_err(|error| error.error)?;
    if cfg!(unix) {
        // Make the rename last, too. Some file systems cannot: the bank is there all the same.
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
    Ok(())
}
