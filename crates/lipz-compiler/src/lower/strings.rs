//! The pools: names, and the places of texts and source records in theirs.

use super::records::ClipRecords;
use super::{fit, too_large};
use crate::Report;
use crate::clip::Clip;
use crate::hashed::{Hashed, hash};
use crate::localise::{Choice, LocaleColumn, Localised};
use foldhash::{HashMap, HashMapExt}; // seeded anew in each process: the order of entries is never used
use lipz_bank::layout::{NO_TEXT, TEXT_FALLBACK, TEXT_OFFSET, TEXT_WIDE, U16, U32};
use rayon::prelude::*;

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

/// Byte strings of which equal ones stand once in a pool. The pool is not made: only the places in it.
struct Interner<'c> {
    length: usize,
    offsets: HashMap<Hashed<'c>, usize>,
}

impl<'c> Interner<'c> {
    fn with_capacity(count: usize) -> Self {
        Interner { length: 0, offsets: HashMap::with_capacity(count) }
    }

    /// The offset of `string` in the pool.
    fn place(&mut self, string: Hashed<'c>) -> usize {
        let (next, length) = (self.length, string.bytes.len());
        let offset = *self.offsets.entry(string).or_insert(next);
        // Strings that are known lie before the end. One of no bytes has a place of its own, too.
        if offset == next {
            self.length += length.max(1);
        }
        offset
    }
}

/// Where the texts are.
pub(super) struct TextIndex {
    /// Locale by locale, one entry per slot.
    pub(super) entries: Vec<U32>,
    /// Bytes of each locale's part of the pool; the parts follow each other.
    pub(super) lengths: Vec<usize>,
}

/// What one interner has placed: bytes of its part of a pool, and the entry of each clip as if that part
/// were the pool. An offset that does not fit is found by the length.
pub(super) struct Interned {
    length: usize,
    entries: Vec<u32>,
}

/// Each locale's texts, in the order of the keys; those of clips that have the same stand once in a locale.
pub(super) fn locale_texts(clips: &[Clip<'_>], localised: &Localised) -> Vec<Interned> {
    localised.locales.par_iter().map(|locale| own_texts(clips, locale)).collect()
}

/// The own texts of a locale.
fn own_texts(clips: &[Clip<'_>], locale: &LocaleColumn) -> Interned {
    let mut interner = Interner::with_capacity(clips.len());
    let entries = std::iter::zip(clips, &locale.texts).map(|(clip, choice)| match choice {
        Choice::Own(index) => {
            let text = &clip.texts()[*index as usize];
            let (_, texts) = clip.run(text);
            let flags = if texts.len() > usize::from(u16::MAX) { TEXT_WIDE } else { 0 }
                | if text.is_fallback { TEXT_FALLBACK } else { 0 };
            interner.place(Hashed { hash: text.hash, bytes: texts }) as u32 | flags
        }
        _ => NO_TEXT,
    });
    let entries = entries.collect();
    Interned { length: interner.length, entries }
}

/// The text index: each locale's texts stand together.
pub(super) fn text_index(parts: &[Interned], localised: &Localised, slots: &[u32]) -> Result<TextIndex, Report> {
    let lengths: Vec<usize> = parts.iter().map(|part| part.length).collect();
    if lengths.iter().sum::<usize>() >= TEXT_OFFSET as usize {
        return Err(too_large("texts"));
    }
    let bases: Vec<u32> = lengths
        .iter()
        .scan(0, |end, length| {
            let base = *end;
            *end += length;
            Some(base as u32)
        })
        .collect();
    let entry = |locale: usize, at: usize| match parts[locale].entries[at] {
        NO_TEXT => NO_TEXT,
        entry => entry + bases[locale],
    };
    let mut entries = vec![U32::new(NO_TEXT); parts.len() * slots.len()];
    let tables = entries.par_chunks_mut(slots.len().max(1)).zip(&localised.locales).enumerate();
    tables.for_each(|(locale, (table, column))| {
        for (at, choice) in column.texts.iter().enumerate() {
            table[slots[at] as usize] = U32::new(match *choice {
                Choice::Own(_) => entry(locale, at),
                Choice::Fallback(other) => entry(other as usize, at) | TEXT_FALLBACK,
                Choice::Missing => NO_TEXT,
            });
        }
    });
    Ok(TextIndex { entries, lengths })
}

/// The ends of all texts, also of those that are another locale's: so one is found without the clip's
/// text being touched. An entry, then locale by locale one per segment.
pub(super) fn text_ends(localised: &Localised, clips: &[Clip<'_>], slots: &[u32], records: &ClipRecords) -> Vec<U16> {
    let segment_count = records.starts.len() - 1;
    let mut ends = vec![U16::new(0); 1 + localised.locales.len() * segment_count];
    let tables = ends[1..].par_chunks_mut(segment_count.max(1)).zip(&localised.locales);
    tables.for_each(|(table, column)| {
        for (at, (clip, choice)) in std::iter::zip(clips, &column.texts).enumerate() {
            let own = match *choice {
                Choice::Fallback(other) => localised.locales[other as usize].texts[at],
                own => own,
            };
            if let Choice::Own(index) = own {
                let (ends, _) = clip.run(&clip.texts()[index as usize]);
                let first = records.clips[slots[at] as usize].segments_first.get() as usize;
                table[first..first + ends.len()].copy_from_slice(ends);
            }
        }
    });
    ends
}

/// Where the source records are.
pub(super) struct Sources {
    /// One offset per slot.
    pub(super) index: Vec<U32>,
    /// Bytes of the pool.
    pub(super) length: usize,
}

/// The source records in the order of the keys; equal ones stand once.
pub(super) fn own_sources(clips: &[Clip<'_>]) -> Interned {
    let mut interner = Interner::with_capacity(clips.len() / 2);
    let hashed = |bytes| Hashed { hash: hash(bytes), bytes };
    let entries = clips.iter().map(|clip| interner.place(hashed(clip.source())) as u32).collect();
    Interned { length: interner.length, entries }
}

/// The source index.
pub(super) fn sources(interned: &Interned, slots: &[u32]) -> Result<Sources, Report> {
    fit(interned.length, "sources")?;
    let mut index = vec![U32::new(0); slots.len()];
    for (&entry, &slot) in std::iter::zip(&interned.entries, slots) {
        index[slot as usize] = entry.into();
    }
    Ok(Sources { index, length: interned.length })
}
