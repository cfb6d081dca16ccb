//! A checked clip: the meaning of a Lipz file, independent of its spelling.

mod batches;
mod curves;
mod hashed_part;
mod locales;
#[cfg(feature = "shards")]
mod on_disk;
mod part;
mod phones;
mod runs;
pub(crate) mod source_record;
mod store;

pub(crate) use batches::Batches;
pub(crate) use curves::{Curves, Key};
pub(crate) use hashed_part::HashedPart;
pub(crate) use locales::Locales;
#[cfg(feature = "shards")]
pub(crate) use on_disk::{ClipFile, PartOnDisk, SectionStarts, SourceOnDisk, Window};
pub(crate) use part::Part;
pub(crate) use phones::ClipPhones;
pub(crate) use runs::{Runs, split_run};
pub(crate) use store::{Clip, Clips};

#[cfg(feature = "shards")]
use crate::util::hash::hash;
use crate::util::strings::Strings;
use lipz_bank::{Fps, VisemeType};
use lipz_layout::{TEXT_COUNT_BYTES, U16};
use std::ops::Range;

/// One clip as the check produces it. A thread reuses the same one for all of its files to keep its buffers, and adds
/// it to its [`Clips`].
#[derive(Debug, Default)]
pub(crate) struct ClipData {
    /// The frame rate of the file, or the project's default.
    pub(crate) fps: Option<Fps>,
    /// The viseme type of the file, or the project's default.
    pub(crate) viseme_type: Option<VisemeType>,
    /// Whether the file has a `visemes` element.
    pub(crate) has_visemes: bool,
    /// Frame codes, without delimiters.
    pub(crate) frames: Vec<u8>,
    /// The start frames of all segments; the first is 0.
    pub(crate) starts: Vec<u32>,
    /// Texts, sorted by the tags of their locales.
    pub(crate) texts: Vec<ClipText>,
    /// The runs of all texts.
    pub(crate) runs: Runs,
    /// A buffer for display texts of one locale that may still change before they become a run.
    pub(crate) displays: Strings,
    /// Whether the file has an `events` element.
    pub(crate) has_events: bool,
    /// Trimmed event strings of all segments, if there is one.
    pub(crate) events: Strings,
    /// Curves, sorted by name.
    pub(crate) curves: Curves,
    /// The phones.
    pub(crate) phones: ClipPhones,
    /// Whether an element has a different number of segments than the clip, and was joined into one.
    pub(crate) has_joined: bool,
    /// The difference between the file and the fields above; see `source_record`. Empty when stripped.
    pub(crate) source: Vec<u8>,
}

/// The display texts of a clip in one locale: one of its runs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClipText {
    /// The number of the locale in [`Locales`].
    pub(crate) locale: u32,
    /// The start of the run among the clip's runs; its end follows, with [`IS_FALLBACK`]. In [`Clips`], the position of
    /// the texts alone among all texts of the locale, or in their file. Each text takes 16 bytes, because there are
    /// millions.
    start: u32,
    end: u32,
    /// The hash of the texts, computed while they are in the cache.
    pub(crate) hash: u32,
}

/// A bit in the end of a run. A file, and therefore its texts, has less than 2²⁸ bytes; all texts of a locale in
/// [`Clips`] have less than 2³⁰.
const IS_FALLBACK: u32 = 1 << 31;
/// A bit in the end of texts that stay in the pool of a bank, if the last of them is counted. A pool has less than 2³⁰
/// bytes.
const IS_COUNTED: u32 = 1 << 30;

impl ClipText {
    /// Returns the range of the run among the clip's runs.
    fn place(&self) -> Range<usize> {
        self.start as usize..(self.end & !(IS_FALLBACK | IS_COUNTED)) as usize
    }

    /// Returns the same text at a different position.
    fn at(&self, place: Range<usize>) -> ClipText {
        ClipText { start: place.start as u32, end: place.end as u32 | self.end & IS_FALLBACK, ..*self }
    }

