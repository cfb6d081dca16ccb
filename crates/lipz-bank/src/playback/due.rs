//! The segments that have become due.

use super::Cursor;
use crate::event::NameKey;
use crate::{Clip, Event, EventName, Segment};
use core::iter::FusedIterator;
use core::ops::Range;

/// Segments whose events are due, in order.
///
/// [`Segment::event`] is the event string of one, in whatever syntax. [`DueSegments::events`] gives the events of
/// all, if they are Character Event Syntax.
#[derive(Clone, Debug)]
pub struct DueSegments<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    /// A name of the clip's bank.
    speaker: Option<NameKey>,
    next: u32,
    end: u32,
    /// After `end`, it goes on from segment 0 up to this one.
    around_to: u32,
}

impl<'data, 'bank> DueSegments<'data, 'bank> {
    /// The segments of `range`, then those from 0 up to and without `around_to`, as far as the clip has them: the
    /// numbers may be those of another clip.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // a clip is many words, and several calls need this
    #[cfg_attr(target_pointer_width = "64", inline)]
    pub(super) fn new(cursor: &Cursor, clip: &Clip<'data, 'bank>, range: Range<u32>, around_to: u32) -> Self {
        let speaker = cursor.speaker().filter(|key| key.is_of(clip.bank));
        let count = clip.segment_count();
        let (next, end) = (range.start, range.end.min(count));
        DueSegments { clip: *clip, speaker, next, end, around_to: around_to.min(count) }
    }

    /// The events of the segments. Those without a character are the
    /// [speaker](Cursor::with_speaker)'s.
    #[inline]
    pub fn events(self) -> impl Iterator<Item = Event<'data>> + 'bank {
        let speaker = self.speaker_name();
        self.flat_map(move |segment| events(&segment, speaker))
    }

    /// Whose events name no character.
    pub(super) fn speaker(&self) -> Option<NameKey> {
        self.speaker
    }

    /// The name of the speaker.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // once per call of the cursor
    #[cfg_attr(target_pointer_width = "64", inline)]
    pub(super) fn speaker_name(&self) -> Option<EventName<'data>> {
        self.clip.bank.event_names().named(self.speaker?)
    }
}

/// The events of one segment; those without a character are the speaker's.
pub(super) fn events<'data>(
    segment: &Segment<'data, '_>,
    speaker: Option<EventName<'data>>,
) -> impl Iterator<Item = Event<'data>> {
    segment.events().map(move |event| Event { character: event.character.or(speaker), ..event })
}

impl<'data, 'bank> Iterator for DueSegments<'data, 'bank> {
    type Item = Segment<'data, 'bank>;

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

impl ExactSizeIterator for DueSegments<'_, '_> {}
impl FusedIterator for DueSegments<'_, '_> {}
