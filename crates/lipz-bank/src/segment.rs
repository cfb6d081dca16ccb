//! One segment of a clip: frames, display texts and event string.

use crate::layout::{ClipRecord, EventRecord, FLAG_FAR_STARTS, INLINE_STARTS, NARROW_END_BYTES, NO_EVENTS, NO_TEXT};
use crate::layout::{TEXT_FALLBACK, TEXT_OFFSET, TEXT_WIDE, WIDE_END_BYTES};
use crate::{Bank, Clip, Events, Locale};
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Deref;

/// A stretch of a clip, between two `|` of its Lipz file.
#[derive(Clone, Copy)]
pub struct Segment<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    index: u32,
}

impl<'data, 'bank> Segment<'data, 'bank> {
    #[inline]
    pub(crate) fn new(clip: Clip<'data, 'bank>, index: u32) -> Self {
        Segment { clip, index }
    }

    /// The clip that this is a segment of.
    pub const fn clip(&self) -> &Clip<'data, 'bank> {
        &self.clip
    }

    /// The place of the segment in its clip, from 0.
    pub const fn index(&self) -> u32 {
        self.index
    }

    /// The first frame of the segment.
    pub fn start_frame(&self) -> u32 {
        start_frame(self.clip.bank, self.clip.record, self.index).unwrap_or(0)
    }

    /// The frame after the last one; equal to the start for a segment of no frames.
    pub fn end_frame(&self) -> u32 {
        let next = self.index.saturating_add(1);
        if next < self.clip.segment_count() {
            start_frame(self.clip.bank, self.clip.record, next).unwrap_or(0)
        } else {
            self.clip.frame_count()
        }
    }

    /// The first microsecond of the segment, rounded up; `None` without a frame rate.
    pub fn start_us(&self) -> Option<u64> {
        Some(self.clip.fps()?.start_of_frame_us(self.start_frame()))
    }

    /// The first microsecond after the segment, rounded up; `None` without a frame rate.
    pub fn end_us(&self) -> Option<u64> {
        Some(self.clip.fps()?.start_of_frame_us(self.end_frame()))
    }

    /// The frame codes of the segment, one byte per frame.
    pub fn frames(&self) -> &'data [u8] {
        self.clip.frames_between(self.start_frame(), self.end_frame()).unwrap_or(&[])
    }

    /// The display text in `locale`, or in the locale that it falls back to; `None` if neither has
    /// a text for this clip.
    ///
    /// A segment of an existing text may be empty. `locale` comes from the same
    /// bank, or from a [`TextBank`](crate::TextBank) that it opened.
    #[inline(always)] // otherwise the whole segment is copied for the call
    pub fn text<'texts>(&self, locale: Locale<'texts>) -> Option<Text<'texts>> {
        let (start, end, is_fallback) = self.text_range(locale)?;
        Some(Text { text: locale.texts.text(start, end)?, is_fallback })
    }

    /// Like [`Segment::text`], as bytes that are not checked to be UTF-8: for programs that cannot
    /// afford the checker's code.
    #[inline]
    pub fn text_bytes<'texts>(&self, locale: Locale<'texts>) -> Option<&'texts [u8]> {
        let (start, end, _) = self.text_range(locale)?;
        locale.texts.slice(start, end)
    }

    /// Where the text stands in the text pool, and whether it is that of another locale.
    #[inline(always)]
    fn text_range(&self, locale: Locale<'_>) -> Option<(usize, usize, bool)> {
        let entry = locale.index.get(self.clip.slot() as usize)?.get();
        if entry == NO_TEXT {
            return None;
        }
        let offset = (entry & TEXT_OFFSET) as usize;
        let run = locale.texts.bytes().get(offset..)?;
        let wide = entry & TEXT_WIDE != 0;
        // Read in any case: a branch on whether it is the first text would often be mispredicted.
        let before = text_end(run, self.index.saturating_sub(1), wide)?;
        let start = if self.index == 0 { 0 } else { before };
        let end = text_end(run, self.index, wide)?;
        let width = if wide { WIDE_END_BYTES } else { NARROW_END_BYTES };
        // What wraps around in a damaged bank leads to another place of the pool, or to none.
        let texts = offset.wrapping_add((self.clip.segment_count() as usize).wrapping_mul(width));
        Some((texts.wrapping_add(start), texts.wrapping_add(end), entry & TEXT_FALLBACK != 0))
    }

    /// The event string, trimmed; empty if nothing happens at this segment, `None` if the file has
    /// no `events` element.
    pub fn event(&self) -> Option<&'data str> {
        let record = self.event_record()?;
        self.clip.bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get())
    }

    /// The events of the segment, if they are Character Event Syntax.
    ///
    /// There are none where nothing happens, and where the event string is some other syntax, such as
    /// a script: [`Segment::event`] has it.
    ///
    /// ```
    /// use lipz_bank::{Bank, Command};
    ///
    /// # let bytes: &[u8] = include_bytes!("../../../fixtures/banks/v1/drama.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let sad = bank.event_name("sad"); // names are looked up once, and compared as numbers
    /// let segments = bank.clips().flat_map(|clip| clip.segments());
    /// let tears = segments.flat_map(|segment| segment.events()).filter(|event| match event.command {
    ///     Command::Feels(emotion) => Some(emotion) == sad,
    ///     _ => false,
    /// });
    /// assert_eq!(tears.count(), 6);
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn events(&self) -> Events<'data> {
        Events::new(self.clip.bank, self.event_record())
    }

    fn event_record(&self) -> Option<&'data EventRecord> {
        let first = self.clip.record.events_first.get();
        if first == NO_EVENTS {
            return None;
        }
        let bank = self.clip.bank;
        let at = (first as usize).checked_add(self.index as usize)?;
        bank.events.get(bank.event_refs.get(at)?.get() as usize)
    }
}

