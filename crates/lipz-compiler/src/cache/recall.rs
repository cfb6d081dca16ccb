//! Clips of the old bank, as the check made them.

use crate::clip::{ClipData, Locales};
use lipz_bank::{Bank, Clip, Locale};
use lipz_layout::{CHECKED_FROM, ClipRecord, Header, NO_TEXT, TEXT_FALLBACK, Tag, U32, checksum};
use zerocopy::FromBytes;

/// The old bank, of which clips are recalled.
pub(super) struct Recall<'b> {
    bank: Bank<'b>,
    locales: Vec<Locale<'b>>,
    records: &'b [ClipRecord],
    /// Locale by locale one entry per segment.
    text_starts: &'b [U32],
    segment_count: usize,
    /// `None` if the bank was stripped.
    sources: Option<Sources<'b>>,
}

struct Sources<'b> {
    /// Where the record of each slot starts.
    index: &'b [U32],
    records: &'b [u8],
    /// Where the record of each slot ends.
    ends: Vec<u32>,
}

/// The checksum in the header of a bank.
pub(super) fn checksum_of(bank: &[u8]) -> Option<u64> {
    Some(Header::ref_from_prefix(bank).ok()?.0.checksum.get())
}

impl<'b> Recall<'b> {
    /// Recalls from the bank with this checksum; `None` if these bytes are not that bank, which was
    /// verified before it was written.
    pub(super) fn new(bank: &'b [u8], expected_checksum: u64) -> Option<Recall<'b>> {
        let checked = bank.get(CHECKED_FROM..)?;
        if checksum_of(bank) != Some(expected_checksum) || checksum(checked) != expected_checksum {
            return None;
        }
        let bank = Bank::open(bank).ok()?;
        let section = |tag: Tag| bank.sections().find(|(found, _)| *found == tag.0).map(|(_, bytes)| bytes);
        let sources = match (section(Tag::SOURCE_INDEX), section(Tag::SOURCES)) {
            (Some(index), Some(records)) => Some(Sources::new(<[U32]>::ref_from_bytes(index).ok()?, records)),
            _ => None,
        };
        Some(Recall {
            locales: bank.locales().collect(),
            records: <[ClipRecord]>::ref_from_bytes(section(Tag::CLIPS)?).ok()?,
            text_starts: <[U32]>::ref_from_bytes(section(Tag::TEXT_STARTS)?).ok()?,
            segment_count: (section(Tag::STARTS)?.len() / size_of::<U32>()).checked_sub(1)?,
            sources,
            bank,
        })
    }

    pub(super) fn clip_count(&self) -> usize {
        self.bank.clip_count()
    }

    /// Makes `clip` the one with this key; `None` if there is none, and `clip` is then of no use.
    pub(super) fn clip(&self, key: &str, locales: &mut Locales, clip: &mut ClipData) -> Option<()> {
        let found = self.bank.clip_by_key(key)?;
        clip.clear();
        clip.fps = found.fps();
        clip.viseme_type = found.viseme_type();
        clip.has_visemes = found.has_visemes();
        clip.frames.extend_from_slice(found.frames());
        clip.starts.extend(found.segments().map(|segment| segment.start_frame()));
        clip.has_events = found.has_events();
        for segment in found.segments().filter(|_| clip.has_events) {
            clip.events.push(segment.event()?);
        }
        found
            .curves()
            .for_each(|curve| clip.curves.push(curve.name().as_str(), curve.keys().map(|key| (key.frame, key.value))));
        self.texts(&found, locales, clip);
        if let Some(sources) = &self.sources {
            clip.source.extend_from_slice(sources.record(found.slot())?);
        }
        Some(())
    }

    /// The clip's own texts, and those of locales that are not packed. The others came from fallback,
    /// which is resolved anew.
    fn texts(&self, found: &Clip<'_, '_>, locales: &mut Locales, clip: &mut ClipData) {
        for (number, &locale) in self.locales.iter().enumerate() {
            let Some(start) = self.text_start(found, number) else { continue };
            let own_start = start & !TEXT_FALLBACK;
            let is_fallback = start != own_start;
            // The texts of a clip in a locale have a start of their own, also where they are empty: what no locale has
            // as its own is of one that is not packed.
            let is_resolved = || (0..self.locales.len()).any(|other| self.text_start(found, other) == Some(own_start));
            if !(is_fallback && is_resolved()) {
                let texts = found.segments().map(|segment| segment.text_bytes(locale).unwrap_or_default());
                clip.add_texts(locales.number(locale.tag(), false), texts, is_fallback);
            }
        }
    }

    /// Where the first text of a clip starts in the locale with this number.
    fn text_start(&self, clip: &Clip<'_, '_>, locale: usize) -> Option<u32> {
        let first = self.records.get(clip.slot() as usize)?.segments_first.get() as usize;
        let start = self.text_starts.get(locale * self.segment_count + first)?.get();
        (start != NO_TEXT).then_some(start)
    }
}

impl<'b> Sources<'b> {
    /// A record ends where the next one starts.
    fn new(index: &'b [U32], records: &'b [u8]) -> Sources<'b> {
        let mut starts: Vec<(u32, usize)> = std::iter::zip(index.iter().map(|start| start.get()), 0..).collect();
        starts.sort_unstable();
        let mut ends = vec![0; index.len()];
        let mut end = records.len() as u32;
        for equal in starts.chunk_by(|(a, _), (b, _)| a == b).rev() {
            equal.iter().for_each(|(_, slot)| ends[*slot] = end);
            end = equal[0].0;
        }
        Sources { index, records, ends }
    }

    /// The record of the clip in this slot.
    fn record(&self, slot: u32) -> Option<&'b [u8]> {
        let slot = slot as usize;
        self.records.get(self.index.get(slot)?.get() as usize..*self.ends.get(slot)? as usize)
    }
}
