//! Writing a bank so that the old one stays whole until the new one is.

use crate::{Report, discover};
use lipz::{Code, Diagnostic};
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

/// Replaces the file at `path` by `bytes`: writes a temporary file in the same folder, syncs it and
/// renames it. Whenever the process or the machine stops, `path` is the old file or the new one.
///
/// # Errors
/// Whatever the file system refuses; `path` is unchanged then.
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Report> {
    replace(path, bytes).map_err(|error| {
        let shown = discover::display(path);
        let headline = format!("`{shown}` cannot be written: {error}");
        let finding = Diagnostic::new(Code::OutputFailed, headline);
        Report::about(shown, finding.note("whatever was there before is unchanged"))
    })
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lipz-").suffix(".tmp");
    #[cfg(unix)]
    {
        // Temporary files are private by default; a bank is as public as the umask allows.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut temporary = builder.tempfile_in(folder)?;
    temporary.write_all(bytes)?;
    temporary.as_file().sync_all()?;
    temporary.persist(path).map_err(|error| error.error)?;
    if cfg!(unix) {
        // Make the rename last, too. Some file systems cannot: the bank is there all the same.
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
    Ok(())
}
