//! A reference to one of many clips.

use super::{ClipHead, Clips, Ends};
use crate::clip::{ClipText, HashedPart, Key, Part};
use crate::util::hash::hash;
use lipz_bank::{Fps, VisemeType};
use lipz_layout::U16;
use std::ops::Range;

/// One of the [`Clips`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clip<'c> {
    pub(super) clips: &'c Clips,
    pub(super) batch: u32,
    pub(super) index: u32,
}

impl<'c> Clip<'c> {
    /// Returns the range of a part of the clip among those of all clips.
    fn range(&self, end: impl Fn(&Ends) -> usize) -> Range<usize> {
        let start = self.index.checked_sub(1).map_or(0, |before| end(&self.clips.heads[before as usize].ends));
        start..end(&self.head().ends)
    }

    fn head(&self) -> &'c ClipHead {
        &self.clips.heads[self.index as usize]
    }

    /// Returns the number of the batch, and of the clip in it.
    pub(crate) fn place(&self) -> (usize, usize) {
        (self.batch as usize, self.index as usize)
    }

    pub(crate) fn key(&self) -> &'c str {
        self.clips.keys.get(self.index as usize)
    }

    pub(crate) fn fps(&self) -> Option<Fps> {
        self.head().fps
    }

    pub(crate) fn viseme_type(&self) -> Option<VisemeType> {
        self.head().viseme_type
    }

    pub(crate) fn has_visemes(&self) -> bool {
        self.head().has_visemes
    }

    /// Returns the number of frames.
    pub(crate) fn frame_count(&self) -> usize {
        self.range(|ends| ends.frames).len()
    }

    pub(crate) fn frames(&self) -> Part<'c> {
        let place = self.range(|ends| ends.frames);
        #[cfg(feature = "shards")]
        if let Some(staying) = &self.clips.staying {
            return Part::Stays(staying.file.frames(place));
        }
        Part::Here(&self.clips.frames[place])
    }

    pub(crate) fn starts(&self) -> &'c [u32] {
        &self.clips.starts[self.range(|ends| ends.starts)]
    }

    pub(crate) fn texts(&self) -> &'c [ClipText] {
        &self.clips.texts[self.range(|ends| ends.texts)]
    }

    /// Returns the index of the text in the locale with this number, for clips with joined locales.
    pub(crate) fn text_in(&self, locale: u32) -> Option<usize> {
        let texts = self.texts();
        // Nearly every clip has texts in all locales.
        let is_there = texts.get(locale as usize).is_some_and(|text| text.locale == locale);
        if is_there { Some(locale as usize) } else { texts.binary_search_by_key(&locale, |text| text.locale).ok() }
    }

    /// Returns the locale of one of the texts, for clips whose locales are not yet joined.
    pub(crate) fn tag(&self, text: &ClipText) -> &'c str {
        self.clips.locales.tag(text.locale)
    }

    /// Returns the ends of the segments of one of the texts, modulo 2¹⁶.
    pub(crate) fn text_ends(&self, index: usize) -> &'c [U16] {
        let count = self.starts().len();
        &self.clips.text_ends[self.range(|ends| ends.text_ends)][count * index..][..count]
    }

    /// Returns the texts, each with the ends of its segments.
    pub(crate) fn texts_with_ends(&self) -> impl Iterator<Item = (&'c ClipText, &'c [U16])> + use<'c> {
        let ends = &self.clips.text_ends[self.range(|ends| ends.text_ends)];
        std::iter::zip(self.texts(), ends.chunks_exact(self.starts().len().max(1)))
    }

    /// Returns the display texts of one of the texts, one after the other.
    pub(crate) fn displays(&self, index: usize) -> Part<'c> {
        let text = &self.texts()[index];
        #[cfg(feature = "shards")]
        if let Some(staying) = &self.clips.staying {
            return Part::Stays(staying.file.text(text, last_start(self.text_ends(index))));
        }
        Part::Here(&self.clips.displays[text.locale as usize][text.place()])
    }

    /// Whether a locale has more texts than fit into a batch, so that some are missing.
    pub(crate) fn lacks_texts(&self) -> bool {
        self.clips.lacks_texts
    }

    /// Returns the event strings of all segments, if the file has an `events` element. Returns names and keys of the
    /// curves, sorted by name.
    pub(crate) fn events(&self) -> Option<impl Iterator<Item = &'c str> + use<'c>> {
        let numbers = self.range(|ends| ends.events);
        self.head().has_events.then(|| self.clips.events.range(numbers))
    }

    /// Returns names and keys of the curves, sorted by name.
    pub(crate) fn curves(&self) -> impl Iterator<Item = (&'c str, &'c [Key])> + use<'c> {
        self.clips.curves.range(self.range(|ends| ends.curves))
    }

    pub(crate) fn has_curves(&self) -> bool {
        !self.range(|ends| ends.curves).is_empty()
    }

    /// Returns the data of the section of phones; empty without phones.
    pub(crate) fn phones(&self) -> &'c [u8] {
        &self.clips.phones[self.range(|ends| ends.phones)]
    }

    /// Returns the flags of the record of phones.
    pub(crate) fn phone_flags(&self) -> u32 {
        self.head().phone_flags
    }

    pub(crate) fn source(&self) -> Part<'c> {
        #[cfg(feature = "shards")]
        if let Some(staying) = &self.clips.staying {
            return Part::Stays(staying.file.source(staying.sources[self.index as usize]));
        }
        Part::Here(&self.clips.sources[self.range(|ends| ends.source)])
    }

    /// Returns the source record with its hash.
    pub(crate) fn hashed_source(&self) -> HashedPart<'c> {
        #[cfg(feature = "shards")]
        if let Some(staying) = &self.clips.staying {
            let hash = u64::from(staying.sources[self.index as usize].hash);
            return HashedPart { hash, bytes: self.source() };
        }
        let bytes = &self.clips.sources[self.range(|ends| ends.source)];
        HashedPart { hash: hash(bytes), bytes: Part::Here(bytes) }
    }
}

/// Returns the start of the last text relative to the first, from the ends of the texts.
#[cfg(feature = "shards")]
fn last_start(ends: &[U16]) -> usize {
    let before_last = &ends[..ends.len().saturating_sub(1)];
    before_last.iter().fold(0, |start, low| start + usize::from(low.get().wrapping_sub(start as u16)))
}
