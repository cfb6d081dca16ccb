//! The bytes of a file, mapped or in memory.

use memmap2::Mmap;
use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::ops::Deref;
use std::path::Path;

/// The most bytes that a bank has: its offsets have 32 bits.
const LONGEST_BANK: u64 = u32::MAX as u64;

/// How the bytes of a file are held.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Hold {
    /// Mapped into the address space: opening costs next to nothing, only the pages that are touched are
    /// read, and all programs that map the file share them. For files that nobody changes in place.
    Mapped,
    /// Read into memory: nobody can change the bytes any more.
    InMemory,
}

/// The bytes of a file, which can be used as `&[u8]`.
pub struct FileBytes(Bytes);

enum Bytes {
    Mapped(Mmap),
    InMemory(Vec<u8>),
}

impl FileBytes {
    /// Maps or reads the file at `path`.
    ///
    /// # Errors
    /// What the system refuses; `IsADirectory` for a folder. Of a file that is longer than any bank, only
    /// so much is read into memory that `Bank::open` refuses it.
    pub fn open(path: impl AsRef<Path>, hold: Hold) -> io::Result<FileBytes> {
        FileBytes::of(&File::open(path)?, hold)
    }

    pub(crate) fn of(mut file: &File, hold: Hold) -> io::Result<FileBytes> {
        let metadata = file.metadata()?;
        if metadata.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        Ok(FileBytes(match hold {
            Hold::Mapped => Bytes::Mapped(map(file)?),
            Hold::InMemory => {
                let mut bytes = Vec::new();
                let expected_bytes = metadata.len().min(LONGEST_BANK + 1);
                bytes.try_reserve_exact(usize::try_from(expected_bytes).unwrap_or(usize::MAX))?;
                Read::by_ref(&mut file).take(LONGEST_BANK + 1).read_to_end(&mut bytes)?;
                Bytes::InMemory(bytes)
            }
        }))
    }

    /// Tells the system that all of a mapped file is about to be read, in order.
    pub(crate) fn expect_all(&self) {
        #[cfg(unix)]
        self.advise(memmap2::Advice::Sequential);
    }

    /// Tells the system that pages of a mapped file will be touched here and there: without this it reads
    /// many pages around each, and the first line of a cold bank takes twenty times as long.
    pub(crate) fn expect_queries(&self) {
        #[cfg(unix)]
        self.advise(memmap2::Advice::Random);
    }

    #[cfg(unix)]
    fn advise(&self, advice: memmap2::Advice) {
        if let Bytes::Mapped(map) = &self.0 {
            // Only speed depends on it.
            let _ = map.advise(advice);
        }
    }
}

fn map(file: &File) -> io::Result<Mmap> {
    // SAFETY: the map is only read. Banks are replaced by renaming, never changed in place; should
    // someone else truncate the file while it is read, this process may be stopped by a signal.
    #[expect(unsafe_code, reason = "mapping a file is unsafe by its nature")]
    unsafe {
        Mmap::map(file)
    }
}

impl Deref for FileBytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match &self.0 {
            Bytes::Mapped(map) => map,
            Bytes::InMemory(bytes) => bytes,
        }
    }
}

/// Bytes that were made or received, not read from a file.
impl From<Vec<u8>> for FileBytes {
    fn from(bytes: Vec<u8>) -> FileBytes {
        FileBytes(Bytes::InMemory(bytes))
    }
}

/// How many bytes, and how they are held.
impl fmt::Debug for FileBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hold = match &self.0 {
            Bytes::Mapped(_) => Hold::Mapped,
            Bytes::InMemory(_) => Hold::InMemory,
        };
        f.debug_struct("FileBytes").field("length_bytes", &self.len()).field("hold", &hold).finish()
    }
}
