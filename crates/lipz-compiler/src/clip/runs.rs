//! The display texts of a clip: a run for each locale.

use crate::hashed::hash;
use lipz_layout::U16;
use std::ops::Range;
use zerocopy::{FromBytes, IntoBytes};

/// Runs one behind the other. Each is the texts of all segments, then where each of them ends, modulo 2¹⁶.
#[derive(Debug, Default)]
pub(crate) struct Runs {
    bytes: Vec<u8>,
    /// Where the run that is being made starts.
    start: usize,
    /// Where its texts end.
    ends: Vec<U16>,
}

impl Runs {
    /// Adds the text of the next segment to the run that is being made.
    pub(crate) fn push(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text);
        self.ends.push(U16::new((self.bytes.len() - self.start) as u16));
    }

    /// Bytes of the texts of the run that is being made.
    pub(crate) fn text_bytes(&self) -> usize {
        self.bytes.len() - self.start
    }

    /// Ends the run that is being made; where it lies, and the hash of its texts.
    pub(super) fn end(&mut self) -> (Range<usize>, u64) {
        let hash = hash(&self.bytes[self.start..]);
        self.bytes.extend_from_slice(self.ends.as_bytes());
        self.ends.clear();
        let place = self.start..self.bytes.len();
        self.start = place.end;
        (place, hash)
    }

    /// The run that lies there.
    pub(super) fn get(&self, place: Range<usize>) -> &[u8] {
        self.bytes.get(place).unwrap_or_default()
    }

    /// Bytes of all runs.
    pub(crate) fn byte_count(&self) -> usize {
        self.bytes.len()
    }

    /// Removes all runs and keeps the room.
    pub(super) fn clear(&mut self) {
        self.bytes.clear();
        self.start = 0;
        self.ends.clear();
    }
}

/// The texts of a run, of which there are so many, and where each of them ends.
pub(crate) fn split_run(run: &[u8], count: usize) -> (&[u8], &[U16]) {
    <[U16]>::ref_from_suffix_with_elems(run, count).unwrap_or_default()
}
