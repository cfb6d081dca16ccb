//! The clips of an object, whose frames, texts and source records stay in its file.

use crate::bank::source_index::SourceIndex;
use crate::clip::{ClipData, ClipFile, ClipText, Clips, SourceOnDisk};
use crate::run::cache::{are_in_order, recall_tables, section};
use crate::util::hash::hash;
use lipz_bank::Bank;
use lipz_layout::{
    ClipRecord, NO_TEXT, TEXT_COUNT_BYTES, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_OFFSET, Tag, U16, U32, counted_length,
};
use std::ops::Range;
use zerocopy::FromBytes;

/// The bytes of an object, and the tables of its clips.
struct Object<'b> {
    bytes: &'b [u8],
    records: &'b [ClipRecord],
    /// One entry per segment for each locale.
    text_starts: &'b [U32],
    segment_count: usize,
    texts: &'b [u8],
    /// `None` if it was stripped.
    sources: Option<SourceIndex<'b>>,
    /// The start of the source records.
    sources_start: usize,
    /// A buffer for the texts of a clip.
    displays: Vec<u8>,
}

/// Returns the clips of a verified bank in the order of their segments; `None` if it is not an object. Its bytes are
/// those of `file`.
pub(super) fn object_clips(bytes: &[u8], bank: &Bank<'_>, file: ClipFile) -> Option<Clips> {
    let mut object = Object::new(bytes)?;
    let (mut clips, mut clip) = (Clips::staying_in(file), ClipData::default());
    let locales: Vec<u32> = bank.locales().map(|locale| clips.locales.number(bank.locale_tag(locale), false)).collect();
    let mut slots: Vec<u32> = bank.clips().map(|clip| clip.slot()).collect();
    slots.sort_by_key(|&slot| object.records.get(slot as usize).map_or(0, |record| record.segments_first.get()));
    for slot in slots {
        let found = bank.clip_at(slot)?;
        recall_tables(&found, &mut clip)?;
        let first = object.records.get(slot as usize)?.segments_first.get() as usize;
        for (number, &locale) in locales.iter().enumerate() {
            object.text(number, locale, first..first + clip.starts.len(), &mut clips)?;
        }
        clips.push_staying(found.key(), &clip, found.frame_count() as usize, object.source(slot)?);
    }
    clips.shrink();
    Some(clips)
}

impl<'b> Object<'b> {
    fn new(bytes: &'b [u8]) -> Option<Object<'b>> {
        let table = |tag: Tag| bytes.get(section(bytes, tag)?);
        let sources = match (table(Tag::SOURCE_INDEX), section(bytes, Tag::SOURCES)) {
            (Some(index), Some(records)) => Some(SourceIndex::new(<[U32]>::ref_from_bytes(index).ok()?, records)),
            _ => None,
        };
        Some(Object {
            bytes,
            records: <[ClipRecord]>::ref_from_bytes(table(Tag::CLIPS)?).ok()?,
            text_starts: <[U32]>::ref_from_bytes(table(Tag::TEXT_STARTS)?).ok()?,
            segment_count: (table(Tag::STARTS)?.len() / size_of::<U32>()).checked_sub(1)?,
            texts: table(Tag::TEXTS)?,
            sources,
            sources_start: section(bytes, Tag::SOURCES).map_or(0, |section| section.start),
            displays: Vec::new(),
        })
    }

    /// Adds the text of the segments with these numbers in a locale to the next clip, if there is one; `None` if the
    /// compiler would not make such texts.
    fn text(&mut self, number: usize, locale: u32, segments: Range<usize>, clips: &mut Clips) -> Option<()> {
        let first_entry = number * self.segment_count + segments.start;
        let entries = self.text_starts.get(first_entry..=first_entry + segments.len())?;
        let offset = |entry: &U32| (entry.get() & TEXT_OFFSET) as usize;
        let ([first, ..], [own @ .., next]) = (entries, entries) else { return None };
        if first.get() == NO_TEXT {
            return Some(());
        }
        let last = own.last().filter(|_| are_in_order(own))?;
        // Determine the end like the reader: from the next entry, or from the count before the last text.
        let is_counted = last.get() & TEXT_HAS_LENGTH != 0;
        let (last_start, end) = if is_counted {
            let start = offset(last) + TEXT_COUNT_BYTES;
            (start, start + counted_length(self.texts.get(offset(last)..start)?))
        } else {
            (offset(last), offset(next))
        };
        self.displays.clear();
        self.displays.extend_from_slice(self.texts.get(offset(first)..offset(last))?);
        self.displays.extend_from_slice(self.texts.get(last_start..end)?);
        let text = ClipText::staying(locale, offset(first)..end, is_counted, &self.displays);
        let is_fallback = first.get() & TEXT_FALLBACK != 0;
        let inner = own.get(1..)?.iter().map(|entry| offset(entry) - offset(first));
        let ends = inner.chain([self.displays.len()]).map(|end| U16::new(end as u16));
        clips.push_staying_text(if is_fallback { text.as_fallback_of(locale) } else { text }, ends);
        Some(())
    }

    /// Returns the position of the source record of the clip in a slot.
    fn source(&self, slot: u32) -> Option<SourceOnDisk> {
        let Some(sources) = &self.sources else { return Some(SourceOnDisk::default()) };
        let place = sources.record(slot)?;
        let (start, end) = (place.start - self.sources_start, place.end - self.sources_start);
        let hash = hash(self.bytes.get(place)?) as u32;
        Some(SourceOnDisk { start: start as u32, end: end as u32, hash })
    }
}
