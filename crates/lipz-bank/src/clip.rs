//! One clip of a bank: frames and segments by time.

use core::fmt;
use core::iter::FusedIterator;

use crate::dialogue::Queries;
use crate::event::NameKey;
use crate::segment::Segments;
use crate::{Bank, ClipId, Dialogue, EventName, Fps, Segment, Time, Viseme, VisemeType};
use lipz_layout::{ClipRecord, FLAG_VISEMES, KeyRecord};
use lipz_types::StoredFps;

/// One spoken line: visemes by frame, and segments with texts and events.
#[derive(Clone, Copy)]
pub struct Clip<'a> {
    pub(crate) bank: &'a Bank<'a>,
    pub(crate) record: &'a ClipRecord,
    /// The dialogue that the clip was found in. Texts, voices and names may be in other files of it.
    pub(crate) home: Option<&'a Dialogue<'a>>,
    /// Stored without a check, so that finding a clip takes no time for it.
    fps: Option<StoredFps>,
    /// The number of the viseme type; 0 if unspecified. It is only interpreted on request.
    viseme_type: u8,
    /// 1 if the bank of the clip also contains its texts. Not a `bool`, because an `Option<Clip>` would use it as its
    /// niche, and each look-up of a segment would have to test it.
    has_texts: u8,
}

impl<'a> Clip<'a> {
    /// Returns the clip in this slot of a bank, found in the dialogue `home`, if any.
    #[inline(always)]
    pub(crate) fn new(bank: &'a Bank<'a>, slot: u32, home: Option<&'a Dialogue<'a>>, has_texts: bool) -> Option<Self> {
        let record = bank.clips.get(slot as usize)?;
        let fps = lipz_layout::stored_fps(record.rate.get(), bank.rates);
        let has_texts = u8::from(has_texts);
        Some(Clip { bank, record, home, fps, viseme_type: record.viseme_type, has_texts })
    }

    /// Sets the frame rate, unless the file or the project specifies one.
    #[must_use]
    pub fn or_fps(mut self, fps: Fps) -> Self {
        self.fps = self.fps.or(Some(fps.into()));
        self
    }

    /// Sets the viseme type, unless the file or the project specifies one.
    #[must_use]
    pub fn or_viseme_type(mut self, viseme_type: VisemeType) -> Self {
        if self.viseme_type().is_none() {
            self.viseme_type = viseme_type as u8;
        }
        self
    }

    /// Returns the id: the hash of the key.
    pub fn id(&self) -> ClipId {
        ClipId::from_u64(self.key_record().map_or(0, |record| record.id.get()))
    }

