//! The data copied from the clips, in the order of the bank.

#[cfg(feature = "shards")]
use super::windows::Windows;
use super::{Output, WriteFault, misplaced};
use crate::bank::lower::Layout;
use crate::clip::{Clip, Clips, Part};
use lipz_layout::{TEXT_HAS_LENGTH, TEXT_OFFSET, Tag, U32, text_count};

/// The parts of clips, which are in memory or stay in files.
pub(super) struct Pieces<'l> {
    layout: &'l Layout,
    batches: &'l [Clips],
    #[cfg(feature = "shards")]
    windows: Windows,
}

impl<'l> Pieces<'l> {
    pub(super) fn new(layout: &'l Layout, batches: &'l [Clips]) -> Pieces<'l> {
        Pieces {
            layout,
            batches,
            #[cfg(feature = "shards")]
            windows: Windows::of(batches.len()),
        }
    }

    /// Writes a section that starts at this offset in the file.
    pub(super) fn copy(&mut self, tag: Tag, start: usize, output: &mut Output<'_>) -> Result<(), WriteFault> {
        match tag {
            Tag::FRAMES => self.frames(start, output),
            Tag::TEXTS => self.texts(start, output),
            _ => self.sources(start, output),
        }
    }

    /// Returns the clips with their batches, in the order of their segments' numbers.
    fn clips(&self) -> impl Iterator<Item = (u32, Clip<'l>)> + use<'l> {
        let batches = self.batches;
        self.layout.order.iter().map(|place| (place.batch, batches[place.batch as usize].clip(place.index)))
    }

    fn frames(&mut self, start: usize, output: &mut Output<'_>) -> Result<(), WriteFault> {
        let mut number = 0;
        for (batch, clip) in self.clips() {
            let offset = self.layout.records.starts[number].get() as usize;
            if start + offset != output.position() {
                return Err(misplaced());
            }
            number += clip.starts().len();
            let (bytes, _) = self.pieces(batch, clip.frames(), usize::MAX);
            output.put(bytes)?;
        }
        Ok(())
    }

    /// Writes the texts, locale by locale. Equal texts share one position, which is filled by the first of them.
    fn texts(&mut self, start: usize, output: &mut Output<'_>) -> Result<(), WriteFault> {
        let layout = self.layout;
        for (locale, table) in (0..).zip(layout.texts.starts.chunks(layout.segment_count.max(1))) {
            let mut number = 0;
            for (batch, clip) in self.clips() {
                let first = number;
                number += clip.starts().len();
                if let Some(index) = clip.text_in(locale) {
                    self.text(batch, clip.displays(index), start, &table[first..number], output)?;
                }
            }
        }
        Ok(())
    }

    /// Writes the texts of a clip at the positions of their entries, unless they have been written.
    fn text(
        &mut self,
        batch: u32,
        texts: Part<'l>,
        section_start: usize,
        entries: &[U32],
        output: &mut Output<'_>,
    ) -> Result<(), WriteFault> {
        let offset = |entry: &U32| (entry.get() & TEXT_OFFSET) as usize;
        let (Some(first), Some(last)) = (entries.first(), entries.last()) else { return Ok(()) };
        if section_start + offset(first) < output.position() {
            return Ok(());
        }
        let inner = offset(last).checked_sub(offset(first)).ok_or_else(misplaced)?;
        let (before, last_text) = self.pieces(batch, texts, inner);
        let mut starts = entries.iter().map(|entry| offset(entry).checked_sub(offset(first)));
        let are_starts = starts.all(|start| start.is_some_and(|start| is_start(before, start)));
        if section_start + offset(first) != output.position() || !are_starts || !is_start(last_text, 0) {
            return Err(misplaced());
        }
        output.put(before)?;
        if last.get() & TEXT_HAS_LENGTH != 0 {
            output.put(&text_count(last_text.len()))?;
        }
        output.put(last_text)?;
        Ok(())
    }

    /// Writes the source records, sorted by the keys of the first clips that have them.
    fn sources(&mut self, start: usize, output: &mut Output<'_>) -> Result<(), WriteFault> {
        let layout = self.layout;
        let mut by_slot = vec![(0, 0); layout.order.len()];
        layout.order.iter().for_each(|place| by_slot[place.slot as usize] = (place.batch, place.index));
        for slot in layout.index.slots.iter().copied() {
            let offset = start + layout.sources.index[slot as usize].get() as usize;
            if offset > output.position() {
                return Err(misplaced());
            }
            if offset == output.position() {
                let (batch, index) = by_slot[slot as usize];
                let part = self.batches[batch as usize].clip(index).source();
                let (bytes, _) = self.pieces(batch, part, usize::MAX);
                output.put(bytes)?;
            }
        }
        Ok(())
    }

    /// Returns the part of a clip of a batch in two pieces: this many bytes, and the rest.
    fn pieces(&mut self, _batch: u32, part: Part<'l>, before: usize) -> (&[u8], &[u8]) {
        match part {
            Part::Here(bytes) => bytes.split_at(before.min(bytes.len())),
            #[cfg(feature = "shards")]
            Part::Stays(part) => self.windows.pieces(_batch as usize, &part, before),
        }
    }
}

/// Whether a character of a UTF-8 string starts at this offset, or the string ends.
fn is_start(text: &[u8], at: usize) -> bool {
    text.get(at).map_or(at == text.len(), |byte| byte & 0xC0 != 0x80)
}
