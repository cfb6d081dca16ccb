//! A file for data that memory should not hold. It has no name, or disappears when it is closed.

use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Result, Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

/// Names that other programs already use are skipped: so many at most.
const MOST_NAMES: u32 = 100;

/// A temporary file.
#[derive(Debug)]
pub(crate) struct TemporaryFile {
    file: Mutex<File>,
}

impl TemporaryFile {
    pub(crate) fn new() -> Result<TemporaryFile> {
        static MADE: AtomicU32 = AtomicU32::new(0);
        let mut last = ErrorKind::AlreadyExists.into();
        for _ in 0..MOST_NAMES {
            let number = MADE.fetch_add(1, Ordering::Relaxed);
            let name = format!("lipz-{}-{number}.tmp", std::process::id());
            match open(&std::env::temp_dir().join(name)) {
                Ok(file) => return Ok(TemporaryFile { file: Mutex::new(file) }),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => last = error,
                Err(error) => return Err(error),
            }
        }
        Err(last)
    }

    /// Writes bytes at a place.
    pub(crate) fn write(&self, place: u64, bytes: &[u8]) -> Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(place))?;
        file.write_all(bytes)
    }

    /// Reads bytes from a place.
    pub(crate) fn read(&self, place: u64, bytes: &mut [u8]) -> Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(place))?;
        file.read_exact(bytes)
    }
}

/// Creates a file that only this program can read, and that disappears when it is closed.
#[cfg(unix)]
fn open(path: &PathBuf) -> Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    let file = OpenOptions::new().read(true).write(true).create_new(true).mode(0o600).open(path)?;
    std::fs::remove_file(path)?;
    Ok(file)
}

/// Creates a file that only this program can read, and that disappears when it is closed.
#[cfg(windows)]
fn open(path: &PathBuf) -> Result<File> {
    use std::os::windows::fs::OpenOptionsExt;
    /// `FILE_FLAG_DELETE_ON_CLOSE` of `CreateFileW`.
    const DELETE_ON_CLOSE: u32 = 0x0400_0000;
    let mut options = OpenOptions::new();
    options.read(true).write(true).create_new(true).share_mode(0).custom_flags(DELETE_ON_CLOSE);
    options.open(path)
}

/// Other systems, such as WebAssembly, have no temporary files.
#[cfg(not(any(unix, windows)))]
fn open(_: &PathBuf) -> Result<File> {
    Err(ErrorKind::Unsupported.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_read_where_they_were_written() {
        let file = TemporaryFile::new().unwrap();
        file.write(0, b"abcdef").unwrap();
        file.write(6, b"ghi").unwrap();
        let mut bytes = [0; 4];
        file.read(4, &mut bytes).unwrap();
        assert_eq!(&bytes, b"efgh");
        assert!(file.read(7, &mut bytes).is_err(), "beyond its end");
    }
}
