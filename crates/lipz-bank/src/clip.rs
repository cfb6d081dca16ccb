//! One clip of a bank: frames and segments by time.

use core::fmt;
use core::iter::FusedIterator;

use crate::{Bank, ClipId, Fps, Segment, Segments, Time, Viseme, VisemeType};
use lipz_layout::{ClipRecord, FLAG_VISEMES, KeyRecord};
use lipz_types::StoredFps;

/// One spoken line: mouth shapes by frame, and segments with texts and events.
#[derive(Clone, Copy)]
pub struct Clip<'data, 'bank> {
    pub(crate) bank: &'bank Bank<'data>,
    pub(crate) record: &'data ClipRecord,
    slot: u32,
    /// Not checked, so that finding a clip takes no time for it.
    fps: Option<StoredFps>,
    viseme_type: Option<VisemeType>,
}

impl<'data, 'bank> Clip<'data, 'bank> {
    #[inline]
    pub(crate) fn new(bank: &'bank Bank<'data>, record: &'data ClipRecord, slot: u32) -> Self {
        let fps = lipz_layout::stored_fps(record.rate.get(), bank.rates);
        Clip { bank, record, slot, fps, viseme_type: VisemeType::from_number(record.viseme_type) }
    }

    /// The clip with `fps` where its file and the project left the frame rate unspecified.
    #[must_use]
    pub fn or_fps(mut self, fps: Fps) -> Self {
        self.fps = self.fps.or(Some(fps.into()));
        self
    }

    /// The clip with `viseme_type` where its file and the project left the viseme type unspecified.
    #[must_use]
    pub fn or_viseme_type(mut self, viseme_type: VisemeType) -> Self {
        self.viseme_type = self.viseme_type.or(Some(viseme_type));
        self
    }

    /// The id: the hash of the key.
    pub fn id(&self) -> ClipId {
        ClipId::from_u64(self.key_record().map_or(0, |record| record.id.get()))
    }

