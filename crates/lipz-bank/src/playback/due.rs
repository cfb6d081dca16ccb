//! The segments that have become due.

use super::Cursor;
use crate::{Clip, Event, EventName, Segment};
use core::iter::FusedIterator;

/// Segments whose events are due, in order.
///
/// [`Segment::event`] is the event string of one, in whatever syntax. [`DueSegments::events`] gives the events of
/// all, if they are Character Event Syntax.
#[derive(Clone, Debug)]
pub struct DueSegments<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    speaker: Option<EventName<'data>>,
    next: u32,
    end: u32,
    /// After `end`, it goes on from segment 0 up to this one.
    around_to: u32,
}

impl<'data, 'bank> DueSegments<'data, 'bank> {
    /// The segments from `first` up to and without `end`, as far as the clip has them: the numbers may be those of
    /// another clip.
    pub(super) fn new(cursor: &Cursor, clip: &Clip<'data, 'bank>, first: u32, end: u32) -> Self {
        let speaker = cursor.speaker().and_then(|key| clip.bank.event_names().named(key));
        DueSegments { clip: *clip, speaker, next: first, end: end.min(clip.segment_count()), around_to: 0 }
    }

    /// The segments from `first` to the last, then those from 0 up to and without `end`.
    pub(super) fn around(cursor: &Cursor, clip: &Clip<'data, 'bank>, first: u32, end: u32) -> Self {
        let mut due = DueSegments::new(cursor, clip, first, u32::MAX);
        due.around_to = end.min(due.end);
        due
    }

    /// The events of the segments. Those without a character are the
    /// [speaker](Cursor::with_speaker)'s.
    pub fn events(self) -> impl Iterator<Item = Event<'data>> + 'bank {
        let speaker = self.speaker;
        self.flat_map(move |segment| events(&segment, speaker))
    }

    /// Whose events name no character.
    pub(super) fn speaker(&self) -> Option<EventName<'data>> {
        self.speaker
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
