//! The interface of all rivals.

use crate::Failure;
use crate::corpus::Corpus;
use memmap2::Mmap;
use std::path::{Path, PathBuf};

/// A file on disk, mapped. It stays mapped until the program ends, so that readers can borrow it.
pub(crate) struct File {
    pub(crate) path: PathBuf,
    pub(crate) map: Mmap,
}

impl File {
    /// Maps the file at `path`.
    pub(crate) fn map(path: &Path) -> Result<&'static File, Failure> {
        let file = std::fs::File::open(path)?;
        // SAFETY: the file is in a temporary folder of this program, which does not change it.
        let map = unsafe { Mmap::map(&file)? };
        Ok(Box::leak(Box::new(File { path: path.to_owned(), map })))
    }
}

/// A way to keep clips in a file.
pub(crate) trait Rival: 'static {
    /// Its name in the table.
    const NAME: &'static str;
    /// The type that makes queries.
    type Reader: Reader;

    /// Writes the file.
    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure>;

    /// Opens a file that is known to be valid.
    fn open(file: &'static File) -> Result<Self::Reader, Failure>;

    /// Returns the bytes on the heap that this program's allocator does not count.
    fn foreign_heap_bytes() -> usize {
        0
    }

    /// Opens a file that may be damaged. After that, no use of the reader is undefined behaviour.
    fn open_validated(file: &'static File) -> Result<Self::Reader, Failure>;
}

/// Queries about the clips of a file.
///
/// Texts and events are `#[inline(always)]` where their code is short. Their code is then in the loop of the queries,
/// as in a game, even if two rivals share a reader, for which the compiler would otherwise make a function.
pub(crate) trait Reader: Sized {
    /// A clip, as a program stores it during playback.
    type Clip<'r>: Copy
    where
        Self: 'r;
    /// A locale, as a program stores it.
    type Locale<'r>: Copy
    where
        Self: 'r;

    /// Returns the locale with this tag.
    fn locale(&self, tag: &str) -> Option<Self::Locale<'_>>;

    /// Returns the number of the clip with this key, in the rival's own numbering.
    fn find(&self, key: &str) -> Option<u32>;

    /// Returns the clip with this number.
    fn clip(&self, number: u32) -> Option<Self::Clip<'_>>;

    /// Returns the viseme code at a time, or `-` from the end on.
    fn viseme(&self, clip: Self::Clip<'_>, time_us: u32) -> u8;

    /// Passes the text of the segment at a time, if there is one, to `then`.
    fn text<T>(
        &self,
        clip: Self::Clip<'_>,
        locale: Self::Locale<'_>,
        time_us: u32,
        then: impl FnOnce(&str) -> T,
    ) -> Option<T>;

    /// Passes the event string of the segment at a time to `then`; empty without events.
    fn event<T>(&self, clip: Self::Clip<'_>, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T>;
}
