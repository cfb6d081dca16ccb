//! The numbers of the segments of all clips.

use crate::clip::Clip;
use std::ops::Range;

/// Clips in the order in which their segments are numbered: those with events first, then the others, both in the
/// order of their keys.
pub(super) struct Numbering {
    /// Indices of the clips.
    pub(super) order: Vec<usize>,
    /// For each clip the number of its first segment.
    firsts: Vec<usize>,
    /// Segments of all clips.
    pub(super) segment_count: usize,
}

impl Numbering {
    pub(super) fn new(clips: &[Clip<'_>]) -> Numbering {
        let (with_events, others): (Vec<_>, Vec<_>) = (0..clips.len()).partition(|&at| clips[at].events().is_some());
        let order = [with_events, others].concat();
        let (mut firsts, mut segment_count) = (vec![0; clips.len()], 0);
        for &at in &order {
            firsts[at] = segment_count;
            segment_count += clips[at].starts().len();
        }
        Numbering { order, firsts, segment_count }
    }

    /// The numbers of the segments of the clip with this index.
    pub(super) fn segments(&self, clips: &[Clip<'_>], at: usize) -> Range<usize> {
        let first = self.firsts[at];
        first..first + clips[at].starts().len()
    }
}
