//! One segment of a clip: frames, display texts and event string.

use crate::event::Events;
use crate::text::FoundText;
use crate::{Bank, Clip, Dialogue, Event, Locale, Text};
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;
use lipz_layout::{ClipRecord, EventRecord};

/// A stretch of a clip, between two `|` of its Lipz file.
#[derive(Clone, Copy)]
pub struct Segment<'a> {
    clip: Clip<'a>,
    index: u32,
}

impl<'a> Segment<'a> {
    #[inline]
    pub(crate) fn new(clip: Clip<'a>, index: u32) -> Self {
        Segment { clip, index }
    }

    /// The clip that this is a segment of.
    pub const fn clip(&self) -> &Clip<'a> {
        &self.clip
    }

    /// The place of the segment in its clip, from 0.
    pub const fn index(&self) -> u32 {
        self.index
    }

    /// The place of the clip's first segment among those of all clips.
    #[inline]
    fn first_number(&self) -> usize {
        self.clip.record.segments_first.get() as usize
    }

    /// The place of the segment among those of all clips.
    #[inline]
    fn number(&self) -> usize {
        self.first_number().wrapping_add(self.index as usize)
    }

    /// The first frame of the segment.
    pub fn start_frame(&self) -> u32 {
        self.frame_range().start.saturating_sub(self.clip.record.frames_offset_bytes.get())
    }

    /// The frame after the last one; equal to the start for a segment of no frames.
    pub fn end_frame(&self) -> u32 {
        self.frame_range().end.saturating_sub(self.clip.record.frames_offset_bytes.get())
    }

    /// The frames of the segment among those of all clips; none if damaged.
    fn frame_range(&self) -> Range<u32> {
        match self.clip.bank.starts.get(self.number()..) {
            Some([start, end, ..]) => start.get()..end.get(),
            _ => 0..0,
        }
    }

    /// The first microsecond of the segment, rounded up; `None` without a frame rate.
    pub fn start_us(&self) -> Option<u64> {
        Some(self.clip.stored_fps()?.start_of_frame_us(self.start_frame()))
    }

    /// The first microsecond after the segment, rounded up; `None` without a frame rate.
    pub fn end_us(&self) -> Option<u64> {
        Some(self.clip.stored_fps()?.start_of_frame_us(self.end_frame()))
    }

    /// The frame codes of the segment, one byte per frame.
    pub fn frames(&self) -> &'a [u8] {
        let Range { start, end } = self.frame_range();
        self.clip.bank.frames.get(start as usize..end as usize).unwrap_or(&[])
    }

    /// The display text in `locale`, or in the locale that it falls back to; `None` if neither has a text for this clip.
    ///
    /// A segment of an existing text may be empty. In a locale of another bank or dialogue there is no text.
    #[inline(always)] // otherwise the whole segment is copied for the call
    pub fn text(&self, locale: Locale) -> Option<Text<'a>> {
        match self.clip.home {
            None => self.own_text(locale)?.text(),
            Some(home) => {
                let Clip { bank, record, .. } = self.clip;
                home.text(bank, record, (self.index, self.clip.has_texts()), locale)
            }
        }
    }

    /// Like [`Segment::text`], as bytes that are not checked to be UTF-8: for programs that cannot
    /// afford the checker's code.
    #[inline(always)]
    pub fn text_bytes(&self, locale: Locale) -> Option<&'a [u8]> {
        match self.clip.home {
            None => self.own_text(locale)?.bytes(),
            Some(home) => self.text_in(home, locale)?.bytes(),
        }
    }

    /// Whether `locale` has a text of its own for this clip, which may be empty in this segment. Reads no byte of it.
    pub fn has_own_text(&self, locale: Locale) -> bool {
        let found = match self.clip.home {
            None => self.own_text(locale),
            Some(home) => self.text_in(home, locale),
        };
        found.map_or(false, |found| !found.place.is_fallback())
    }

    /// The text in `locale`, if that is one of the bank.
    #[inline(always)]
    fn own_text(&self, locale: Locale) -> Option<FoundText<'a>> {
        self.clip.bank.text_of(self.clip.record, self.index, locale)
    }

    /// The text in `locale`, wherever the dialogue has it.
    #[inline(always)] // otherwise the whole segment is copied for the call
    fn text_in(&self, home: &'a Dialogue<'a>, locale: Locale) -> Option<FoundText<'a>> {
        let Clip { bank, record, .. } = self.clip;
        home.find_text(bank, record, (self.index, self.clip.has_texts()), locale)
    }

    /// The event string, trimmed; empty if nothing happens at this segment, `None` if the file has
    /// no `events` element.
    pub fn event(&self) -> Option<&'a str> {
        let record = self.event_record()?;
        self.clip.bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get())
    }

    /// The events of the segment, if they are Character Event Syntax.
    ///
    /// The iterator is empty if nothing happens, and if the event string has a different syntax, such as
    /// a script: [`Segment::event`] returns it.
    ///
    /// ```
    /// use lipz_bank::{Bank, Command};
    ///
    /// # let bytes: &[u8] = include_bytes!("../examples/act1.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let segments = bank.clips().flat_map(|clip| clip.segments());
    /// let tears = segments.flat_map(|segment| segment.events()).filter(|event| match event.command {
    ///     Command::Feels(emotion) => emotion == "sad",
    ///     _ => false,
    /// });
    /// assert_eq!(tears.count(), 1);
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn events(&self) -> impl Iterator<Item = Event<'a>> + Clone {
        Events::new(self.clip.bank, self.event_record())
    }

    fn event_record(&self) -> Option<&'a EventRecord> {
        let bank = self.clip.bank;
        bank.events.get(bank.event_refs.get(self.number())?.get() as usize)
    }
}

