//! The segments that have become due.

use super::Cursor;
use crate::event::NameKey;
use crate::{Clip, Event, EventName, Segment};
use core::iter::FusedIterator;
use core::ops::Range;

/// Segments whose events are due, in order.
///
/// [`Segment::event`] returns the event string of one segment, in any syntax. [`DueSegments::events`] returns the
/// events of all segments, if they are Character Event Syntax.
#[derive(Clone, Debug)]
pub struct DueSegments<'a> {
    clip: Clip<'a>,
    /// The speaker, if the program has set one.
    speaker: Option<NameKey>,
    next: u32,
    end: u32,
    /// After `end`, the iterator continues from segment 0 up to, but not including, this one.
    around_to: u32,
}

impl<'a> DueSegments<'a> {
    /// Returns the segments of `range`, then those from 0 up to, but not including, `around_to`. Numbers outside the
    /// clip are skipped: they may be those of another clip.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // a clip is many words, and several calls need this
    #[cfg_attr(target_pointer_width = "64", inline)]
    pub(super) fn new(cursor: &Cursor, clip: &Clip<'a>, range: Range<u32>, around_to: u32) -> Self {
        let count = clip.segment_count();
        let (next, end) = (range.start, range.end.min(count));
        DueSegments { clip: *clip, speaker: cursor.speaker(), next, end, around_to: around_to.min(count) }
    }

    /// Returns the events of the segments. Those without a character are the [speaker](Cursor::with_speaker)'s.
    #[inline]
    pub fn events(self) -> impl Iterator<Item = Event<'a>> + 'a {
        let speaker = self.speaker_name();
        self.flat_map(move |segment| events(&segment, speaker))
    }

    /// Returns the name of the speaker.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // called once per call of the cursor
    #[cfg_attr(target_pointer_width = "64", inline)]
    pub(super) fn speaker_name(&self) -> Option<EventName<'a>> {
        // Usually no segment is due, and then the name is not needed.
        if self.next >= self.end && self.around_to == 0 {
            return None;
        }
        self.clip.name(self.speaker?)
    }
}

/// Returns the events of one segment; those without a character are the speaker's.
pub(super) fn events<'a>(segment: &Segment<'a>, speaker: Option<EventName<'a>>) -> impl Iterator<Item = Event<'a>> {
    segment.events().map(move |event| Event { character: event.character.or(speaker), ..event })
}

impl<'a> Iterator for DueSegments<'a> {
    type Item = Segment<'a>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        if self.next >= self.end {
            self.next = 0;
            self.end = core::mem::take(&mut self.around_to);
        }
        if self.next >= self.end {
            return None;
        }
        let segment = self.clip.segment(self.next)?;
        self.next = self.next.saturating_add(1);
        Some(segment)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.end.saturating_sub(self.next).saturating_add(self.around_to) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for DueSegments<'_> {}
impl FusedIterator for DueSegments<'_> {}
