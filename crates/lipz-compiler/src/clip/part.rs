//! The parts of a clip that take most of its memory: frames, texts, and its source record.

#[cfg(feature = "shards")]
use super::on_disk::PartOnDisk;
use std::borrow::Cow;
use std::ops::Range;

/// Frames, the texts in a locale, or the source record of a clip.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part<'c> {
    /// In memory.
    Here(&'c [u8]),
    /// In the file of an object.
    #[cfg(feature = "shards")]
    Stays(PartOnDisk<'c>),
}

impl<'c> Part<'c> {
    /// Returns the bytes. Reads them if they are in a file.
    pub(crate) fn bytes(self) -> Cow<'c, [u8]> {
        match self {
            Part::Here(bytes) => Cow::Borrowed(bytes),
            #[cfg(feature = "shards")]
            Part::Stays(part) => Cow::Owned(part.read()),
        }
    }

    /// Returns their position and file; `None` if they are in memory.
    pub(crate) fn place(self) -> Option<(*const (), Range<usize>)> {
        match self {
            Part::Here(_) => None,
            #[cfg(feature = "shards")]
            Part::Stays(part) => Some(part.place()),
        }
    }

    /// Returns their length in bytes.
    pub(crate) fn length(self) -> usize {
        match self {
            Part::Here(bytes) => bytes.len(),
            #[cfg(feature = "shards")]
            Part::Stays(part) => part.length(),
        }
    }
}

impl PartialEq for Part<'_> {
    fn eq(&self, other: &Part<'_>) -> bool {
        match (self, other) {
            (Part::Here(own), Part::Here(other)) => own == other,
            #[cfg(feature = "shards")]
            (Part::Stays(own), Part::Stays(other)) if own.place() == other.place() => true,
            #[cfg(feature = "shards")]
            _ => self.length() == other.length() && self.bytes() == other.bytes(),
        }
    }
}

impl Eq for Part<'_> {}
