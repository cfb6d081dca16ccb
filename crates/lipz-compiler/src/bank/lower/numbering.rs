//! The numbers of the segments of all clips.

use std::ops::Range;

/// Clips in the order of their segments' numbers: those with events first, then the others, both sorted by key.
pub(crate) struct Numbering {
    /// Indexes of the clips.
    order: Vec<u32>,
    /// For each clip, the number of its first segment, and the number of its segments.
    segments: Vec<(usize, u32)>,
    /// The number of segments of all clips.
    pub(super) segment_count: usize,
}

impl Numbering {
    /// Numbers the segments of clips, which are sorted by key. Each item states whether the clip has events, and how
    /// many segments it has.
    pub(crate) fn new(clips: impl Iterator<Item = (bool, u32)>) -> Numbering {
        // Collect first: the values are far apart in memory, and each is used three times.
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

    /// Returns the indexes of the clips in this order.
    pub(super) fn order(&self) -> impl ExactSizeIterator<Item = usize> {
        self.order.iter().map(|&at| at as usize)
    }

    /// Returns the index of the clip at a position in the order.
    pub(super) fn clip(&self, place: usize) -> usize {
        self.order[place] as usize
    }

    /// Returns the numbers of the segments of the clip with this index.
    pub(crate) fn segments(&self, at: usize) -> Range<usize> {
        let (first, count) = self.segments[at];
        first..first + count as usize
    }
}
