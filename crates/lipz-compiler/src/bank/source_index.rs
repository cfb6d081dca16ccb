//! The positions of the source records in a bank.

use lipz_layout::U32;
use std::ops::Range;

/// The positions of the source records of a bank.
pub(crate) struct SourceIndex<'b> {
    /// The start of the record of each slot.
    index: &'b [U32],
    /// The end of the record of each slot.
    ends: Vec<u32>,
    /// The range of all records.
    records: Range<usize>,
}

impl<'b> SourceIndex<'b> {
    /// Creates the index. A record ends where the next one starts.
    pub(crate) fn new(index: &'b [U32], records: Range<usize>) -> SourceIndex<'b> {
        let mut starts: Vec<(u32, usize)> = std::iter::zip(index.iter().map(|start| start.get()), 0..).collect();
        starts.sort_unstable();
        let mut ends = vec![0; index.len()];
        let mut end = records.len() as u32;
        for equal in starts.chunk_by(|(a, _), (b, _)| a == b).rev() {
            equal.iter().for_each(|(_, slot)| ends[*slot] = end);
            end = equal[0].0;
        }
        SourceIndex { index, ends, records }
    }

    /// Returns the range of the record of the clip in this slot.
    pub(crate) fn record(&self, slot: u32) -> Option<Range<usize>> {
        let slot = slot as usize;
        let (start, end) = (self.index.get(slot)?.get() as usize, *self.ends.get(slot)? as usize);
        Some(self.records.start + start..self.records.start + end)
    }
}
