//! The pools: names, texts, event strings, source records.

use super::{fit, too_large};
use crate::Report;
use crate::clip::{ClipData, TextRun};
use crate::localise::{Choice, LocaleColumn, Localised};
use lipz_bank::layout::{EventRecord, NO_EVENTS, NO_TEXT, TEXT_FALLBACK, TEXT_OFFSET, TEXT_WIDE, U32};
use rayon::prelude::*;
use std::collections::HashMap;
use std::hash::Hash;

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
pub(super) fn names(clips: &[ClipData], localised: &Localised) -> Result<Names, Report> {
    let mut pool = String::new();
    let mut place = |name: &str| {
        let offset_bytes = fit(pool.len(), "names")?;
        pool.push_str(name);
        let length_bytes = u16::try_from(name.len()).map_err(|_| too_large("names"))?;
        Ok(NamePlace { offset_bytes, length_bytes })
    };
    let keys = clips.iter().map(|clip| place(&clip.key)).collect::<Result<_, _>>()?;
    let tags = localised.locales.iter().map(|locale| place(&locale.tag)).collect::<Result<_, _>>()?;
    Ok(Names { pool, keys, tags })
}

/// A pool of byte strings in which equal ones stand once.
struct Interner<T> {
    pool: Vec<u8>,
    offsets: HashMap<T, usize>,
}

impl<T: AsRef<[u8]> + Hash + Eq> Interner<T> {
    fn new() -> Self {
        Interner { pool: Vec::new(), offsets: HashMap::new() }
    }

    fn place(&mut self, string: T) -> usize {
        let offset = self.pool.len();
        match self.offsets.entry(string) {
            std::collections::hash_map::Entry::Occupied(known) => *known.get(),
            std::collections::hash_map::Entry::Vacant(new) => {
                self.pool.extend_from_slice(new.key().as_ref());
                *new.insert(offset)
            }
        }
    }
}

/// The text index and the text pool.
pub(super) struct Texts {
    /// Locale by locale, one entry per slot.
    pub(super) index: Vec<U32>,
    pub(super) pool: Vec<u8>,
}

/// The texts of one locale: its part of the pool, and the place in it of each clip's own text.
struct LocaleTexts {
    pool: Vec<u8>,
    offsets: Vec<Option<usize>>,
}

/// Each locale's texts stand together, in the order of the keys; a run that appears twice in a
/// locale stands once.
pub(super) fn texts(clips: &[ClipData], localised: &Localised, slots: &[u32]) -> Result<Texts, Report> {
    let parts: Vec<LocaleTexts> = localised.locales.par_iter().map(|locale| locale_texts(clips, locale)).collect();
    let mut pool = Vec::with_capacity(parts.iter().map(|part| part.pool.len()).sum());
    let mut bases = Vec::with_capacity(parts.len());
    for part in &parts {
        bases.push(pool.len());
        pool.extend_from_slice(&part.pool);
    }
    if pool.len() > TEXT_OFFSET as usize {
        return Err(too_large("texts"));
    }
    let entry = |locale: usize, at: usize| -> Option<u32> {
        let offset = parts.get(locale)?.offsets.get(at).copied().flatten()?;
        let tag = localised.locales[locale].tag.as_str();
        let run = &clips[at].texts.iter().find(|text| *text.locale == *tag)?.run;
        let offset = u32::try_from(bases[locale] + offset).ok()?;
        Some(offset | if run.is_wide { TEXT_WIDE } else { 0 })
    };
    let mut index = vec![U32::new(NO_TEXT); localised.locales.len() * clips.len()];
    for (locale, column) in localised.locales.iter().enumerate() {
        let start = locale * clips.len();
        for (at, choice) in column.texts.iter().enumerate() {
            let value = match *choice {
                Choice::Own(_) => entry(locale, at),
                Choice::Fallback(other) => entry(other, at).map(|entry| entry | TEXT_FALLBACK),
                Choice::Missing => None,
            };
            index[start + slots[at] as usize] = U32::new(value.unwrap_or(NO_TEXT));
        }
    }
    Ok(Texts { index, pool })
}

fn locale_texts(clips: &[ClipData], locale: &LocaleColumn) -> LocaleTexts {
    let mut interner: Interner<&TextRun> = Interner::new();
    let offsets = std::iter::zip(clips, &locale.texts).map(|(clip, choice)| match choice {
        Choice::Own(index) => clip.texts.get(*index).map(|text| interner.place(&text.run)),
        _ => None,
    });
    let offsets = offsets.collect();
    LocaleTexts { pool: interner.pool, offsets }
}

/// Event references, records and strings.
pub(super) struct Events {
    /// Index of each clip's first reference, or `NO_EVENTS`.
    pub(super) first: Vec<u32>,
    pub(super) references: Vec<U32>,
    pub(super) records: Vec<EventRecord>,
    pub(super) pool: String,
}

/// Numbers the distinct event strings in the order of their first use.
pub(super) fn events(clips: &[ClipData]) -> Result<Events, Report> {
    let mut events = Events {
        first: Vec::with_capacity(clips.len()),
        references: Vec::new(),
        records: Vec::new(),
        pool: String::new(),
    };
    let mut numbers: HashMap<&str, u32> = HashMap::new();
    for clip in clips {
        events.first.push(match clip.events {
            Some(_) => fit(events.references.len(), "events")?,
            None => NO_EVENTS,
        });
        for event in clip.events.iter().flatten() {
            let next = fit(events.records.len(), "events")?;
            let number = *numbers.entry(event).or_insert(next);
            if number == next {
                events.records.push(EventRecord {
                    offset_bytes: fit(events.pool.len(), "events")?.into(),
                    length_bytes: fit(event.len(), "events")?.into(),
                });
                events.pool.push_str(event);
            }
            events.references.push(number.into());
        }
    }
    Ok(events)
}

/// The source index and the source records.
pub(super) struct Sources {
    /// One offset per slot.
    pub(super) index: Vec<U32>,
    pub(super) pool: Vec<u8>,
}

/// Equal source records stand once.
pub(super) fn sources(clips: &[ClipData], slots: &[u32]) -> Result<Sources, Report> {
    let mut interner: Interner<&[u8]> = Interner::new();
    let mut index = vec![U32::new(0); clips.len()];
    for (clip, &slot) in std::iter::zip(clips, slots) {
        index[slot as usize] = fit(interner.place(&clip.source), "sources")?.into();
    }
    Ok(Sources { index, pool: interner.pool })
}

impl AsRef<[u8]> for TextRun {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}
