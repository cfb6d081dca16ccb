//! The segments that playback has crossed.

use super::Playback;
use crate::{Clip, Event, EventName, Segment};
use core::iter::FusedIterator;

/// Segments whose events are due, in order.
///
/// [`Segment::event`] is the event string of one, in whatever syntax. [`Crossed::events`] gives the events of all, if
/// they are Character Event Syntax.
#[derive(Clone, Debug)]
pub struct Crossed<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    speaker: Option<EventName<'data>>,
    next: u32,
    end: u32,
    /// After `end`, it goes on from segment 0 up to this one.
    around_to: u32,
}

impl<'data, 'bank> Crossed<'data, 'bank> {
    /// The segments from `first` up to and without `end`.
    pub(super) fn new(playback: &Playback<'data, 'bank>, first: u32, end: u32) -> Self {
        Crossed { clip: playback.clip, speaker: playback.speaker, next: first, end, around_to: 0 }
    }

    /// The segments from `first` to the last, then those from 0 up to and without `end`.
    pub(super) fn around(playback: &Playback<'data, 'bank>, first: u32, end: u32) -> Self {
        Crossed { around_to: end, ..Crossed::new(playback, first, playback.clip.segment_count()) }
    }

    /// The events of the segments. Those without a character are the
    /// [speaker](Playback::with_speaker)'s.
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

impl<'data, 'bank> Iterator for Crossed<'data, 'bank> {
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

impl ExactSizeIterator for Crossed<'_, '_> {}
impl FusedIterator for Crossed<'_, '_> {}
