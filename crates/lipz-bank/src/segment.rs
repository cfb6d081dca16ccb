//! One segment of a clip: frames, display texts and event string.

use crate::event::Events;
use crate::text::FoundText;
use crate::{Bank, Clip, Dialogue, Event, Locale, Text};
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;
use lipz_layout::{ClipRecord, EventRecord};

/// A part of a clip, between two `|` of its Lipz file.
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

    /// Returns the clip of the segment.
    pub const fn clip(&self) -> &Clip<'a> {
        &self.clip
    }

    /// Returns the index of the segment in its clip, from 0.
    pub const fn index(&self) -> u32 {
        self.index
    }

    /// Returns the index of the clip's first segment among those of all clips.
    #[inline]
    fn first_number(&self) -> usize {
        self.clip.record.segments_first.get() as usize
    }

    /// Returns the index of the segment among those of all clips.
    #[inline]
    fn number(&self) -> usize {
        self.first_number().wrapping_add(self.index as usize)
    }

    /// Returns the first frame of the segment.
    pub fn start_frame(&self) -> u32 {
        self.frame_range().start.saturating_sub(self.clip.record.frames_offset_bytes.get())
    }

    /// Returns the frame after the last one, which is the start frame if the segment is empty.
    pub fn end_frame(&self) -> u32 {
        self.frame_range().end.saturating_sub(self.clip.record.frames_offset_bytes.get())
    }

    /// Returns the frames of the segment among those of all clips; empty if damaged.
    fn frame_range(&self) -> Range<u32> {
        match self.clip.bank.starts.get(self.number()..) {
            Some([start, end, ..]) => start.get()..end.get(),
            _ => 0..0,
        }
    }

    /// Returns the first microsecond of the segment, rounded up; `None` without a frame rate.
    pub fn start_us(&self) -> Option<u64> {
        Some(self.clip.stored_fps()?.start_of_frame_us(self.start_frame()))
    }

    /// Returns the first microsecond after the segment, rounded up; `None` without a frame rate.
    pub fn end_us(&self) -> Option<u64> {
        Some(self.clip.stored_fps()?.start_of_frame_us(self.end_frame()))
    }

    /// Returns the frame codes of the segment, one byte per frame.
    pub fn frames(&self) -> &'a [u8] {
        let Range { start, end } = self.frame_range();
        self.clip.bank.frames.get(start as usize..end as usize).unwrap_or(&[])
    }

    /// Returns the display text in `locale`, or in its fallback locale; `None` if neither has a text for this clip.
    ///
    /// A segment of an existing text may be empty. A locale of another bank or dialogue leads to no text.
    #[inline(always)] // otherwise the call copies the whole segment
    pub fn text(&self, locale: Locale) -> Option<Text<'a>> {
        match self.clip.home {
            None => self.own_text(locale)?.text(),
            Some(home) => {
                let Clip { bank, record, .. } = self.clip;
                home.text(bank, record, (self.index, self.clip.has_texts()), locale)
            }
        }
    }

    /// Like [`Segment::text`], as bytes without a UTF-8 check, for programs that cannot afford the code of the check.
    #[inline(always)]
    pub fn text_bytes(&self, locale: Locale) -> Option<&'a [u8]> {
        match self.clip.home {
            None => self.own_text(locale)?.bytes(),
            Some(home) => self.text_in(home, locale)?.bytes(),
        }
    }

    /// Whether `locale` has its own text for this clip, which may be empty in this segment. Does not read the text.
    pub fn has_own_text(&self, locale: Locale) -> bool {
        let found = match self.clip.home {
            None => self.own_text(locale),
            Some(home) => self.text_in(home, locale),
        };
        found.map_or(false, |found| !found.place.is_fallback())
    }

    /// Returns the text in `locale`, if that belongs to the bank.
    #[inline(always)]
    fn own_text(&self, locale: Locale) -> Option<FoundText<'a>> {
        self.clip.bank.text_of(self.clip.record, self.index, locale)
    }

    /// Returns the text in `locale` from any file of the dialogue.
    #[inline(always)] // otherwise the call copies the whole segment
    fn text_in(&self, home: &'a Dialogue<'a>, locale: Locale) -> Option<FoundText<'a>> {
        let Clip { bank, record, .. } = self.clip;
        home.find_text(bank, record, (self.index, self.clip.has_texts()), locale)
    }

    /// Returns the trimmed event string, which is empty if there are no events in this segment; `None` if the file has
    /// no `events` element.
    pub fn event(&self) -> Option<&'a str> {
        let record = self.event_record()?;
        self.clip.bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get())
    }

    /// Returns the events of the segment, if they are Character Event Syntax.
    ///
    /// The iterator is empty if there are no events, or if the event string has a different syntax, such as a script.
    /// [`Segment::event`] returns the string.
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

/// Two segments are equal if they have the same clip and index.
impl PartialEq for Segment<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.clip == other.clip && self.index == other.index
    }
}
impl Eq for Segment<'_> {}

/// Prints the clip and the index, not the texts.
impl fmt::Debug for Segment<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Segment").field("clip", &self.clip).field("index", &self.index).finish()
    }
}

/// The number of starts that are compared at once, which fit a vector.
const NEAR_STARTS: usize = 4;

/// Returns the index of the segment that contains `frame`: the last one that starts at or before it. The frame must be
/// in the clip.
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

/// Returns how many of the starts from `first` on are at or before `offset`, unless all that are compared at once are.
///
/// Starts ascend from clip to clip, so those after the clip's own do no harm.
#[inline(always)]
fn passed_of_near(bank: &Bank<'_>, first: usize, offset: u32) -> Option<u32> {
    let near = bank.starts.get(first..first.wrapping_add(NEAR_STARTS))?;
    let passed = near.iter().map(|start| u32::from(start.get() <= offset)).fold(0, u32::wrapping_add);
    if passed < NEAR_STARTS as u32 { Some(passed) } else { None }
}

/// Finds a segment after the fifth one, or of one of the last clips. Both are rare, so the code is kept out of line.
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