/// The clip and the index, not the texts.
impl fmt::Debug for Segment<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Segment").field("clip", &self.clip).field("index", &self.index).finish()
    }
}

/// A display text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Text<'data> {
    text: &'data str,
    is_fallback: bool,
}

impl<'data> Text<'data> {
    /// The text as a player sees it: trimmed, without `{meta}`.
    pub const fn as_str(self) -> &'data str {
        self.text
    }

    /// Whether the locale asked for has no text for this clip, and this is that of another one.
    pub const fn is_fallback(self) -> bool {
        self.is_fallback
    }
}

impl Deref for Text<'_> {
    type Target = str;

    fn deref(&self) -> &str {
        self.text
    }
}

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.text)
    }
}

/// The end of text `index` in a run, in bytes from the end of the table of ends: 7 bits a byte, so
/// that the table is ASCII and the whole text pool one UTF-8 string.
#[inline(always)]
fn text_end(run: &[u8], index: u32, wide: bool) -> Option<usize> {
    if wide {
        return wide_text_end(run, index);
    }
    match run.get((index as usize).checked_mul(NARROW_END_BYTES)?..)? {
        [low, high, ..] => Some(usize::from(*low) | usize::from(*high) << 7),
        _ => None,
    }
}

/// As above, for texts of more than 16 KB: rare, so it is kept out of the way.
#[cold]
fn wide_text_end(run: &[u8], index: u32) -> Option<usize> {
    match run.get((index as usize).checked_mul(WIDE_END_BYTES)?..)? {
        [a, b, c, d, ..] => {
            Some(usize::from(*a) | usize::from(*b) << 7 | usize::from(*c) << 14 | usize::from(*d) << 21)
        }
        _ => None,
    }
}

/// The number of segments, no more than there are starts for.
#[inline]
pub(crate) fn segment_count(bank: &Bank<'_>, record: &ClipRecord) -> u32 {
    let starts = match far_starts(record) {
        None => INLINE_STARTS,
        Some(_) => bank.starts.len(),
    };
    record.segment_count.get().min((starts as u32).saturating_add(1))
}

/// The first frame of segment `index`; `None` if damaged.
pub(crate) fn start_frame(bank: &Bank<'_>, record: &ClipRecord, index: u32) -> Option<u32> {
    match (index.checked_sub(1), far_starts(record)) {
        (None, _) => Some(0),
        (Some(before), None) => Some(u32::from(record.starts.get(before as usize)?.get())),
        (Some(before), Some(first)) => Some(bank.starts.get(first.checked_add(before as usize)?)?.get()),
    }
}

/// Index in `STRT` of the start of segment 1, if the starts do not stand in the record.
#[inline]
pub(crate) fn far_starts(record: &ClipRecord) -> Option<usize> {
    if record.flags & FLAG_FAR_STARTS == 0 {
        return None;
    }
    let [low, high, ..] = &record.starts;
    Some(usize::from(low.get()) | (usize::from(high.get()) << 16))
}

/// The last segment that starts at or before `frame`: the one that contains it.
#[inline(always)]
pub(crate) fn index_of_frame(clip: &Clip<'_, '_>, frame: u32) -> Option<u32> {
    match far_starts(clip.record) {
        // Unused starts are 0xFFFF, after every frame: all eight are compared at once, as vector code.
        None => {
            let frame = u16::try_from(frame).ok()?;
            let starts = clip.record.starts.iter();
            Some(u32::from(starts.map(|start| u16::from(start.get() <= frame)).fold(0, u16::wrapping_add)))
        }
        Some(first) => index_in_far_starts(clip, first, frame),
    }
}

/// A clip of more than nine segments, or of an hour: rare, so it is kept out of the way.
#[cold]
fn index_in_far_starts(clip: &Clip<'_, '_>, first: usize, frame: u32) -> Option<u32> {
    let end = first.checked_add((clip.segment_count() as usize).checked_sub(1)?)?;
    let starts = clip.bank.starts.get(first..end)?;
    Some(starts.partition_point(|start| start.get() <= frame) as u32)
}

/// The segments of a clip in order.
#[derive(Clone, Debug)]
pub struct Segments<'data, 'bank> {
    clip: Clip<'data, 'bank>,
    next: u32,
}

impl<'data, 'bank> Segments<'data, 'bank> {
    pub(crate) fn new(clip: Clip<'data, 'bank>) -> Self {
        Segments { clip, next: 0 }
    }
}

impl<'data, 'bank> Iterator for Segments<'data, 'bank> {
    type Item = Segment<'data, 'bank>;

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

impl ExactSizeIterator for Segments<'_, '_> {}
impl FusedIterator for Segments<'_, '_> {}
