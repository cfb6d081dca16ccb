//! The bytes of a file, in memory or mapped.

use memmap2::Mmap;
use std::fmt;
use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::ops::Deref;
use std::path::Path;

/// The greatest length of a bank, because its offsets have 32 bits.
const LONGEST_BANK: u64 = u32::MAX as u64;

/// The bytes that are read from a device, which is enough for `Bank::open` to reject it.
const START_BYTES: u64 = 1 << 12;

/// The storage of a file's bytes.
#[derive(Debug)]
enum Backing {
    /// The memory of this process, where the bytes cannot change.
    Memory,
    /// The file, mapped into the address space.
    Map,
}

/// The bytes of a file, usable as `&[u8]`.
pub struct FileBytes(Bytes);

enum Bytes {
    InMemory(Vec<u8>),
    Mapped(Mmap),
}

impl FileBytes {
    /// Reads the file at `path` into memory. Later changes to the file do not change the bytes.
    ///
    /// # Errors
    /// If the system cannot open or read the file; `IsADirectory` for a folder. If the file is longer than any bank, or a
    /// device, only the start is read, which is enough for `Bank::open` to reject it.
    pub fn read(path: impl AsRef<Path>) -> io::Result<FileBytes> {
        FileBytes::read_from(&File::open(path)?)
    }

    /// Maps the file at `path` into the address space. This takes microseconds for a file of any length. Only the pages
    /// that are accessed are read, and all programs that map the file share them.
    ///
    /// # Safety
    /// While these bytes exist, no process may change or truncate the file. To replace it, rename a new file over it,
    /// as `lipz pack` does. Otherwise the bytes change under a reader that has checked them, which is undefined
    /// behaviour, and access to truncated pages ends the program.
    ///
    /// # Errors
    /// If the system cannot open or map the file; `IsADirectory` for a folder.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn map(path: impl AsRef<Path>) -> io::Result<FileBytes> {
        let file = File::open(path)?;
        // SAFETY: the same contract.
        unsafe { FileBytes::map_from(&file) }
    }

    pub(crate) fn read_from(mut file: &File) -> io::Result<FileBytes> {
        let metadata = file.metadata()?;
        let expected_bytes = metadata.len().min(LONGEST_BANK + 1);
        let mut bytes = Vec::new();
        let is_reserved = bytes.try_reserve_exact(usize::try_from(expected_bytes).unwrap_or(usize::MAX));
        is_reserved.map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))?;
        // A device may have no end, unlike a pipe.
        let most = if is_device(&metadata) { START_BYTES } else { LONGEST_BANK + 1 };
        Read::by_ref(&mut file).take(most).read_to_end(&mut bytes)?;
        Ok(FileBytes(Bytes::InMemory(bytes)))
    }

    /// # Safety
    /// That of [`FileBytes::map`].
    #[allow(unsafe_code)] // the caller keeps the contract
    pub(crate) unsafe fn map_from(mut file: &File) -> io::Result<FileBytes> {
        // For a folder, the error of reading is clearer than that of mapping.
        let _ = file.read(&mut [0])?;
        // SAFETY: by the contract, the file is not changed or truncated while it is mapped.
        let map = unsafe { Mmap::map(file) }?;
        Ok(FileBytes(Bytes::Mapped(map)))
    }

    /// Advises the system that all of a mapped file will be read, in order.
    pub(crate) fn expect_all(&self) {
        #[cfg(unix)]
        self.advise(memmap2::Advice::Sequential);
    }

    /// Advises the system that pages of a mapped file will be accessed at random. Otherwise the system reads many pages
    /// around each one, and the first line of a cold bank takes twenty times as long.
    pub(crate) fn expect_queries(&self) {
        #[cfg(unix)]
        self.advise(memmap2::Advice::Random);
    }

    #[cfg(unix)]
    fn advise(&self, advice: memmap2::Advice) {
        if let Bytes::Mapped(map) = &self.0 {
            // Errors are ignored, because only the speed depends on the advice.
            let _ = map.advise(advice);
        }
    }
}

#[cfg(unix)]
fn is_device(metadata: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_char_device() || metadata.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_device(_metadata: &Metadata) -> bool {
    false
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

/// Bytes that the program generated or received, instead of reading a file.
impl From<Vec<u8>> for FileBytes {
    fn from(bytes: Vec<u8>) -> FileBytes {
        FileBytes(Bytes::InMemory(bytes))
    }
}

/// Prints the number of bytes, and their storage.
impl fmt::Debug for FileBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let backing = match &self.0 {
            Bytes::InMemory(_) => Backing::Memory,
            Bytes::Mapped(_) => Backing::Map,
        };
        f.debug_struct("FileBytes").field("length_bytes", &self.len()).field("backing", &backing).finish()
    }
}
