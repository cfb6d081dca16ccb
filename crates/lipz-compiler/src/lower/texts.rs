//! The texts: where each starts in the pool, and the bytes there.

use super::numbering::Numbering;
use super::places::{Place, places};
use super::too_large;
use crate::clip::{Clip, ClipText, Part};
use crate::dubs::Dubs;
use crate::localise::{Localised, Other};
use crate::parallel;
use lipz_diagnostics::Report;
use lipz_layout::{NO_TEXT, TEXT_COUNT_BYTES, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_OFFSET, U16, U32, text_count};
use std::iter::zip;

/// Where the texts are.
#[derive(Default)]
pub(super) struct Texts {
    /// Locale by locale one entry per segment, and the length of the pool.
    pub(super) starts: Vec<U32>,
    /// Bytes of each locale's part of the pool; the parts follow each other.
    pub(super) lengths: Vec<usize>,
}

/// The texts of all locales. Each locale's stand together, in the order of the segments' numbers.
pub(super) fn texts(
    clips: &[Clip<'_>],
    localised: &Localised,
    dubs: &Dubs,
    numbering: &Numbering,
) -> Result<Texts, Report> {
    let (count, segment_count) = (localised.locales.len(), numbering.segment_count);
    let mut starts = vec![U32::new(NO_TEXT); count * segment_count + 1];
    let mut lengths = vec![0; count];
    let table_length = segment_count.max(1);
    let shown_elsewhere = shown_elsewhere(clips.len(), localised, dubs);
    let runs = |at: usize| {
        let (clip, stands_apart, shown_elsewhere) = (clips[at], dubs.dub(at).is_some(), &shown_elsewhere);
        clip.texts_with_ends().enumerate().map(move |(index, (text, ends))| {
            let locale = text.locale as usize;
            let is_shown_elsewhere = shown_elsewhere[locale].get(at).is_some_and(|is_shown| *is_shown);
            // So that every run has a start of its own.
            let is_counted = is_shown_elsewhere || text.is_empty();
            (locale, Run { stands_apart, ..Run::new(text, ends, Displays::Of(clip, index), is_counted) })
        })
    };
    let tables = zip(starts.chunks_mut(table_length), &mut lengths);
    let mut columns: Vec<Column<'_>> = tables.map(|(starts, length)| Column { starts, length }).collect();
    // Each thread goes through the clips once, for all of its locales.
    let at_once = count.div_ceil(parallel::thread_count()).max(1);
    parallel::for_each(columns.chunks_mut(at_once).enumerate().collect(), |(part, columns): (usize, &mut [_])| {
        lay_out(numbering, part * at_once, runs, columns);
    });
    let pool_length = pool_length(&lengths)?;
    let bases = lengths.iter().scan(0, |end, length| Some(std::mem::replace(end, *end + *length as u32)));
    parallel::for_each(zip(starts.chunks_mut(table_length), bases).collect(), |(table, base): (&mut [U32], u32)| {
        table.iter_mut().filter(|start| start.get() != NO_TEXT).for_each(|start| *start += base);
    });
    borrow(localised, dubs, numbering, &mut starts);
    fall_back(localised, numbering, &mut starts);
    starts[count * segment_count] = pool_length.into();
    Ok(Texts { starts, lengths })
}

/// For each locale and clip, whether another locale or a dub shows the clip's texts, too; for no clip where none does.
fn shown_elsewhere(clip_count: usize, localised: &Localised, dubs: &Dubs) -> Vec<Vec<bool>> {
    let mut shown = vec![Vec::new(); localised.locales.len()];
    let mut show = |locale: usize, at: usize| {
        let shown: &mut Vec<bool> = &mut shown[locale];
        shown.resize(clip_count, false);
        shown[at] = true;
    };
    for (locale, column) in localised.locales.iter().enumerate() {
        for (at, other) in column.others() {
            match (other, dubs.dub(at)) {
                (Other::Fallback(other), _) => show(other as usize, at),
                (Other::Original, Some(dub)) => show(locale, dub.original),
                (Other::Original, None) => {}
            }
        }
    }
    shown
}

/// Gives dubs without texts in a locale those of their originals.
fn borrow(localised: &Localised, dubs: &Dubs, numbering: &Numbering, starts: &mut [U32]) {
    for (locale, column) in localised.locales.iter().enumerate() {
        let first = locale * numbering.segment_count;
        for (at, dub) in dubs.iter().filter(|(at, _)| column.other(*at) == Some(Other::Original)) {
            for (own, original) in zip(numbering.segments(at), numbering.segments(dub.original)) {
                starts[first + own] = starts[first + original];
            }
        }
    }
}

/// Gives a clip without texts in a locale those of the locale that it falls back to.
fn fall_back(localised: &Localised, numbering: &Numbering, starts: &mut [U32]) {
    for (locale, column) in localised.locales.iter().enumerate() {
        for (at, other) in column.others() {
            let Other::Fallback(other) = other else { continue };
            for number in numbering.segments(at) {
                let start = starts[other as usize * numbering.segment_count + number];
                starts[locale * numbering.segment_count + number] = start | TEXT_FALLBACK;
            }
        }
    }
}

/// The length of a pool of these parts, if the offsets in it fit their bits.
fn pool_length(lengths: &[usize]) -> Result<u32, Report> {
    let length = lengths.iter().map(|&length| length as u64).sum::<u64>();
    if length > u64::from(TEXT_OFFSET) { Err(too_large("texts")) } else { Ok(length as u32) }
}

/// Text starts and pool of one locale, whose texts `run` gives.
pub(crate) fn pool_of<'c>(
    numbering: &Numbering,
    run: impl Fn(usize) -> Option<Run<'c>>,
) -> Result<(Vec<U32>, Vec<u8>), Report> {
    let mut starts = vec![U32::new(NO_TEXT); numbering.segment_count];
    let mut length = 0;
    let column = Column { starts: &mut starts, length: &mut length };
    lay_out(numbering, 0, |at| run(at).map(|run| (0, run)).into_iter(), &mut [column]);
    let length = pool_length(&[length])?;
    let mut pool = vec![0; length as usize];
    for at in numbering.order() {
        let own = &starts[numbering.segments(at)];
        if let Some(run) = run(at) {
            copy(&run.displays.part().bytes(), own, 0, &mut pool);
        }
    }
    starts.push(length.into());
    Ok((starts, pool))
}

