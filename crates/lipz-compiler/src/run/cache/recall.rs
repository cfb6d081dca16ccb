//! Clips of the old bank, as the check produced them.

use super::old_bank::{OldBank, Window, section};
use crate::bank::source_index::SourceIndex;
use crate::clip::{ClipData, Locales};
use lipz_bank::{Bank, Clip, Locale};
use lipz_layout::{
    ClipRecord, Header, NO_TEXT, TEXT_COUNT_BYTES, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_OFFSET, Tag, U32,
    counted_length,
};
use std::ops::{Range, RangeInclusive};
use zerocopy::FromBytes;

/// The old bank from which clips are recalled.
pub(super) struct Recall<'b> {
    pub(super) old: &'b OldBank,
    pub(super) bank: Bank<'b>,
    pub(super) locales: Vec<Locale>,
    pub(super) records: &'b [ClipRecord],
    /// One entry per segment for each locale.
    pub(super) text_starts: &'b [U32],
    pub(super) segment_count: usize,
    /// The ranges of the frames of all clips, and of the texts.
    pub(super) frames: Range<usize>,
    pub(super) texts: Range<usize>,
    /// `None` if the bank was stripped.
    pub(super) sources: Option<SourceIndex<'b>>,
}

/// The state of a thread that recalls clips.
pub(super) struct Recaller<'r, 'b> {
    recall: &'r Recall<'b>,
    /// The numbers of the bank's locales among those of the clips.
    locales: Vec<u32>,
    /// The windows on the frames, on the source records, and on the texts of each locale.
    frames: Window,
    sources: Window,
    texts: Vec<Window>,
    /// The length of a window in bytes.
    at_once: usize,
}

/// The total length of a thread's windows in bytes, which many locales share.
const WINDOWS_BYTES: usize = 1 << 20;
/// The length of a window in bytes.
const WINDOW_BYTES: RangeInclusive<usize> = 1 << 9..=1 << 16;

/// Returns the checksum in the header of a bank.
pub(super) fn checksum_of(bank: &[u8]) -> Option<u64> {
    Some(Header::ref_from_prefix(bank).ok()?.0.checksum.get())
}

/// Sets `clip` to the found one, without frames, texts and source record; `None` if an event is damaged.
pub(crate) fn recall_tables(found: &Clip<'_>, clip: &mut ClipData) -> Option<()> {
    clip.clear();
    clip.fps = found.fps();
    clip.viseme_type = found.viseme_type();
    clip.has_visemes = found.has_visemes();
    clip.starts.extend(found.segments().map(|segment| segment.start_frame()));
    clip.has_events = found.has_events();
    for segment in found.segments().filter(|_| clip.has_events) {
        clip.events.push(segment.event()?);
    }
    found
        .curves()
        .for_each(|curve| clip.curves.push(curve.name().as_str(), curve.keys().map(|key| (key.frame, key.value))));
    clip.phones.recall(found);
    Some(())
}

/// Returns a section of the old bank that is guaranteed to be in memory.
pub(super) fn table<'b>(recall: &Recall<'b>, tag: Tag) -> Option<&'b [u8]> {
    let tables = recall.old.tables();
    tables.get(section(tables, tag)?)
}

/// Whether the entries of a clip's texts are as the compiler makes them: consecutive, with at most the last one
/// counted. Readers look up one text at a time, so that [`Bank::verify`] accepts other orders as well.
pub(crate) fn are_in_order(entries: &[U32]) -> bool {
    entries.array_windows().all(|[entry, next]| {
        let length = (next.get() & TEXT_OFFSET).checked_sub(entry.get() & TEXT_OFFSET);
        entry.get() & TEXT_HAS_LENGTH == 0 && length.is_some_and(|length| u16::try_from(length).is_ok())
    })
}