/// Equal are segments of one clip with equal indices.
impl PartialEq for Segment<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.clip == other.clip && self.index == other.index
    }
}
impl Eq for Segment<'_> {}

/// The clip and the index, not the texts.
impl fmt::Debug for Segment<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Segment").field("clip", &self.clip).field("index", &self.index).finish()
    }
}

/// Starts that are compared at once: as many as fit a vector.
const NEAR_STARTS: usize = 4;

/// The last segment that starts at or before `frame`, one of the clip: the segment that contains it.
#[inline(always)]
pub(crate) fn index_of_frame(clip: &Clip<'_>, frame: u32) -> Option<u32> {
    let offset = clip.record.frames_offset_bytes.get().wrapping_add(frame);
    // Segment 0 starts at or before every frame.
    let second = (clip.record.segments_first.get() as usize).wrapping_add(1);
    if cfg!(target_pointer_width = "64") {
        if let Some(passed) = passed_of_near(clip.bank, second, offset) {
            return Some(passed);
        }
    }
    index_in_starts(clip.bank, clip.record, second, offset)
}

/// How many of the starts from this one on are at or before an offset, if that is not all that are compared at once.
///
/// Starts ascend from clip to clip, so those that are not the clip's own do no harm.
#[inline(always)]
fn passed_of_near(bank: &Bank<'_>, first: usize, offset: u32) -> Option<u32> {
    let near = bank.starts.get(first..first.wrapping_add(NEAR_STARTS))?;
    let passed = near.iter().map(|start| u32::from(start.get() <= offset)).fold(0, u32::wrapping_add);
    if passed < NEAR_STARTS as u32 { Some(passed) } else { None }
}

/// A segment behind the fifth one, or of one of the last clips: rare, so it is kept out of the way.
#[cold]
#[inline(never)]
fn index_in_starts(bank: &Bank<'_>, record: &ClipRecord, second: usize, offset: u32) -> Option<u32> {
    if cfg!(target_pointer_width = "64") {
        if let Some(passed) = passed_of_near(bank, second.wrapping_add(NEAR_STARTS), offset) {
            return Some(passed.wrapping_add(NEAR_STARTS as u32));
        }
    }
    let key = bank.keys.get(bank.slot_of(record) as usize)?;
    let count = usize::from(key.segment_count.get()).checked_sub(1)?;
    let starts = bank.starts.get(second..second.wrapping_add(count))?;
    Some(starts.partition_point(|start| start.get() <= offset) as u32)
}

/// The segments of a clip in order.
#[derive(Clone)]
pub(crate) struct Segments<'a> {
    clip: Clip<'a>,
    next: u32,
}

impl<'a> Segments<'a> {
    pub(crate) fn new(clip: Clip<'a>) -> Self {
        Segments { clip, next: 0 }
    }
}

impl<'a> Iterator for Segments<'a> {
    type Item = Segment<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        let segment = self.clip.segment(self.next)?;
        self.next = self.next.saturating_add(1);
        Some(segment)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.clip.segment_count().saturating_sub(self.next) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for Segments<'_> {}
impl FusedIterator for Segments<'_> {}
