//! The changes of one clip.

use crate::clip::Clip;
use crate::run::cache::old_bank::Window;
use crate::run::cache::recall::Recall;
use lipz_layout::{NO_TEXT, TEXT_COUNT_BYTES, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_OFFSET, counted_length, text_count};
use std::ops::Range;

/// A clip that may differ from that in the old bank.
pub(super) struct ChangedClip<'c> {
    pub(super) clip: &'c Clip<'c>,
    pub(super) slot: u32,
    /// Numbers of its segments.
    pub(super) segments: Range<usize>,
    /// The range of its old frames in their section.
    pub(super) old_frames: Range<usize>,
    pub(super) texts: Vec<TextChange>,
}

/// The texts of a clip in a locale.
pub(super) struct TextChange {
    /// The numbers of the locale and of those that fall back to it, each with the flag of its entries.
    pub(super) locales: Vec<(usize, u32)>,
    /// Their old range in the pool.
    pub(super) old: Range<usize>,
    /// Their new bytes in the pool.
    pub(super) bytes: Vec<u8>,
    /// The entry of each segment, relative to the first one.
    pub(super) entries: Vec<u32>,
    /// Whether they have changed.
    pub(super) is_new: bool,
}

impl<'c> ChangedClip<'c> {
    /// Returns the changes of `clip`; `None` if more than frames and texts have changed.
    pub(super) fn new(recall: &Recall<'_>, clip: &'c Clip<'c>) -> Option<ChangedClip<'c>> {
        let found = recall.bank.clip_by_key(clip.key())?;
        let slot = found.slot();
        let record = recall.records.get(slot as usize)?;
        let segment_count = clip.starts().len();
        let old_events = found.segments().map(|segment| segment.event());
        let has_same_events = match clip.events() {
            Some(events) => found.has_events() && old_events.eq(events.map(Some)),
            None => !found.has_events(),
        };
        let has_curves = clip.has_curves() || found.curves().next().is_some();
        let has_phones = !clip.phones().is_empty() || !found.phones().is_empty();
        let is_alike = found.fps() == clip.fps() && found.segment_count() as usize == segment_count;
        let has_frames = found.frame_count() > 0 && clip.frame_count() > 0;
        if !has_same_events || has_curves || has_phones || !is_alike || !has_frames {
            return None;
        }
        let has_same_source = match &recall.sources {
            Some(sources) => {
                let mut window = Window::default();
                recall.old.bytes(sources.record(slot)?, &mut window, 1)? == &*clip.source().bytes()
            }
            None => clip.source().length() == 0,
        };
        let (first, frames) = (record.segments_first.get() as usize, record.frames_offset_bytes.get() as usize);
        let mut change = ChangedClip {
            clip,
            slot,
            segments: first..first + segment_count,
            old_frames: frames..frames + found.frame_count() as usize,
            texts: Vec::new(),
        };
        change.add_texts(recall)?;
        has_same_source.then_some(change)
    }

    /// Adds the texts of all locales; `None` if the locales have changed.
    fn add_texts(&mut self, recall: &Recall<'_>) -> Option<()> {
        let clip = self.clip;
        let entries = |number: usize| {
            let first = number * recall.segment_count + self.segments.start;
            recall.text_starts.get(first..=first + self.segments.len())
        };
        let first_of = |number: usize| Some(entries(number)?.first()?.get());
        let (mut texts, mut fallbacks): (Vec<TextChange>, _) = (Vec::new(), Vec::new());
        for (number, locale) in recall.locales.iter().enumerate() {
            let index = clip.texts().iter().position(|text| clip.tag(text) == recall.bank.locale_tag(*locale));
            match (first_of(number)?, index) {
                (NO_TEXT, None) => {}
                (start, None) if start & TEXT_FALLBACK != 0 => fallbacks.push((number, start & TEXT_OFFSET)),
                (start, Some(index))
                    if start != NO_TEXT && start & TEXT_FALLBACK == 0 && !clip.texts()[index].is_fallback() =>
                {
                    texts.push(TextChange::new(recall, number, entries(number)?, clip, index)?);
                }
                _ => return None,
            }
        }
        for (number, start) in fallbacks {
            let own = texts.iter_mut().find(|text| text.old.start == start as usize)?;
            own.locales.push((number, TEXT_FALLBACK));
        }
        self.texts = texts;
        let own_count = self.texts.len();
        (own_count == clip.texts().len()).then_some(())
    }
}

impl TextChange {
    /// Returns one of the texts of a clip, in the locale with this number and with these old entries, the last of which
    /// belongs to the next clip.
    fn new(
        recall: &Recall<'_>,
        locale: usize,
        old_entries: &[lipz_layout::U32],
        clip: &Clip<'_>,
        index: usize,
    ) -> Option<TextChange> {
        let offset = |entry: &lipz_layout::U32| (entry.get() & TEXT_OFFSET) as usize;
        let ([first, ..], [own @ .., next]) = (old_entries, old_entries) else { return None };
        let last = own.last()?;
        let mut window = Window::default();
        let mut pool = |range: Range<usize>| {
            let range = recall.texts.start + range.start..recall.texts.start + range.end;
            recall.old.bytes(range, &mut window, 1).map(<[u8]>::to_vec)
        };
        // Determine the end like the reader: from the next entry, or from the count before the last text.
        let is_counted = last.get() & TEXT_HAS_LENGTH != 0;
        let (old_length, end) = if is_counted {
            let behind = offset(last) + TEXT_COUNT_BYTES;
            let end = behind + counted_length(&pool(offset(last)..behind)?);
            (end.checked_sub(offset(first) + TEXT_COUNT_BYTES)?, end)
        } else {
            (offset(next).checked_sub(offset(first))?, offset(next))
        };
        let (ends, texts) = (clip.text_ends(index), clip.displays(index).bytes());
        // If all texts are empty, or were, a different count determines the bytes.
        if old_length == 0 || texts.is_empty() {
            return None;
        }
        let mut start = 0;
        let mut entries = Vec::with_capacity(ends.len());
        for low in ends {
            entries.push(start);
            start += u32::from(low.get().wrapping_sub(start as u16));
        }
        let last_start = *entries.last()? as usize;
        let mut bytes = texts.to_vec();
        if is_counted {
            bytes.splice(last_start..last_start, text_count(texts.len() - last_start));
            *entries.last_mut()? |= TEXT_HAS_LENGTH;
        }
        let old = offset(first)..end;
        let old_relative = own.iter().map(|entry| entry.get().wrapping_sub(old.start as u32));
        let is_new = pool(old.clone())? != bytes || !old_relative.eq(entries.iter().copied());
        Some(TextChange { locales: vec![(locale, 0)], old, bytes, entries, is_new })
    }

    /// Returns the texts without the count before the last one, or with it if they have none.
    pub(super) fn other_form(&self) -> Vec<u8> {
        let mut bytes = self.bytes.clone();
        let last = self.entries.last().copied().unwrap_or_default();
        let start = (last & TEXT_OFFSET) as usize;
        if last & TEXT_HAS_LENGTH != 0 {
            bytes.drain(start..start + TEXT_COUNT_BYTES);
        } else {
            bytes.splice(start..start, text_count(self.bytes.len() - start));
        }
        bytes
    }
}