/// The texts of a clip in one locale, to be placed.
pub(crate) struct Run<'c> {
    /// Where each text ends, modulo 2¹⁶.
    ends: &'c [U16],
    displays: Displays<'c>,
    /// Hash of the texts.
    pub(super) hash: u32,
    is_fallback: bool,
    /// Whether no other clip shares the texts: those of dubs, so that one sees which texts of a dub are its own.
    pub(super) stands_apart: bool,
    /// Whether the last text is counted, whatever follows it.
    is_counted: bool,
}

/// Where the texts of a run are, one behind the other.
#[derive(Clone, Copy)]
pub(crate) enum Displays<'c> {
    /// Those of a clip with this number, which are looked at when they are needed: there are millions.
    Of(Clip<'c>, usize),
    Here(&'c [u8]),
}

impl<'c> Displays<'c> {
    fn part(self) -> Part<'c> {
        match self {
            Displays::Of(clip, index) => clip.displays(index),
            Displays::Here(displays) => Part::Here(displays),
        }
    }
}

impl<'c> Run<'c> {
    /// The run of a text with these ends and texts. The last of them is counted, at the latest if something follows it.
    pub(crate) fn new(text: &ClipText, ends: &'c [U16], displays: Displays<'c>, is_counted: bool) -> Run<'c> {
        Run { ends, displays, hash: text.hash, is_fallback: text.is_fallback(), stands_apart: false, is_counted }
    }

    /// Whether other texts are the same, segment by segment.
    pub(super) fn is_same(&self, other: &Run<'_>) -> bool {
        self.ends == other.ends && self.displays.part() == other.displays.part()
    }

    /// The entry of a text that starts at this offset.
    fn entry(&self, offset: u32) -> U32 {
        U32::new(if self.is_fallback { offset | TEXT_FALLBACK } else { offset })
    }

    /// Makes the entries of texts that stand behind those so far; returns where they end.
    fn put_entries(&self, start: usize, is_counted: bool, entries: &mut [U32]) -> usize {
        let mut end = start;
        for (entry, low) in zip(&mut *entries, self.ends) {
            *entry = self.entry(end as u32); // too much is found by the length
            end += usize::from(low.get().wrapping_sub((end - start) as u16));
        }
        match entries.last_mut().filter(|_| is_counted) {
            Some(last) => {
                *last |= TEXT_HAS_LENGTH;
                end + TEXT_COUNT_BYTES
            }
            None => end,
        }
    }
}

/// The texts of one locale, to be placed.
struct Column<'s> {
    /// Where the texts of each segment start, as if the pool began with them.
    starts: &'s mut [U32],
    /// Their length in bytes.
    length: &'s mut usize,
}

