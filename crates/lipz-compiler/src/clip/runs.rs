//! The display texts of a clip: a run for each locale.

use crate::util::hash::hash;
use lipz_layout::U16;
use std::ops::Range;
use zerocopy::{FromBytes, IntoBytes};

/// Runs, one after the other. Each consists of the texts of all segments, then the end of each of them, modulo 2¹⁶.
#[derive(Debug, Default)]
pub(crate) struct Runs {
    bytes: Vec<u8>,
    /// The start of the unfinished run.
    start: usize,
    /// The ends of its texts.
    ends: Vec<U16>,
}

impl Runs {
    /// Adds the text of the next segment to the unfinished run.
    pub(crate) fn push(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text);
        self.ends.push(U16::new((self.bytes.len() - self.start) as u16));
    }

    /// Returns the length of the texts of the unfinished run in bytes.
    pub(crate) fn text_bytes(&self) -> usize {
        self.bytes.len() - self.start
    }

    /// Ends the unfinished run. Returns its range, and the hash of its texts.
    pub(super) fn end(&mut self) -> (Range<usize>, u64) {
        let hash = hash(&self.bytes[self.start..]);
        self.bytes.extend_from_slice(self.ends.as_bytes());
        self.ends.clear();
        let place = self.start..self.bytes.len();
        self.start = place.end;
        (place, hash)
    }

    /// Returns the run in this range.
    pub(super) fn get(&self, place: Range<usize>) -> &[u8] {
        self.bytes.get(place).unwrap_or_default()
    }

    /// Returns the length of all runs in bytes.
    pub(crate) fn byte_count(&self) -> usize {
        self.bytes.len()
    }

    /// Removes all runs and keeps the allocation.
    pub(super) fn clear(&mut self) {
        self.bytes.clear();
        self.start = 0;
        self.ends.clear();
    }
}

/// Splits a run into its texts, of which there are `count`, and their ends.
pub(crate) fn split_run(run: &[u8], count: usize) -> (&[u8], &[U16]) {
    <[U16]>::ref_from_suffix_with_elems(run, count).unwrap_or_default()
}
