//! Reading files, each relative to the folder that it lies in.

use crate::discover::display;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Bytes that are read without asking how many there are, which takes as long as to read them.
const SMALL_FILE: u64 = 1 << 16;

/// Reads files one after another into one buffer, and keeps the folder of the last one open: a name is
/// found in an open folder in two thirds of the time that a whole path takes.
#[derive(Default)]
pub(crate) struct FileReader {
    #[cfg(unix)]
    folder: Option<(std::path::PathBuf, File)>,
    bytes: Vec<u8>,
}

impl FileReader {
    /// The bytes of the file at `path`, or the report that it cannot be read.
    pub(crate) fn read(&mut self, path: &Path) -> Result<&[u8], Report> {
        let limit = lipz_file::MAX_FILE_BYTES as u64;
        self.bytes.clear();
        let read = self.open(path).and_then(|mut file| {
            file.by_ref().take(SMALL_FILE).read_to_end(&mut self.bytes)?;
            let is_read = (self.bytes.len() as u64) < SMALL_FILE;
            if is_read || file.metadata()?.len() > limit {
                return Ok(is_read);
            }
            // Some files do not tell their length: one byte too many shows that they are too large.
            file.take(limit + 1 - SMALL_FILE).read_to_end(&mut self.bytes).map(|_| true)
        });
        let diagnostic = match read {
            Ok(true) => return Ok(&self.bytes),
            Ok(false) => lipz_file::too_large(),
            Err(error) => Diagnostic::new(Code::UnreadableFile, format!("the file cannot be read: {error}")),
        };
        Err(Report::about(display(path), diagnostic))
    }

    /// Elsewhere, the standard library has no other way than the path.
    #[cfg(not(unix))]
    fn open(&mut self, path: &Path) -> io::Result<File> {
        File::open(path)
    }

    #[cfg(unix)]
    fn open(&mut self, path: &Path) -> io::Result<File> {
        use rustix::fs::{Mode, OFlags, openat};
        let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { return File::open(path) };
        // As strings: paths are compared part by part.
        if self.folder.as_ref().is_none_or(|(open, _)| open.as_os_str() != folder.as_os_str()) {
            self.folder = File::open(folder).ok().map(|file| (folder.to_owned(), file));
        }
        let Some((_, folder)) = &self.folder else { return File::open(path) };
        let open = || openat(folder, name, OFlags::RDONLY | OFlags::CLOEXEC, Mode::empty());
        Ok(rustix::io::retry_on_intr(open)?.into())
    }
}
