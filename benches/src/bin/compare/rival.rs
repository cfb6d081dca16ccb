//! What every rival can do.

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
    /// What answers questions.
    type Reader: Reader;

    /// Writes the file.
    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure>;

    /// Opens a file that is known to be good.
    fn open(file: &'static File) -> Result<Self::Reader, Failure>;

    /// Bytes on the heap that the allocator of this program does not see.
    fn foreign_heap_bytes() -> usize {
        0
    }

    /// Opens a file that may be damaged: afterwards nothing that the reader does is undefined.
    fn open_validated(file: &'static File) -> Result<Self::Reader, Failure>;
}

/// What answers questions about the clips of a file.
///
/// Texts and events are `#[inline(always)]` where their code is short: it then stands in the loop that asks, as in a
/// game, also where two rivals have one reader, so that the compiler would make a function of it.
pub(crate) trait Reader: Sized {
    /// A clip, as a program holds it while it plays.
    type Clip<'r>: Copy
    where
        Self: 'r;
    /// A locale, as a program holds it.
    type Locale<'r>: Copy
    where
        Self: 'r;

    /// The locale with this tag.
    fn locale(&self, tag: &str) -> Option<Self::Locale<'_>>;

    /// The number of the clip with this key: any numbers do.
    fn find(&self, key: &str) -> Option<u32>;

    /// The clip with this number.
    fn clip(&self, number: u32) -> Option<Self::Clip<'_>>;

    /// The frame code at a time; `-` from the end on.
    fn viseme(&self, clip: Self::Clip<'_>, time_us: u32) -> u8;

    /// Gives the text of the segment at a time, if there is one, to `then`.
    fn text<T>(
        &self,
        clip: Self::Clip<'_>,
        locale: Self::Locale<'_>,
        time_us: u32,
        then: impl FnOnce(&str) -> T,
    ) -> Option<T>;

    /// Gives the event string of the segment at a time to `then`: empty if nothing happens there.
    fn event<T>(&self, clip: Self::Clip<'_>, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T>;
}
