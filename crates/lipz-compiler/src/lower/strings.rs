//! The pools of names and of source records.

use super::{fit, too_large};
use crate::clip::Clip;
use crate::localise::Localised;
use foldhash::{HashMap, HashMapExt}; // seeded anew in each process: the order of entries is never used
use lipz_diagnostics::Report;
use lipz_layout::U32;

/// Where a name stands in the pool of names.
#[derive(Clone, Copy)]
pub(super) struct NamePlace {
    pub(super) offset_bytes: u32,
    pub(super) length_bytes: u16,
}

/// Keys and locale tags.
pub(super) struct Names {
    pub(super) pool: String,
    /// Place of each clip's key.
    pub(super) keys: Vec<NamePlace>,
    /// Place of each locale's tag.
    pub(super) tags: Vec<NamePlace>,
}

/// The pool of names: keys in their order, then tags.
pub(super) fn names(clips: &[Clip<'_>], localised: &Localised) -> Result<Names, Report> {
    let mut pool = String::new();
    let mut place = |name: &str| {
        let offset_bytes = fit(pool.len(), "names")?;
        pool.push_str(name);
        let length_bytes = u16::try_from(name.len()).map_err(|_| too_large("names"))?;
        Ok(NamePlace { offset_bytes, length_bytes })
    };
    let keys = clips.iter().map(|clip| place(clip.key())).collect::<Result<_, _>>()?;
    let tags = localised.locales.iter().map(|locale| place(&locale.tag)).collect::<Result<_, _>>()?;
    Ok(Names { pool, keys, tags })
}

/// Where the source records are.
pub(super) struct Sources {
    /// One offset per slot.
    pub(super) index: Vec<U32>,
    /// Bytes of the pool.
    pub(super) length: usize,
}

/// Where each clip's source record is; equal ones stand once. Clips are in the order of their keys.
pub(super) struct Interned {
    length: usize,
    /// An offset that does not fit is found by the length.
    offsets: Vec<u32>,
}

/// The source records.
pub(super) fn own_sources<'c>(clips: &[Clip<'c>]) -> Interned {
    let (mut length, mut known) = (0, HashMap::with_capacity(clips.len() / 2));
    // Equal ones have one place in an object: they are not read once more to find that out.
    let mut by_place = HashMap::new();
    let offset = |clip: &Clip<'c>| {
        let source = clip.hashed_source();
        let place = source.bytes.place();
        if let Some(&offset) = place.as_ref().and_then(|place| by_place.get(place)) {
            return offset;
        }
        let source_length = source.bytes.length();
        let offset = *known.entry(source).or_insert(length);
        // Records that are known lie before the end.
        if offset == length {
            length += source_length;
        }
        by_place.extend(place.map(|place| (place, offset as u32)));
        offset as u32
    };
    let offsets = clips.iter().map(offset).collect();
    Interned { length, offsets }
}

/// The source index.
pub(super) fn sources(interned: &Interned, slots: &[u32]) -> Result<Sources, Report> {
    fit(interned.length, "sources")?;
    let mut index = vec![U32::new(0); slots.len()];
    for (&offset, &slot) in std::iter::zip(&interned.offsets, slots) {
        index[slot as usize] = offset.into();
    }
    Ok(Sources { index, length: interned.length })
}
