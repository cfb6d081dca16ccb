//! The bytes of a file, in memory or mapped.

use memmap2::Mmap;
use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::ops::Deref;
use std::path::Path;

/// The most bytes that a bank has: its offsets have 32 bits.
const LONGEST_BANK: u64 = u32::MAX as u64;

/// Where the bytes of a file are.
#[derive(Debug)]
enum Backing {
    /// In memory of this process: nobody can change the bytes any more.
    Memory,
    /// In the file, which is mapped into the address space.
    Map,
}

/// The bytes of a file, which can be used as `&[u8]`.
pub struct FileBytes(Bytes);

enum Bytes {
    InMemory(Vec<u8>),
    Mapped(Mmap),
}

impl FileBytes {
    /// Reads the file at `path` into memory. What happens to the file afterwards does not change the bytes.
    ///
    /// # Errors
    /// When the system cannot open or read the file; `IsADirectory` for a folder. Of a file that is longer than any
    /// bank, only as much is read as `Bank::open` needs to refuse it.
    pub fn read(path: impl AsRef<Path>) -> io::Result<FileBytes> {
        FileBytes::read_from(&File::open(path)?)
    }

    /// Maps the file at `path` into the address space: this takes microseconds however long the file is, only the
    /// pages that are touched are read, and all programs that map the file share them.
    ///
    /// # Safety
    /// As long as these bytes exist, no process changes or truncates the file. To replace it, rename a new file
    /// over it, as `lipz pack` does. Otherwise the bytes change under a reader that has checked them, which is
    /// undefined behaviour, and access to pages that are gone ends the program.
    ///
    /// # Errors
    /// When the system cannot open or map the file; `IsADirectory` for a folder.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn map(path: impl AsRef<Path>) -> io::Result<FileBytes> {
        let file = File::open(path)?;
        // SAFETY: the same contract.
        unsafe { FileBytes::map_from(&file) }
    }

    pub(crate) fn read_from(mut file: &File) -> io::Result<FileBytes> {
        let expected_bytes = file.metadata()?.len().min(LONGEST_BANK + 1);
        let mut bytes = Vec::new();
        let is_reserved = bytes.try_reserve_exact(usize::try_from(expected_bytes).unwrap_or(usize::MAX));
        is_reserved.map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))?;
        Read::by_ref(&mut file).take(LONGEST_BANK + 1).read_to_end(&mut bytes)?;
        Ok(FileBytes(Bytes::InMemory(bytes)))
    }

    /// # Safety
    /// That of [`FileBytes::map`].
    #[allow(unsafe_code)] // the caller keeps the contract
    pub(crate) unsafe fn map_from(mut file: &File) -> io::Result<FileBytes> {
        // A folder refuses to be read with a better reason than to be mapped.
        let _ = file.read(&mut [0])?;
        // SAFETY: nobody changes or truncates the file while it is mapped: the contract.
        let map = unsafe { Mmap::map(file) }?;
        Ok(FileBytes(Bytes::Mapped(map)))
    }

    /// Announces that all of a mapped file is about to be read, in order.
    pub(crate) fn expect_all(&self) {
        #[cfg(unix)]
        self.advise(memmap2::Advice::Sequential);
    }

    /// Announces that pages of a mapped file will be touched here and there: without this the system reads
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

impl Deref for FileBytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match &self.0 {
            Bytes::InMemory(bytes) => bytes,
            Bytes::Mapped(map) => map,
        }
    }
}

/// Bytes that were made or received, not read from a file.
impl From<Vec<u8>> for FileBytes {
    fn from(bytes: Vec<u8>) -> FileBytes {
        FileBytes(Bytes::InMemory(bytes))
    }
}

/// How many bytes, and where they are.
impl fmt::Debug for FileBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let backing = match &self.0 {
            Bytes::InMemory(_) => Backing::Memory,
            Bytes::Mapped(_) => Backing::Map,
        };
        f.debug_struct("FileBytes").field("length_bytes", &self.len()).field("backing", &backing).finish()
    }
}
