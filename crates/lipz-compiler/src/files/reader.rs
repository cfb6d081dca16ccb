//! Reading files relative to their folders.

#[cfg(unix)]
use crate::files::last_folder::LastFolder;
use crate::files::path::display;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The number of bytes read without querying the length, because that takes as long as reading them.
const SMALL_FILE: u64 = 1 << 16;

/// Reads files one after another into a single buffer.
#[derive(Default)]
pub(crate) struct FileReader {
    /// The folder of the last file. Callers that only examine files use it as well.
    #[cfg(unix)]
    pub(crate) folder: LastFolder,
    bytes: Vec<u8>,
}

impl FileReader {
    /// Returns the bytes of the file at `path`, or the report that it cannot be read.
    pub(crate) fn read(&mut self, path: &Path) -> Result<&[u8], Report> {
        let limit = lipz_file::MAX_FILE_BYTES as u64;
        self.bytes.clear();
        let read = self.open(path).and_then(|mut file| {
            if at_once(&file, &mut self.bytes)? {
                return Ok(true);
            }
            file.by_ref().take(SMALL_FILE).read_to_end(&mut self.bytes)?;
            let is_read = (self.bytes.len() as u64) < SMALL_FILE;
            if is_read || file.metadata()?.len() > limit {
                return Ok(is_read);
            }
            // Some files have no known length. One byte beyond the limit shows that they are too large.
            file.take(limit + 1 - SMALL_FILE).read_to_end(&mut self.bytes).map(|_| true)
        });
        let diagnostic = match read {
            Ok(true) => return Ok(&self.bytes),
            Ok(false) => lipz_file::too_large(),
            Err(error) => Diagnostic::new(Code::UnreadableFile, format!("the file cannot be read: {error}")),
        };
        Err(Report::about(display(path), diagnostic))
    }

    /// Opens a file by path. The standard library offers no other way on other systems.
    #[cfg(not(unix))]
    fn open(&mut self, path: &Path) -> io::Result<File> {
        File::open(path)
    }

    #[cfg(unix)]
    fn open(&mut self, path: &Path) -> io::Result<File> {
        use rustix::fs::{Mode, OFlags, openat};
        let Some((folder, name)) = self.folder.of(path) else { return File::open(path) };
        let open = || openat(folder, name, OFlags::RDONLY | OFlags::CLOEXEC, Mode::empty());
        Ok(rustix::io::retry_on_intr(open)?.into())
    }
}

/// The block size of file systems: an error ends the data read before it at a multiple of this.
#[cfg(unix)]
const PAGE_BYTES: usize = 1 << 12;

/// Reads a small file with one call. Returns false and no bytes if the call does not reach the end of the file.
///
/// Usually a second call detects the end, and takes as long as the first. It is not needed if a file ends within a
/// page. A pipe returns partial data, cannot be read at an offset, and produces nothing here.
#[cfg(unix)]
fn at_once(file: &File, bytes: &mut Vec<u8>) -> io::Result<bool> {
    use rustix::buffer::spare_capacity;
    use rustix::io::{Errno, pread, retry_on_intr};
    bytes.reserve(SMALL_FILE as usize);
    match retry_on_intr(|| pread(file, spare_capacity(bytes), 0)) {
        Ok(length) if length % PAGE_BYTES != 0 && length < SMALL_FILE as usize => Ok(true),
        Ok(_) | Err(Errno::SPIPE) => {
            bytes.clear();
            Ok(false)
        }
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(unix))]
fn at_once(_file: &File, _bytes: &mut Vec<u8>) -> io::Result<bool> {
    Ok(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn files_of_all_lengths_are_read_to_their_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let mut reader = FileReader::default();
        let pages = [4095, 4096, 4097, 8192, 65_535, 65_536, 65_537, 200_000];
        for length in [0, 1, 2, 700].into_iter().chain(pages) {
            let bytes: Vec<u8> = (0..length).map(|at| (at % 251) as u8).collect();
            fs::write(&path, &bytes).unwrap();
            assert!(reader.read(&path).unwrap() == bytes, "{length} bytes");
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn pipes_are_read_to_their_end_however_they_are_filled() {
        use std::io::Write;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pipe");
        rustix::fs::mknodat(rustix::fs::CWD, &path, rustix::fs::FileType::Fifo, 0o600.into(), 0).unwrap();
        let writer = {
            let path = path.clone();
            std::thread::spawn(move || {
                let mut pipe = File::options().write(true).open(path).unwrap();
                for part in ["{", "\"text_en-us\"", ":\"Aye.\"}"] {
                    pipe.write_all(part.as_bytes()).unwrap();
                    std::thread::sleep(std::time::Duration::from_millis(20));
                }
            })
        };
        assert_eq!(FileReader::default().read(&path).unwrap(), b"{\"text_en-us\":\"Aye.\"}");
        writer.join().unwrap();
    }
}