    /// Returns the key: the path of the Lipz file below its source root, without extension. Empty only in a damaged
    /// bank.
    pub fn key(&self) -> &'a str {
        self.key_record().and_then(|record| key(self.bank, record)).unwrap_or("")
    }

    /// Returns the key record. In a verified bank, each clip has one.
    #[inline]
    fn key_record(&self) -> Option<&'a KeyRecord> {
        self.bank.keys.get(self.slot() as usize)
    }

    /// Returns the number of the clip in its bank, for [`Bank::clip_at`].
    #[inline]
    pub fn slot(&self) -> u32 {
        self.bank.slot_of(self.record)
    }

    /// Returns the number of the clip's bank among the files of its dialogue, for
    /// [`Dialogue::clip_at`](crate::Dialogue::clip_at).
    pub const fn file(&self) -> u32 {
        self.bank.number
    }

    /// Whether the bank of the clip also contains its texts.
    #[inline]
    pub(crate) const fn has_texts(&self) -> bool {
        self.has_texts != 0
    }

    /// Returns the name that a cursor has stored, if it belongs to the bank or the dialogue.
    pub(crate) fn name(&self, key: NameKey) -> Option<EventName<'a>> {
        if key.bank == self.bank.origin {
            return EventName::numbered(self.bank, key.id);
        }
        let (home, queries) = self.together()?;
        (queries.name)(home, key)
    }

    /// Returns the dialogue that the clip was found in, and the queries over all of its files, if it has more than one.
    #[inline(always)]
    pub(crate) fn together(&self) -> Option<(&'a Dialogue<'a>, &'static Queries)> {
        let home = self.home?;
        Some((home, home.queries()?))
    }

    /// Returns the frame rate; `None` if it is damaged, or unspecified and not set with [`Clip::or_fps`]. Without a
    /// frame rate, no time leads to a frame.
    pub fn fps(&self) -> Option<Fps> {
        self.fps?.checked()
    }

    /// Returns the frame rate as stored in the bank.
    #[inline]
    pub(crate) const fn stored_fps(&self) -> Option<StoredFps> {
        self.fps
    }

    /// Returns the viseme type; `None` if it is unspecified and not set with [`Clip::or_viseme_type`].
    pub fn viseme_type(&self) -> Option<VisemeType> {
        VisemeType::from_number(self.viseme_type)
    }

    /// Whether the file has a `visemes` element. Without one, a clip has texts or events but no frames, and its
    /// segments have no times.
    pub const fn has_visemes(&self) -> bool {
        self.record.flags & FLAG_VISEMES != 0
    }

    /// Whether the file has an `events` element.
    pub fn has_events(&self) -> bool {
        (self.record.segments_first.get() as usize) < self.bank.event_refs.len()
    }

    /// Returns the number of frames.
    #[inline]
    pub fn frame_count(&self) -> u32 {
        self.record.frame_count.get()
    }

    /// Returns the frame codes, one byte per frame, without delimiters. Empty if damaged.
    pub fn frames(&self) -> &'a [u8] {
        let start = self.record.frames_offset_bytes.get() as usize;
        let end = start.checked_add(self.frame_count() as usize);
        end.and_then(|end| self.bank.frames.get(start..end)).unwrap_or(&[])
    }

    /// Returns the microseconds from the start of the first frame to the end of the last, rounded up; `None` without a
    /// frame rate.
    pub fn duration_us(&self) -> Option<u64> {
        Some(self.fps?.start_of_frame_us(self.frame_count()))
    }

    /// Returns the index of the frame at `time`; `None` before the start, from the end on, and without a frame rate.
    #[inline]
    pub fn frame_at<T: Time>(&self, time: T) -> Option<u32> {
        time.frame(self.fps?, self.frame_count())
    }

    /// Returns the viseme of frame `index`, or rest outside the clip.
    #[inline]
    pub fn viseme(&self, index: u32) -> Viseme {
        if index < self.frame_count() { self.viseme_of(index) } else { Viseme::REST }
    }

    /// Returns the viseme of a frame, which must be in the clip.
    #[inline]
    fn viseme_of(&self, index: u32) -> Viseme {
        let offset = (self.record.frames_offset_bytes.get() as usize).checked_add(index as usize);
        match offset.and_then(|offset| self.bank.frames.get(offset)) {
            Some(&code) => Viseme::from_code(code),
            None => Viseme::REST,
        }
    }

    /// Returns the viseme at `time`, or rest before the start, from the end on, and without a frame rate.
    #[inline]
    pub fn viseme_at<T: Time>(&self, time: T) -> Viseme {
        match self.frame_at(time) {
            Some(frame) => self.viseme_of(frame),
            None => Viseme::REST,
        }
    }

    /// Returns the number of segments, at least 1 in a verified bank. Even in a damaged bank, it is at most the number
    /// of stored starts.
    #[inline]
    pub fn segment_count(&self) -> u32 {
        let count = self.key_record().map_or(0, |record| record.segment_count.get());
        u32::from(count).min(self.bank.starts.len() as u32)
    }

    /// Returns the segment with this index.
    #[inline(always)] // otherwise the call copies the whole clip
    pub fn segment(&self, index: u32) -> Option<Segment<'a>> {
        if index < self.segment_count() { Some(Segment::new(*self, index)) } else { None }
    }

    /// Returns all segments in order.
    pub fn segments(&self) -> impl ExactSizeIterator<Item = Segment<'a>> + Clone {
        Segments::new(*self)
    }

    /// Returns the segment that contains frame `index`. Never returns an empty segment.
    #[inline(always)]
    pub fn segment_of_frame(&self, index: u32) -> Option<Segment<'a>> {
        if index < self.frame_count() { self.segment_that_has(index) } else { None }
    }

    /// Returns the segment at `time`; `None` before the start, from the end on, and without a frame rate.
    #[inline(always)]
    pub fn segment_at<T: Time>(&self, time: T) -> Option<Segment<'a>> {
        self.segment_that_has(self.frame_at(time)?)
    }

    /// Returns the segment that contains a frame, which must be in the clip.
    #[inline(always)]
    fn segment_that_has(&self, frame: u32) -> Option<Segment<'a>> {
        Some(Segment::new(*self, crate::segment::index_of_frame(self, frame)?))
    }
}

/// Returns the key, unless it is damaged.
pub(crate) fn key<'data>(bank: &Bank<'data>, record: &KeyRecord) -> Option<&'data str> {
    bank.names.text_at(record.key_offset_bytes.get(), u32::from(record.key_length_bytes.get()))
}

/// Two clips are equal if they are the same clip of one bank, have the same texts, and were given the same frame rate
/// and viseme type.
impl PartialEq for Clip<'_> {
    fn eq(&self, other: &Self) -> bool {
        let place = |clip: &Self| (clip.bank.origin, clip.slot(), clip.has_texts, clip.fps, clip.viseme_type);
        place(self) == place(other)
    }
}
impl Eq for Clip<'_> {}

/// Prints the key and the slot, not the frames.
impl fmt::Debug for Clip<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Clip").field("key", &self.key()).field("slot", &self.slot()).finish_non_exhaustive()
    }
}

/// Clips of a bank, ordered by key.
#[derive(Clone)]
pub(crate) struct Clips<'a> {
    bank: &'a Bank<'a>,
    next: usize,
    end: usize,
}

impl<'a> Clips<'a> {
    pub(crate) fn new(bank: &'a Bank<'a>, next: usize, end: usize) -> Self {
        Clips { bank, next, end }
    }

    /// Returns the iterator without the first `passed` clips.
    pub(crate) fn behind(self, passed: usize) -> Self {
        Clips { next: self.next.saturating_add(passed).min(self.end), ..self }
    }
}

impl<'a> Iterator for Clips<'a> {
    type Item = Clip<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.next >= self.end {
            return None;
        }
        let slot = self.bank.key_order.get(self.next).map(|slot| slot.get());
        let clip = slot.and_then(|slot| self.bank.clip_at(slot));
        // A damaged order table ends the iteration.
        self.next = if clip.is_some() { self.next.saturating_add(1) } else { self.end };
        clip
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, Some(self.end.saturating_sub(self.next)))
    }
}

impl FusedIterator for Clips<'_> {}
