//! The numbers of the segments of all clips.

use std::ops::Range;

/// Clips in the order in which their segments are numbered: those with events first, then the others, both in the
/// order of their keys.
pub(crate) struct Numbering {
    /// Indices of the clips.
    order: Vec<u32>,
    /// For each clip the number of its first segment, and how many it has.
    segments: Vec<(usize, u32)>,
    /// Segments of all clips.
    pub(super) segment_count: usize,
}

impl Numbering {
    /// Numbers the segments of clips in the order of their keys, given by whether they have events and by how many
    /// segments they have.
    pub(crate) fn new(clips: impl Iterator<Item = (bool, u32)>) -> Numbering {
        // They are far apart in memory, and each is asked for three times.
        let clips: Vec<(bool, u32)> = clips.collect();
        let of = |have_events: bool| {
            let places = (0..).zip(&clips).filter(move |(_, (has_events, _))| *has_events == have_events);
            places.map(|(at, _)| at)
        };
        let order: Vec<u32> = of(true).chain(of(false)).collect();
        let mut segments: Vec<(usize, u32)> = clips.iter().map(|(_, count)| (0, *count)).collect();
        let mut segment_count = 0;
        for &at in &order {
            let (first, count) = &mut segments[at as usize];
            *first = segment_count;
            segment_count += *count as usize;
        }
        Numbering { order, segments, segment_count }
    }

    /// The indices of the clips.
    pub(super) fn order(&self) -> impl ExactSizeIterator<Item = usize> {
        self.order.iter().map(|&at| at as usize)
    }

    /// The index of the clip at a place in the order.
    pub(super) fn clip(&self, place: usize) -> usize {
        self.order[place] as usize
    }

    /// The numbers of the segments of the clip with this index.
    pub(crate) fn segments(&self, at: usize) -> Range<usize> {
        let (first, count) = self.segments[at];
        first..first + count as usize
    }
}