    /// Creates texts that stay at a position in the pool of a bank, with or without a count before the last one.
    #[cfg(feature = "shards")]
    pub(crate) fn staying(locale: u32, place: Range<usize>, is_counted: bool, displays: &[u8]) -> ClipText {
        let counted = if is_counted { IS_COUNTED } else { 0 };
        ClipText { locale, start: place.start as u32, end: place.end as u32 | counted, hash: hash(displays) as u32 }
    }

    /// Whether texts without a table of ends are empty, in memory or in a file.
    pub(crate) fn is_empty(&self) -> bool {
        self.place().len() == if self.end & IS_COUNTED != 0 { TEXT_COUNT_BYTES } else { 0 }
    }

    /// Whether the last of texts that stay in a file is counted.
    #[cfg(feature = "shards")]
    fn is_counted(&self) -> bool {
        self.end & IS_COUNTED != 0
    }

    /// Whether it is the text of another locale, which is not packed.
    pub(crate) fn is_fallback(&self) -> bool {
        self.end & IS_FALLBACK != 0
    }

    /// Returns the same text for a locale without a text of its own.
    pub(crate) fn as_fallback_of(&self, locale: u32) -> ClipText {
        ClipText { locale, end: self.end | IS_FALLBACK, ..*self }
    }
}

impl ClipData {
    /// Resets it to an empty clip, and keeps its buffers.
    pub(crate) fn clear(&mut self) {
        self.frames.clear();
        self.starts.clear();
        self.texts.clear();
        self.runs.clear();
        self.displays.clear();
        self.events.clear();
        self.curves.clear();
        self.phones.clear();
        self.source.clear();
        (self.has_visemes, self.has_events, self.has_joined) = (false, false, false);
        (self.fps, self.viseme_type) = (None, None);
    }

    /// Returns the first frame of a segment; after the last segment, the end of the clip.
    pub(crate) fn segment_start(&self, segment: usize) -> u32 {
        self.starts.get(segment).copied().unwrap_or(self.frames.len() as u32)
    }

    /// Adds `self.displays` as the texts of a locale.
    pub(crate) fn add_displays(&mut self, locale: u32) {
        self.displays.iter().for_each(|text| self.runs.push(text.as_bytes()));
        self.end_run(locale, false);
    }

    /// Adds texts from a bank, one per segment, as those of a locale.
    pub(crate) fn add_texts<'b>(&mut self, locale: u32, texts: impl Iterator<Item = &'b [u8]>, is_fallback: bool) {
        texts.for_each(|text| self.runs.push(text));
        self.end_run(locale, is_fallback);
    }

    /// Assigns the run that was pushed to `self.runs` to a locale.
    pub(crate) fn end_run(&mut self, locale: u32, is_fallback: bool) {
        let own = self.run(locale, std::iter::empty());
        self.texts.push(if is_fallback { own.as_fallback_of(locale) } else { own });
    }

    /// Ends the run with these texts of its last segments. Returns the text of a locale, which is not among the clip's.
    pub(crate) fn run<'b>(&mut self, locale: u32, texts: impl Iterator<Item = &'b [u8]>) -> ClipText {
        texts.for_each(|text| self.runs.push(text));
        let (place, hash) = self.runs.end();
        ClipText { locale, start: place.start as u32, end: place.end as u32, hash: hash as u32 }
    }

    /// Returns the run of a text: the segments, and the end of each of them.
    pub(crate) fn whole_run(&self, text: &ClipText) -> &[u8] {
        self.runs.get(text.place())
    }

    /// Returns the display texts alone, one after the other.
    pub(crate) fn text_of(&self, text: &ClipText) -> &[u8] {
        split_run(self.whole_run(text), self.starts.len()).0
    }

    /// Returns the length of the display texts in bytes, without the table of ends.
    pub(crate) fn text_bytes(&self, text: &ClipText) -> usize {
        text.place().len() - size_of::<U16>() * self.starts.len()
    }

    /// Whether a segment of a text displays nothing.
    pub(crate) fn is_blank(&self, text: &ClipText, segment: usize) -> bool {
        let (_, ends) = split_run(self.whole_run(text), self.starts.len());
        ends.get(segment) == segment.checked_sub(1).map_or(Some(&U16::ZERO), |before| ends.get(before))
    }
}