impl<'b> Recall<'b> {
    /// Recalls from this bank; `None` if it cannot be opened. Recalled data is trusted only after the bank has been
    /// proven to be the one that was verified before it was written.
    pub(super) fn new(old: &'b OldBank) -> Option<Recall<'b>> {
        let tables = old.tables();
        let bank = Bank::open(tables).ok()?;
        let table = |tag: Tag| tables.get(section(tables, tag)?);
        let sources = match (table(Tag::SOURCE_INDEX), section(tables, Tag::SOURCES)) {
            (Some(index), Some(records)) => Some(SourceIndex::new(<[U32]>::ref_from_bytes(index).ok()?, records)),
            _ => None,
        };
        Some(Recall {
            old,
            locales: bank.locales().collect(),
            records: <[ClipRecord]>::ref_from_bytes(table(Tag::CLIPS)?).ok()?,
            text_starts: <[U32]>::ref_from_bytes(table(Tag::TEXT_STARTS)?).ok()?,
            segment_count: (table(Tag::STARTS)?.len() / size_of::<U32>()).checked_sub(1)?,
            frames: section(tables, Tag::FRAMES)?,
            texts: section(tables, Tag::TEXTS)?,
            sources,
            bank,
        })
    }

    /// Whether the recalled data belongs to the old bank, because the file has not been modified since.
    pub(super) fn is_whole(&self) -> bool {
        self.old.is_as_it_was()
    }

    /// Returns the slot of the clip with this key.
    pub(super) fn slot(&self, key: &str) -> Option<u32> {
        self.bank.clip_by_key(key).map(|clip| clip.slot())
    }

    /// Returns a sort key for the order of clips in the bank, which is that of frames and texts.
    pub(super) fn place(&self, slot: u32) -> u32 {
        self.records.get(slot as usize).map_or(0, |record| record.segments_first.get())
    }

    /// Returns a recaller for clips whose texts refer to these locales.
    pub(super) fn recaller(&self, locales: &mut Locales) -> Recaller<'_, 'b> {
        Recaller {
            recall: self,
            locales: self.locales.iter().map(|locale| locales.number(self.bank.locale_tag(*locale), false)).collect(),
            frames: Window::default(),
            sources: Window::default(),
            texts: self.locales.iter().map(|_| Window::default()).collect(),
            at_once: (WINDOWS_BYTES / self.locales.len().max(1)).clamp(*WINDOW_BYTES.start(), *WINDOW_BYTES.end()),
        }
    }

    /// Returns the start of the first text of a clip in the locale with this number.
    fn text_start(&self, clip: &Clip<'_>, locale: usize) -> Option<u32> {
        let start = self.entries(clip, locale)?.first()?.get();
        (start != NO_TEXT).then_some(start)
    }

    /// Returns the entries of a clip's texts in the locale with this number, and the next entry.
    fn entries(&self, clip: &Clip<'_>, locale: usize) -> Option<&'b [U32]> {
        let first = locale * self.segment_count + self.records.get(clip.slot() as usize)?.segments_first.get() as usize;
        self.text_starts.get(first..=first + clip.segment_count() as usize)
    }
}

impl Recaller<'_, '_> {
    /// Sets `clip` to the clip in this slot. Returns `None` if the slot has no usable clip; `clip` is then unusable.
    pub(super) fn clip(&mut self, slot: u32, clip: &mut ClipData) -> Option<()> {
        let recall = self.recall;
        let found = recall.bank.clip_at(slot)?;
        recall_tables(&found, clip)?;
        let start = recall.frames.start + recall.records.get(slot as usize)?.frames_offset_bytes.get() as usize;
        let frames = start..start + found.frame_count() as usize;
        clip.frames.extend_from_slice(recall.old.bytes(frames, &mut self.frames, self.at_once)?);
        self.texts(&found, clip)?;
        if let Some(sources) = &recall.sources {
            let record = recall.old.bytes(sources.record(slot)?, &mut self.sources, self.at_once)?;
            clip.source.extend_from_slice(record);
        }
        Some(())
    }

    /// Recalls the clip's own texts, and those of unpacked locales. The others come from fallback, or from the original
    /// of a dub. Both are resolved again.
    fn texts(&mut self, found: &Clip<'_>, clip: &mut ClipData) -> Option<()> {
        let recall = self.recall;
        let original = found.original();
        for (number, &locale) in self.locales.iter().enumerate() {
            let Some(start) = recall.text_start(found, number) else { continue };
            // A dub's own texts have separate starts.
            if original.is_some_and(|original| recall.text_start(&original, number) == Some(start)) {
                continue;
            }
            let own_start = start & !TEXT_FALLBACK;
            let is_fallback = start != own_start;
            // The texts of a clip in a locale have a separate start even if they are empty. Texts that belong to no
            // locale come from one that is not packed.
            let is_resolved =
                || (0..self.locales.len()).any(|other| recall.text_start(found, other) == Some(own_start));
            if is_fallback && is_resolved() {
                continue;
            }
            let (window, at_once) = (self.texts.get_mut(number)?, self.at_once);
            let entries = recall.entries(found, number)?;
            let offset = |entry: &U32| (entry.get() & TEXT_OFFSET) as usize;
            let ([first, ..], [own @ .., next]) = (entries, entries) else { continue };
            if !are_in_order(own) {
                return None;
            }
            let Some(last) = own.last() else { continue };
            let range = |start: usize, end: usize| recall.texts.start + start..recall.texts.start + end;
            // Determine the end like the reader: from the next entry, or from the count before the last text.
            let (last_start, end) = if last.get() & TEXT_HAS_LENGTH == 0 {
                (offset(last), offset(next))
            } else {
                let start = offset(last) + TEXT_COUNT_BYTES;
                let count = recall.old.bytes(range(offset(last), start), window, at_once)?;
                (start, start + counted_length(count))
            };
            let first = offset(first);
            let texts = recall.old.bytes(range(first, end), window, at_once)?;
            let inner = entries.array_windows().map(|[entry, next]| (offset(entry), offset(next)));
            let places = inner.take(entries.len() - 2).chain([(last_start, end)]);
            let texts = places.map(|(start, end)| texts.get(start - first..end - first).unwrap_or_default());
            clip.add_texts(locale, texts, is_fallback);
        }
        Some(())
    }
}
