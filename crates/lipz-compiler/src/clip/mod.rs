//! A checked clip: what a Lipz file means, free of how it is written.

mod batches;
mod curves;
mod locales;
mod packed;
mod part;
mod runs;
#[cfg(feature = "shards")]
mod staying;
mod store;

pub(crate) use batches::Batches;
pub(crate) use curves::{Curves, Key};
pub(crate) use locales::Locales;
pub(crate) use part::Part;
pub(crate) use runs::{Runs, split_run};
#[cfg(feature = "shards")]
pub(crate) use staying::{ClipFile, SectionStarts, StayingPart, StayingSource, Window};
pub(crate) use store::{Clip, Clips};

#[cfg(feature = "shards")]
use crate::hashed::hash;
use crate::strings::Strings;
use lipz_bank::{Fps, VisemeType};
use lipz_layout::{TEXT_COUNT_BYTES, U16};
use std::ops::Range;

/// One clip as the check makes it. A thread fills the same one for all of its files, so that its
/// buffers are made once, and adds it to its [`Clips`].
#[derive(Debug, Default)]
pub(crate) struct ClipData {
    /// Frame rate, of the file or the project's default.
    pub(crate) fps: Option<Fps>,
    /// Viseme type, of the file or the project's default.
    pub(crate) viseme_type: Option<VisemeType>,
    /// Whether the file has a `visemes` element.
    pub(crate) has_visemes: bool,
    /// Frame codes, without delimiters.
    pub(crate) frames: Vec<u8>,
    /// Start frames of all segments; the first is 0.
    pub(crate) starts: Vec<u32>,
    /// Texts in the order of their locales' tags.
    pub(crate) texts: Vec<ClipText>,
    /// The runs of all texts.
    pub(crate) runs: Runs,
    /// Room for the display texts of one locale that may change before they become a run.
    pub(crate) displays: Strings,
    /// Whether the file has an `events` element.
    pub(crate) has_events: bool,
    /// Trimmed event strings of all segments, if it has.
    pub(crate) events: Strings,
    /// Curves in the order of their names.
    pub(crate) curves: Curves,
    /// Whether an element has another number of segments than the clip, and was joined to one.
    pub(crate) has_joined: bool,
    /// What the above lost of the file; see `source_record`. Empty when stripped.
    pub(crate) source: Vec<u8>,
}

/// The display texts of a clip in one locale: one of its runs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClipText {
    /// Number of the locale in [`Locales`].
    pub(crate) locale: u32,
    /// Where the run starts among the clip's, and where it ends, with [`IS_FALLBACK`]; in [`Clips`], the texts alone among all of
    /// the locale, or where they stay. There are millions: 16 bytes for each will do.
    start: u32,
    end: u32,
    /// Hash of the texts: made while it is in the cache.
    pub(crate) hash: u32,
}

/// A bit of the end of a run. A file, and so its texts, has less than 2²⁸ bytes; all texts of a locale in [`Clips`] less than 2³⁰.
const IS_FALLBACK: u32 = 1 << 31;
/// A bit of the end of texts that stay in the pool of a bank, where the last of them is counted. A pool has less than 2³⁰ bytes.
const IS_COUNTED: u32 = 1 << 30;

impl ClipText {
    /// Where the run lies among the clip's.
    fn place(&self) -> Range<usize> {
        self.start as usize..(self.end & !(IS_FALLBACK | IS_COUNTED)) as usize
    }

    /// The same where its texts stand elsewhere.
    fn at(&self, place: Range<usize>) -> ClipText {
        ClipText { start: place.start as u32, end: place.end as u32 | self.end & IS_FALLBACK, ..*self }
    }

    /// The texts that stay at a place in the pool of a bank, with a count before the last one or without.
    #[cfg(feature = "shards")]
    pub(crate) fn staying(locale: u32, place: Range<usize>, is_counted: bool, displays: &[u8]) -> ClipText {
        let counted = if is_counted { IS_COUNTED } else { 0 };
        ClipText { locale, start: place.start as u32, end: place.end as u32 | counted, hash: hash(displays) as u32 }
    }

    /// Whether there is nothing in texts that are alone, here or elsewhere.
    pub(crate) fn is_empty(&self) -> bool {
        self.place().len() == if self.end & IS_COUNTED != 0 { TEXT_COUNT_BYTES } else { 0 }
    }

    /// Whether the last of texts that stay is counted.
    #[cfg(feature = "shards")]
    fn is_counted(&self) -> bool {
        self.end & IS_COUNTED != 0
    }

    /// Whether it is the text of another locale, which is not packed.
    pub(crate) fn is_fallback(&self) -> bool {
        self.end & IS_FALLBACK != 0
    }

    /// The same text for another locale, which has none.
    pub(crate) fn as_fallback_of(&self, locale: u32) -> ClipText {
        ClipText { locale, end: self.end | IS_FALLBACK, ..*self }
    }
}

impl ClipData {
    /// Makes it a clip of nothing, and keeps its buffers.
    pub(crate) fn clear(&mut self) {
        self.frames.clear();
        self.starts.clear();
        self.texts.clear();
        self.runs.clear();
        self.displays.clear();
        self.events.clear();
        self.curves.clear();
        self.source.clear();
        (self.has_visemes, self.has_events, self.has_joined) = (false, false, false);
        (self.fps, self.viseme_type) = (None, None);
    }

    /// The first frame of a segment; behind the last one, the end of the clip.
    pub(crate) fn segment_start(&self, segment: usize) -> u32 {
        self.starts.get(segment).copied().unwrap_or(self.frames.len() as u32)
    }

    /// Adds `self.displays` as the texts of a locale.
    pub(crate) fn add_displays(&mut self, locale: u32) {
        self.displays.iter().for_each(|text| self.runs.push(text.as_bytes()));
        self.end_run(locale, false);
    }

    /// Adds texts that lie in a bank, one per segment, as those of a locale.
    pub(crate) fn add_texts<'b>(&mut self, locale: u32, texts: impl Iterator<Item = &'b [u8]>, is_fallback: bool) {
        texts.for_each(|text| self.runs.push(text));
        self.end_run(locale, is_fallback);
    }

    /// Makes the run that was pushed to `self.runs` the texts of a locale.
    pub(crate) fn end_run(&mut self, locale: u32, is_fallback: bool) {
        let (place, hash) = self.runs.end();
        let own = ClipText { locale, start: place.start as u32, end: place.end as u32, hash: hash as u32 };
        self.texts.push(if is_fallback { own.as_fallback_of(locale) } else { own });
    }

    /// The run of a text: the segments, and where each of them ends.
    pub(crate) fn whole_run(&self, text: &ClipText) -> &[u8] {
        self.runs.get(text.place())
    }

    /// The display texts alone, one behind the other.
    pub(crate) fn text_of(&self, text: &ClipText) -> &[u8] {
        split_run(self.whole_run(text), self.starts.len()).0
    }

    /// Bytes of the display texts alone, without the table of ends.
    pub(crate) fn text_bytes(&self, text: &ClipText) -> usize {
        text.place().len() - size_of::<U16>() * self.starts.len()
    }

    /// Whether a segment of a text displays nothing.
    pub(crate) fn is_blank(&self, text: &ClipText, segment: usize) -> bool {
        let (_, ends) = split_run(self.whole_run(text), self.starts.len());
        ends.get(segment) == segment.checked_sub(1).map_or(Some(&U16::ZERO), |before| ends.get(before))
    }
}