    /// The key: path of the Lipz file below its source root, without extension. Empty only in a
    /// damaged bank.
    pub fn key(&self) -> &'data str {
        self.key_record().and_then(|record| key(self.bank, record)).unwrap_or("")
    }

    /// How the clip is found; in a verified bank there is one for each.
    #[inline]
    fn key_record(&self) -> Option<&'data KeyRecord> {
        self.bank.keys.get(self.slot as usize)
    }

    /// The place of the clip in the bank, for [`Bank::clip_at`].
    pub const fn slot(&self) -> u32 {
        self.slot
    }

    /// The frame rate; `None` if it is unspecified and none was given with [`Clip::or_fps`], or if it is damaged.
    /// Without a frame rate no time leads to a frame.
    pub fn fps(&self) -> Option<Fps> {
        self.fps?.checked()
    }

    /// The frame rate as the bank has it.
    #[inline]
    pub(crate) const fn stored_fps(&self) -> Option<StoredFps> {
        self.fps
    }

    /// The viseme type; `None` if it is unspecified and none was given with
    /// [`Clip::or_viseme_type`].
    pub const fn viseme_type(&self) -> Option<VisemeType> {
        self.viseme_type
    }

    /// Whether the file has a `visemes` element. Without one, a clip has texts or events but no
    /// frames, and its segments no times.
    pub const fn has_visemes(&self) -> bool {
        self.record.flags & FLAG_VISEMES != 0
    }

    /// Whether the file has an `events` element.
    pub fn has_events(&self) -> bool {
        (self.record.segments_first.get() as usize) < self.bank.event_refs.len()
    }

    /// The number of frames.
    #[inline]
    pub fn frame_count(&self) -> u32 {
        self.record.frame_count.get()
    }

    /// The frame codes, one byte per frame, without delimiters. Empty if damaged.
    pub fn frames(&self) -> &'data [u8] {
        let start = self.record.frames_offset_bytes.get() as usize;
        let end = start.checked_add(self.frame_count() as usize);
        end.and_then(|end| self.bank.frames.get(start..end)).unwrap_or(&[])
    }

    /// Microseconds from the start of the first frame to the end of the last, rounded up; `None`
    /// without a frame rate.
    pub fn duration_us(&self) -> Option<u64> {
        Some(self.fps?.start_of_frame_us(self.frame_count()))
    }

    /// The index of the frame that shows at `time`; `None` before the start, from the end on, and
    /// without a frame rate.
    #[inline]
    pub fn frame_at<T: Time>(&self, time: T) -> Option<u32> {
        time.frame(self.fps?, self.frame_count())
    }

    /// The viseme of frame `index`; rest outside the clip.
    #[inline]
    pub fn viseme(&self, index: u32) -> Viseme {
        if index < self.frame_count() { self.viseme_of(index) } else { Viseme::REST }
    }

    /// The viseme of a frame that the clip has.
    #[inline]
    fn viseme_of(&self, index: u32) -> Viseme {
        let offset = (self.record.frames_offset_bytes.get() as usize).checked_add(index as usize);
        match offset.and_then(|offset| self.bank.frames.get(offset)) {
            Some(&code) => Viseme::from_code(code),
            None => Viseme::REST,
        }
    }

    /// The viseme that shows at `time`; rest before the start, from the end on, and without a frame
    /// rate.
    #[inline]
    pub fn viseme_at<T: Time>(&self, time: T) -> Viseme {
        match self.frame_at(time) {
            Some(frame) => self.viseme_of(frame),
            None => Viseme::REST,
        }
    }

    /// The number of segments, at least 1 in a verified bank. Whatever a damaged bank says, there
    /// are no more than it has starts for.
    #[inline]
    pub fn segment_count(&self) -> u32 {
        let count = self.key_record().map_or(0, |record| record.segment_count.get());
        u32::from(count).min(self.bank.starts.len() as u32)
    }

    /// The segment with this index.
    #[inline(always)] // otherwise the whole clip is copied for the call
    pub fn segment(&self, index: u32) -> Option<Segment<'data, 'bank>> {
        if index < self.segment_count() { Some(Segment::new(*self, index)) } else { None }
    }

    /// All segments in order.
    pub fn segments(&self) -> Segments<'data, 'bank> {
        Segments::new(*self)
    }

    /// The segment that frame `index` belongs to. Segments of no frames are never found by frame.
    #[inline(always)]
    pub fn segment_of_frame(&self, index: u32) -> Option<Segment<'data, 'bank>> {
        if index < self.frame_count() { self.segment_that_has(index) } else { None }
    }

    /// The segment at `time`; `None` before the start, from the end on, and without a frame rate.
    #[inline(always)]
    pub fn segment_at<T: Time>(&self, time: T) -> Option<Segment<'data, 'bank>> {
        self.segment_that_has(self.frame_at(time)?)
    }

    /// The segment of a frame that the clip has.
    #[inline(always)]
    fn segment_that_has(&self, frame: u32) -> Option<Segment<'data, 'bank>> {
        Some(Segment::new(*self, crate::segment::index_of_frame(self, frame)?))
    }
}

/// The key, unless it is damaged.
pub(crate) fn key<'data>(bank: &Bank<'data>, record: &KeyRecord) -> Option<&'data str> {
    bank.texts.names.text_at(record.key_offset_bytes.get(), u32::from(record.key_length_bytes.get()))
}

/// Equal are the same clips of one bank, if they were given the same frame rate and viseme type.
impl PartialEq for Clip<'_, '_> {
    fn eq(&self, other: &Self) -> bool {
        let place = |clip: &Self| (clip.bank.origin(), clip.slot, clip.fps, clip.viseme_type);
        place(self) == place(other)
    }
}
impl Eq for Clip<'_, '_> {}

/// The key and the slot, not the frames.
impl fmt::Debug for Clip<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Clip").field("key", &self.key()).field("slot", &self.slot).finish_non_exhaustive()
    }
}

/// Clips of a bank in the order of their keys.
#[derive(Clone, Debug)]
pub struct Clips<'data, 'bank> {
    bank: &'bank Bank<'data>,
    next: usize,
    end: usize,
}

impl<'data, 'bank> Clips<'data, 'bank> {
    pub(crate) fn new(bank: &'bank Bank<'data>, next: usize, end: usize) -> Self {
        Clips { bank, next, end }
    }
}

impl<'data, 'bank> Iterator for Clips<'data, 'bank> {
    type Item = Clip<'data, 'bank>;

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

impl FusedIterator for Clips<'_, '_> {}