/// Places the texts that clips have in some locales, from the `first` on. `runs` gives those of a clip, each with the number of its
/// locale. In each locale they stand one behind the other, in the order of the segments' numbers; those of clips that have the same
/// stand once.
///
/// The clips are gone through twice, whatever the number of locales: they take more memory than there is cache.
fn lay_out<'c, R: Iterator<Item = (usize, Run<'c>)>>(
    numbering: &Numbering,
    first: usize,
    runs: impl Fn(usize) -> R,
    columns: &mut [Column<'_>],
) {
    // Other locales have numbers that no column has.
    let runs = |at: usize| runs(at).map(move |(locale, run)| (locale.wrapping_sub(first), run));
    let places = places(numbering, runs, columns.len());
    for (at, clip) in numbering.order().enumerate() {
        let own = numbering.segments(clip);
        for (number, run) in runs(clip) {
            let Some((column, places)) = columns.get_mut(number).zip(places.get(number)) else { continue };
            if let Place::As(same) = places[at] {
                let same = numbering.segments(numbering.clip(same as usize));
                for (own, same) in zip(own.clone(), same) {
                    column.starts[own] = run.entry(column.starts[same].get() & !TEXT_FALLBACK);
                }
                continue;
            }
            let is_followed = matches!(places.get(at + 1), Some(Place::Next | Place::NextForOthers));
            let is_counted = run.is_counted || matches!(places[at], Place::NextForOthers) || !is_followed;
            *column.length = run.put_entries(*column.length, is_counted, &mut column.starts[own.clone()]);
        }
    }
}

/// Copies the texts of a clip that have these `starts` to their part of the pool, which begins at `part_start`.
pub(super) fn copy(texts: &[u8], starts: &[U32], part_start: usize, part: &mut [u8]) {
    let offset = |start: &U32| (start.get() & TEXT_OFFSET) as usize - part_start;
    let (Some(first), Some(last)) = (starts.first(), starts.last()) else { return };
    let (texts, last_text) = texts.split_at(offset(last) - offset(first));
    part[offset(first)..offset(last)].copy_from_slice(texts);
    let mut rest = &mut part[offset(last)..];
    if last.get() & TEXT_HAS_LENGTH != 0 {
        let (count, behind) = rest.split_at_mut(TEXT_COUNT_BYTES);
        count.copy_from_slice(&text_count(last_text.len()));
        rest = behind;
    }
    rest[..last_text.len()].copy_from_slice(last_text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::{ClipData, Clips};

    /// Starts and pool of clips with these texts in one locale; another locale shows those of the second clip, too.
    fn placed(texts: &[&[&str]]) -> (Vec<u32>, Vec<u8>) {
        let mut store = Clips::default();
        let locale = store.locales.number("en-us", true);
        for texts in texts {
            let mut clip = ClipData { starts: vec![0; texts.len().max(1)], ..ClipData::default() };
            if !texts.is_empty() {
                clip.add_texts(locale, texts.iter().map(|text| text.as_bytes()), false);
            }
            store.push("", &clip);
        }
        let clips: Vec<_> = store.iter().collect();
        let numbering = Numbering::new(clips.iter().map(|clip| (false, clip.starts().len() as u32)));
        let run = |at: usize| {
            let (text, ends) = clips[at].texts_with_ends().next()?;
            Some(Run::new(text, ends, Displays::Of(clips[at], 0), at == 1 || text.is_empty()))
        };
        let (mut starts, pool) = pool_of(&numbering, run).ok().unwrap();
        assert_eq!(starts.pop().map(|end| end.get() as usize), Some(pool.len()));
        (starts.iter().map(|start| start.get()).collect(), pool)
    }

    #[test]
    fn last_texts_are_counted_where_something_else_follows() {
        const C: u32 = TEXT_HAS_LENGTH;
        assert_eq!(
            placed(&[&["a", "bc"], &["d"], &["e"]]),
            (vec![0, 1, 3 | C, 7 | C], b"abc\0\0\x01d\0\0\x01e".into())
        );
        let none_between = placed(&[&["a"], &["", "b"], &[], &["c"]]);
        assert_eq!(none_between, (vec![0, 1, 1 | C, NO_TEXT, 5 | C], b"a\0\0\x01b\0\0\x01c".into()));
        let same = placed(&[&["a", "b"], &["c"], &["a", "b"], &["ab"]]);
        let pool = b"a\0\0\x01b\0\0\x01c\0\0\x02ab";
        assert_eq!(same, (vec![0, 1 | C, 5 | C, 0, 1 | C, 9 | C], pool.into()), "other segments are other texts");
        let empty = placed(&[&["", ""], &["x"], &[""]]);
        assert_eq!(empty, (vec![0, C, 3 | C, 7 | C], b"\0\0\0\0\0\x01x\0\0\0".into()));
    }

    #[test]
    fn texts_with_one_hash_are_told_apart() {
        let texts: [&[u8]; 6] = [b"a", b"b", b"c", b"b", b"c", b"a"];
        let ends = [U16::new(1)];
        let run = |at: usize| {
            let displays = Displays::Here(texts[at]);
            Some(Run { ends: &ends, displays, hash: 7, is_fallback: false, stands_apart: false, is_counted: false })
        };
        let numbering = Numbering::new(texts.iter().map(|_| (false, 1)));
        let (starts, pool) = pool_of(&numbering, run).ok().unwrap();
        let offsets: Vec<u32> = starts.iter().map(|start| start.get() & TEXT_OFFSET).collect();
        assert_eq!(pool, b"\0\0\x01a\0\0\x01b\0\0\x01c");
        assert_eq!(offsets, [0, 4, 8, 4, 8, 0, 12]);
    }
}
