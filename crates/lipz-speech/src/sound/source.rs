//! A source of bytes for decoders, with a known length and replacements for wrong bytes.

use std::io::{Read, Result, Seek, SeekFrom};
use symphonia::core::io::MediaSource;

/// A source with a known length.
pub(super) struct SizedSource<S> {
    inner: S,
    pub(super) length: u64,
    position: u64,
    /// Replacements of four bytes each, with their offsets.
    pub(super) mended: Vec<(u64, [u8; 4])>,
}

impl<S: Read + Seek> SizedSource<S> {
    pub(super) fn new(mut inner: S) -> Result<SizedSource<S>> {
        let length = inner.seek(SeekFrom::End(0))?;
        inner.rewind()?;
        Ok(SizedSource { inner, length, position: 0, mended: Vec::new() })
    }

    /// Returns up to so many bytes from an offset. Reading then continues from the start.
    pub(super) fn peek(&mut self, at: u64, length: usize) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.inner.seek(SeekFrom::Start(at))?;
        self.inner.by_ref().take(length as u64).read_to_end(&mut bytes)?;
        self.rewind()?;
        Ok(bytes)
    }

    /// Calls `run` with the whole source. Reading then continues from the start.
    pub(super) fn rewound<T>(&mut self, run: impl FnOnce(&mut S) -> Result<T>) -> Result<T> {
        self.rewind()?;
        let result = run(&mut self.inner)?;
        self.rewind()?;
        Ok(result)
    }
}

impl<S: Read> Read for SizedSource<S> {
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

impl<S: Seek> Seek for SizedSource<S> {
    fn seek(&mut self, position: SeekFrom) -> Result<u64> {
        self.position = self.inner.seek(position)?;
        Ok(self.position)
    }
}

impl<S: Read + Seek + Send + Sync> MediaSource for SizedSource<S> {
    fn is_seekable(&self) -> bool {
        true
    }

    fn byte_len(&self) -> Option<u64> {
        Some(self.length)
    }
}
