//! One segment of a clip: frames, display texts and event string.

use crate::text::TextPlace;
use crate::{Bank, Clip, Events, Locale, Text};
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;
use lipz_layout::EventRecord;

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
    pub fn frames(&self) -> &'data [u8] {
        let Range { start, end } = self.frame_range();
        self.clip.bank.frames.get(start as usize..end as usize).unwrap_or(&[])
    }

    /// The display text in `locale`, or in the locale that it falls back to; `None` if neither has
    /// a text for this clip.
    ///
    /// A segment of an existing text may be empty. `locale` comes from the same bank, or from a
    /// [`TextBank`](crate::TextBank) beside it. With a locale of [another bank](Locale::is_of) there is no text, and
    /// debug builds panic.
    #[inline(always)] // otherwise the whole segment is copied for the call
    pub fn text<'texts>(&self, locale: Locale<'texts>) -> Option<Text<'texts>> {
        locale.bank.assert_is(self.clip.bank.origin());
        self.text_place(locale)?.text(locale)
    }

    /// Like [`Segment::text`], as bytes that are not checked to be UTF-8: for programs that cannot
    /// afford the checker's code.
    #[inline]
    pub fn text_bytes<'texts>(&self, locale: Locale<'texts>) -> Option<&'texts [u8]> {
        locale.bank.assert_is(self.clip.bank.origin());
        self.text_place(locale)?.bytes(locale)
    }

    /// Whether `locale` has a text of its own for this clip, which may be empty in this segment. Looks at no byte of it.
    pub fn has_own_text(&self, locale: Locale<'_>) -> bool {
        locale.bank.assert_is(self.clip.bank.origin());
        self.text_place(locale).map_or(false, |place| !place.is_fallback())
    }

    /// Where the text in `locale` stands; nowhere if that is a locale of another bank.
    #[inline(always)]
    fn text_place(&self, locale: Locale<'_>) -> Option<TextPlace> {
        if locale.bank != self.clip.bank.origin() {
            return None;
        }
        TextPlace::new(locale, self.first_number(), self.number())
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
    /// # let bytes: &[u8] = include_bytes!("../examples/act1.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let sad = bank.event_name("sad"); // names are looked up once, and compared as numbers
    /// let segments = bank.clips().flat_map(|clip| clip.segments());
    /// let tears = segments.flat_map(|segment| segment.events()).filter(|event| match event.command {
    ///     Command::Feels(emotion) => Some(emotion) == sad,
    ///     _ => false,
    /// });
    /// assert_eq!(tears.count(), 1);
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn events(&self) -> Events<'data> {
        Events::new(self.clip.bank, self.event_record())
    }

    fn event_record(&self) -> Option<&'data EventRecord> {
        let bank = self.clip.bank;
        bank.events.get(bank.event_refs.get(self.number())?.get() as usize)
    }
}

/// Equal are segments of one clip with equal indices.
impl PartialEq for Segment<'_, '_> {
    fn eq(&self, other: &Self) -> bool {
        self.clip == other.clip && self.index == other.index
    }
}
impl Eq for Segment<'_, '_> {}

/// The clip and the index, not the texts.
impl fmt::Debug for Segment<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Segment").field("clip", &self.clip).field("index", &self.index).finish()
    }
}

/// Starts that are compared at once: as many as fit a vector.
const NEAR_STARTS: usize = 4;

/// The last segment that starts at or before `frame`, one of the clip: the segment that contains it.
#[inline(always)]
pub(crate) fn index_of_frame(clip: &Clip<'_, '_>, frame: u32) -> Option<u32> {
    let offset = clip.record.frames_offset_bytes.get().wrapping_add(frame);
    // Segment 0 starts at or before every frame.
    let second = (clip.record.segments_first.get() as usize).wrapping_add(1);
    if cfg!(target_pointer_width = "64") {
        // Starts ascend from clip to clip, so those that are not the clip's own do no harm. Few clips need the
        // second look.
        for index in [0, NEAR_STARTS] {
            let first = second.wrapping_add(index);
            if let Some(near) = clip.bank.starts.get(first..first.wrapping_add(NEAR_STARTS)) {
                let passed = near.iter().map(|start| u32::from(start.get() <= offset)).fold(0, u32::wrapping_add);
                if passed < NEAR_STARTS as u32 {
                    return Some(passed.wrapping_add(index as u32));
                }
            }
        }
    }
    index_in_starts(clip.bank, clip.slot(), second, offset)
}

/// A clip of more than nine segments, or one of the last clips: rare, so it is kept out of the way.
#[cold]
fn index_in_starts(bank: &Bank<'_>, slot: u32, second: usize, offset: u32) -> Option<u32> {
    let count = usize::from(bank.keys.get(slot as usize)?.segment_count.get()).checked_sub(1)?;
    let starts = bank.starts.get(second..second.wrapping_add(count))?;
    Some(starts.partition_point(|start| start.get() <= offset) as u32)
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

#[cfg(test)]
mod tests {
    use crate::Bank;
    use lipz_testkit::golden::{DRAMA, changed, put};

    /// What [`Segment::text`] returns where debug assertions are off.
    #[test]
    fn a_locale_of_another_bank_leads_to_no_text() {
        let newer = changed(DRAMA, |bank| put(bank, 22, [9, 0]));
        let banks = [Bank::open(DRAMA), Bank::open(&newer)].map(|bank| bank.expect("a bank"));
        for (own, other) in [(0, 1), (1, 0)] {
            let segment = banks[own].clips().next().and_then(|clip| clip.segment(0)).expect("a segment");
            let [own, other] = [own, other].map(|at: usize| banks[at].locale("de-de").expect("German"));
            assert!(segment.text_place(own).is_some() && segment.text_place(other).is_none());
        }
    }
}
