//! The pools of names and of source records.

use super::limits::{fit, too_large};
use crate::clip::Clip;
use crate::locales::localise::LocalisedTexts;
use foldhash::{HashMap, HashMapExt}; // seeded differently in each process; the order of entries is never used
use lipz_diagnostics::Report;
use lipz_layout::U32;

/// The position of a name in the pool of names.
#[derive(Clone, Copy)]
pub(super) struct NamePlace {
    pub(super) offset_bytes: u32,
    pub(super) length_bytes: u16,
}

/// Keys and locale tags.
pub(super) struct NamePool {
    pub(super) pool: String,
    /// The position of each clip's key.
    pub(super) keys: Vec<NamePlace>,
    /// The position of each locale's tag.
    pub(super) tags: Vec<NamePlace>,
}

/// Returns the pool of names: sorted keys, then tags.
pub(super) fn names(clips: &[Clip<'_>], localised: &LocalisedTexts) -> Result<NamePool, Report> {
    let mut pool = String::new();
    let mut place = |name: &str| {
        let offset_bytes = fit(pool.len(), "names")?;
        pool.push_str(name);
        let length_bytes = u16::try_from(name.len()).map_err(|_| too_large("names"))?;
        Ok(NamePlace { offset_bytes, length_bytes })
    };
    let keys = clips.iter().map(|clip| place(clip.key())).collect::<Result<_, _>>()?;
    let tags = localised.locales.iter().map(|locale| place(&locale.tag)).collect::<Result<_, _>>()?;
    Ok(NamePool { pool, keys, tags })
}

/// The positions of the source records.
pub(super) struct Sources {
    /// One offset per slot.
    pub(super) index: Vec<U32>,
    /// The length of the pool in bytes.
    pub(super) length: usize,
}

/// The position of each clip's source record. Equal records are stored once. Clips are sorted by key.
pub(super) struct SourceRecordOffsets {
    length: usize,
    /// If an offset does not fit, the check of the length detects it.
    offsets: Vec<u32>,
}

/// Collects the source records.
pub(super) fn own_sources<'c>(clips: &[Clip<'c>]) -> SourceRecordOffsets {
    let (mut length, mut known) = (0, HashMap::with_capacity(clips.len() / 2));
    // In an object, equal records share one position, so that they need not be read to detect this.
    let mut by_place = HashMap::new();
    let offset = |clip: &Clip<'c>| {
        let source = clip.hashed_source();
        let place = source.bytes.place();
        if let Some(&offset) = place.as_ref().and_then(|place| by_place.get(place)) {
            return offset;
        }
        let source_length = source.bytes.length();
        let offset = *known.entry(source).or_insert(length);
        // Existing records start before the end.
        if offset == length {
            length += source_length;
        }
        by_place.extend(place.map(|place| (place, offset as u32)));
        offset as u32
    };
    let offsets = clips.iter().map(offset).collect();
    SourceRecordOffsets { length, offsets }
}

/// Returns the source index.
pub(super) fn sources(interned: &SourceRecordOffsets, slots: &[u32]) -> Result<Sources, Report> {
    fit(interned.length, "sources")?;
    let mut index = vec![U32::new(0); slots.len()];
    for (&offset, &slot) in std::iter::zip(&interned.offsets, slots) {
        index[slot as usize] = offset.into();
    }
    Ok(Sources { index, length: interned.length })
}
