//! The section of a layer.

use super::limits::{fit, too_large};
use lipz_diagnostics::Report;
use lipz_layout::{LayerDubRecord, LayerRecord, PART_CLIP, PART_TEXTS, U32, U64, filter_place};
use zerocopy::IntoBytes;

/// The statements of a layer about the banks below it, before its clips have slots.
#[derive(Default)]
pub(crate) struct LayerDraft {
    /// Checksums of the banks below it, from the lowest up.
    pub(crate) bases: Vec<u64>,
    /// Ids of removed clips, ascending.
    pub(crate) removed: Vec<u64>,
    /// For each locale, the number of its stand-in in the banks below, or `NO_STAND_IN`; or empty.
    pub(crate) stand_ins: Vec<u32>,
    /// For each clip, in the order of the keys, the parts that the layer contains.
    pub(crate) parts: Vec<u8>,
    /// Tags of removed locales, ascending.
    pub(crate) removed_locales: Vec<String>,
    /// Changes of dubs, sorted by id.
    pub(crate) dubs: Vec<LayerDubRecord>,
    /// Pairs of clips and locales, by index, that use the texts of originals.
    pub(crate) borrowed: Vec<(usize, usize)>,
    /// Tags of voices, with that of the originals first.
    pub(crate) voices: Vec<String>,
    /// Bits of `LAYER_FLAGS`.
    pub(crate) flags: u32,
}

impl LayerDraft {
    /// Returns the section. The slots are those of the clips with these ids, sorted by key.
    pub(super) fn section(&self, ids: &[u64], slots: &[u32]) -> Result<Vec<u8>, Report> {
        // If all clips are whole, no table is needed.
        let has_parts = self.parts.iter().any(|&parts| parts != PART_CLIP | PART_TEXTS);
        let mut parts = vec![0; if has_parts { slots.len() } else { 0 }];
        for (&slot, &of_clip) in std::iter::zip(slots, &self.parts) {
            if let Some(part) = parts.get_mut(slot as usize) {
                *part = of_clip;
            }
        }
        let filter = self.filter(ids);
        let place = |(clip, locale): &(usize, usize)| Some(u64::from(*slots.get(*clip)?) << 32 | *locale as u64);
        let mut borrowed: Vec<u64> = self.borrowed.iter().filter_map(place).collect();
        borrowed.sort_unstable();
        let record = LayerRecord {
            base_count: fit(self.bases.len(), "layers")?.into(),
            removed_count: fit(self.removed.len(), "removed clips")?.into(),
            stand_in_count: fit(self.stand_ins.len(), "locales")?.into(),
            part_count: fit(parts.len(), "clips")?.into(),
            removed_locale_count: fit(self.removed_locales.len(), "locales")?.into(),
            flags: self.flags.into(),
            filter_count: fit(filter.len(), "ids")?.into(),
            dub_count: fit(self.dubs.len(), "dubs")?.into(),
            borrowed_count: fit(borrowed.len(), "texts of dubs")?.into(),
            voice_count: fit(self.voices.len(), "voices")?.into(),
        };
        let numbers = |numbers: &[u64]| numbers.iter().map(|&number| U64::new(number)).collect::<Vec<_>>();
        let mut section = record.as_bytes().to_vec();
        section.extend_from_slice(numbers(&self.bases).as_bytes());
        section.extend_from_slice(numbers(&filter).as_bytes());
        section.extend_from_slice(numbers(&self.removed).as_bytes());
        section.extend_from_slice(self.dubs.as_bytes());
        section.extend_from_slice(numbers(&borrowed).as_bytes());
        section.extend(self.stand_ins.iter().flat_map(|&stand_in| U32::new(stand_in).to_bytes()));
        section.extend_from_slice(&parts);
        for tag in self.voices.iter().chain(&self.removed_locales) {
            section.push(u8::try_from(tag.len()).map_err(|_| too_large("tags of locales"))?);
            section.extend_from_slice(tag.as_bytes());
        }
        Ok(section)
    }

    /// Returns a filter for the ids in the layer.
    fn filter(&self, ids: &[u64]) -> Vec<u64> {
        let bits = (ids.len() + self.removed.len()) * FILTER_BITS;
        let mut words = vec![0; bits.div_ceil(64).next_power_of_two().max(LEAST_FILTER_WORDS)];
        for &id in ids.iter().chain(&self.removed) {
            let (word, bit) = filter_place(id, words.len());
            words[word] |= 1 << bit;
        }
        words
    }
}

/// The bits of a filter per id, before rounding up. The filter stops fifteen out of sixteen ids that are not in the
/// layer.
const FILTER_BITS: usize = 16;
/// The words of the smallest filter, which fill the cache line that is read anyway.
const LEAST_FILTER_WORDS: usize = 8;
