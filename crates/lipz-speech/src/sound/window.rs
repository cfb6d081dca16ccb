//! Lookahead in a reader.

use std::io::{ErrorKind, Read, Result};

/// The number of bytes that are read at a time.
const BLOCK_BYTES: usize = 1 << 15;

/// The bytes of a reader, from the current position.
pub(super) struct Window<R> {
    reader: R,
    bytes: Vec<u8>,
    at: usize,
}

impl<R: Read> Window<R> {
    pub(super) fn new(reader: R) -> Window<R> {
        Window { reader, bytes: Vec::new(), at: 0 }
    }

    /// Returns `count` bytes, `from` bytes after the current position, or `None` if the file ends before.
    pub(super) fn peek(&mut self, from: usize, count: usize) -> Result<Option<&[u8]>> {
        let end = self.at + from + count;
        if end > self.bytes.len() && self.at > 0 {
            self.bytes.drain(..self.at);
            self.at = 0;
        }
        let (start, end) = (self.at + from, self.at + from + count);
        while self.bytes.len() < end {
            let had = self.bytes.len();
            self.bytes.resize(had + BLOCK_BYTES, 0);
            let read = loop {
                match self.reader.read(&mut self.bytes[had..]) {
                    Err(error) if error.kind() == ErrorKind::Interrupted => {}
                    read => break read,
                }
            };
            self.bytes.truncate(had + *read.as_ref().unwrap_or(&0));
            if read? == 0 {
                return Ok(None);
            }
        }
        Ok(self.bytes.get(start..end))
    }

    /// Advances by so many bytes.
    pub(super) fn skip(&mut self, mut count: usize) -> Result<()> {
        while count > 0 {
            let step = count.min(BLOCK_BYTES);
            if self.peek(0, step)?.is_none() {
                self.at = self.bytes.len();
                return Ok(());
            }
            self.at += step;
            count -= step;
        }
        Ok(())
    }
}
