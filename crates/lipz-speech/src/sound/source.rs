//! A source of bytes as the decoders want it: it knows its length, and some bytes are read as others than they are.

use std::io::{Read, Result, Seek, SeekFrom};
use symphonia::core::io::MediaSource;

/// A source that knows its length.
pub(super) struct Source<S> {
    inner: S,
    pub(super) length: u64,
    position: u64,
    /// Four bytes each that are read instead of those which are there, by their places.
    pub(super) mended: Vec<(u64, [u8; 4])>,
}

impl<S: Read + Seek> Source<S> {
    pub(super) fn new(mut inner: S) -> Result<Source<S>> {
        let length = inner.seek(SeekFrom::End(0))?;
        inner.rewind()?;
        Ok(Source { inner, length, position: 0, mended: Vec::new() })
    }

    /// Up to so many bytes from a place on; the next are read from the start again.
    pub(super) fn peek(&mut self, at: u64, length: usize) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.inner.seek(SeekFrom::Start(at))?;
        self.inner.by_ref().take(length as u64).read_to_end(&mut bytes)?;
        self.rewind()?;
        Ok(bytes)
    }

    /// Does something with all bytes; the next are read from the start again.
    pub(super) fn rewound<T>(&mut self, run: impl FnOnce(&mut S) -> Result<T>) -> Result<T> {
        self.rewind()?;
        let result = run(&mut self.inner)?;
        self.rewind()?;
        Ok(result)
    }
}

impl<S: Read> Read for Source<S> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let count = self.inner.read(buffer)?;
        for (at, bytes) in &self.mended {
            for (place, byte) in (*at..).zip(bytes) {
                let within = place.checked_sub(self.position).and_then(|place| usize::try_from(place).ok());
                let read = within.filter(|place| *place < count).and_then(|place| buffer.get_mut(place));
                read.into_iter().for_each(|read| *read = *byte);
            }
        }
        self.position += count as u64;
        Ok(count)
    }
}

impl<S: Seek> Seek for Source<S> {
    fn seek(&mut self, position: SeekFrom) -> Result<u64> {
        self.position = self.inner.seek(position)?;
        Ok(self.position)
    }
}

impl<S: Read + Seek + Send + Sync> MediaSource for Source<S> {
    fn is_seekable(&self) -> bool {
        true
    }

    fn byte_len(&self) -> Option<u64> {
        Some(self.length)
    }
}
