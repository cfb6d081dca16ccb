//! The texts: their starts in the pool, and their bytes.

use super::limits::too_large;
use super::numbering::Numbering;
use super::text_placement::{TextPlacement, places};
use crate::clip::{Clip, ClipText, Part};
use crate::locales::dubs::Dubs;
use crate::locales::localise::{LocalisedTexts, TextSubstitute};
use crate::util::parallel;
use lipz_diagnostics::Report;
use lipz_layout::{NO_TEXT, TEXT_COUNT_BYTES, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_OFFSET, U16, U32, text_count};
use std::iter::zip;

/// The positions of the texts.
#[derive(Default)]
pub(super) struct TextOffsets {
    /// One entry per segment for each locale, then the length of the pool.
    pub(super) starts: Vec<U32>,
    /// The length in bytes of each locale's part of the pool. The parts are consecutive.
    pub(super) lengths: Vec<usize>,
}

/// Lays out the texts of all locales. Those of each locale are consecutive, in the order of the segments' numbers.
pub(super) fn texts(
    clips: &[Clip<'_>],
    localised: &LocalisedTexts,
    dubs: &Dubs,
    numbering: &Numbering,
) -> Result<TextOffsets, Report> {
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
            // This gives each run a distinct start.
            let is_counted = is_shown_elsewhere || text.is_empty();
            (locale, TextRun { stands_apart, ..TextRun::new(text, ends, Displays::Of(clip, index), is_counted) })
        })
    };
    let tables = zip(starts.chunks_mut(table_length), &mut lengths);
    let mut columns: Vec<TextColumn<'_>> = tables.map(|(starts, length)| TextColumn { starts, length }).collect();
    // Each thread makes one pass over the clips for all of its locales.
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
    Ok(TextOffsets { starts, lengths })
}

/// Returns for each locale and clip whether a different locale or a dub also shows the clip's texts; empty if none
/// does.
fn shown_elsewhere(clip_count: usize, localised: &LocalisedTexts, dubs: &Dubs) -> Vec<Vec<bool>> {
    let mut shown = vec![Vec::new(); localised.locales.len()];
    let mut show = |locale: usize, at: usize| {
        let shown: &mut Vec<bool> = &mut shown[locale];
        shown.resize(clip_count, false);
        shown[at] = true;
    };
    for (locale, column) in localised.locales.iter().enumerate() {
        for (at, other) in column.others() {
            match (other, dubs.dub(at)) {
                (TextSubstitute::Fallback(other), _) => show(other as usize, at),
                (TextSubstitute::Original, Some(dub)) => show(locale, dub.original),
                (TextSubstitute::Original, None) => {}
            }
        }
    }
    shown
}

/// Assigns the texts of originals to dubs without texts in a locale.
fn borrow(localised: &LocalisedTexts, dubs: &Dubs, numbering: &Numbering, starts: &mut [U32]) {
    for (locale, column) in localised.locales.iter().enumerate() {
        let first = locale * numbering.segment_count;
        for (at, dub) in dubs.iter().filter(|(at, _)| column.other(*at) == Some(TextSubstitute::Original)) {
            for (own, original) in zip(numbering.segments(at), numbering.segments(dub.original)) {
                starts[first + own] = starts[first + original];
            }
        }
    }
}

/// Assigns texts of the fallback locale to clips without texts in a locale.
fn fall_back(localised: &LocalisedTexts, numbering: &Numbering, starts: &mut [U32]) {
    for (locale, column) in localised.locales.iter().enumerate() {
        for (at, other) in column.others() {
            let TextSubstitute::Fallback(other) = other else { continue };
            for number in numbering.segments(at) {
                let start = starts[other as usize * numbering.segment_count + number];
                starts[locale * numbering.segment_count + number] = start | TEXT_FALLBACK;
            }
        }
    }
}

/// Returns the length of a pool of these parts, if the offsets in it fit their bits.
fn pool_length(lengths: &[usize]) -> Result<u32, Report> {
    let length = lengths.iter().map(|&length| length as u64).sum::<u64>();
    if length > u64::from(TEXT_OFFSET) { Err(too_large("texts")) } else { Ok(length as u32) }
}

/// Returns text starts and pool of one locale, with the texts from `run`.
pub(crate) fn pool_of<'c>(
    numbering: &Numbering,
    run: impl Fn(usize) -> Option<TextRun<'c>>,
) -> Result<(Vec<U32>, Vec<u8>), Report> {
    let mut starts = vec![U32::new(NO_TEXT); numbering.segment_count];
    let mut length = 0;
    let column = TextColumn { starts: &mut starts, length: &mut length };
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

/// The texts of a clip in one locale, before their position is determined.
pub(crate) struct TextRun<'c> {
    /// The end of each text, modulo 2¹⁶.
    ends: &'c [U16],
    displays: Displays<'c>,
    /// Hash of the texts.
    pub(super) hash: u32,
    is_fallback: bool,
    /// Whether the texts are stored separately, as for dubs, so that a reader can identify the own texts of a dub.
    pub(super) stands_apart: bool,
    /// Whether the last text is counted, regardless of the next text.
    is_counted: bool,
}

/// The texts of a run, one after the other.
#[derive(Clone, Copy)]
pub(crate) enum Displays<'c> {
    /// Those of a clip, with this number. They are read on demand, because there are millions.
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

impl<'c> TextRun<'c> {
    /// Creates the run of a text with these ends and texts. The last text is counted if requested, or if something
    /// follows it.
    pub(crate) fn new(text: &ClipText, ends: &'c [U16], displays: Displays<'c>, is_counted: bool) -> TextRun<'c> {
        TextRun { ends, displays, hash: text.hash, is_fallback: text.is_fallback(), stands_apart: false, is_counted }
    }

    /// Whether the texts are the same, segment by segment.
    pub(super) fn is_same(&self, other: &TextRun<'_>) -> bool {
        self.ends == other.ends && self.displays.part() == other.displays.part()
    }

    /// Returns the entry of a text that starts at this offset.
    fn entry(&self, offset: u32) -> U32 {
        U32::new(if self.is_fallback { offset | TEXT_FALLBACK } else { offset })
    }

    /// Writes the entries of texts that follow those before them. Returns the end of the texts.
    fn put_entries(&self, start: usize, is_counted: bool, entries: &mut [U32]) -> usize {
        let mut end = start;
        for (entry, low) in zip(&mut *entries, self.ends) {
            *entry = self.entry(end as u32); // an overflow is detected from the length
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

/// The texts of one locale, before their position is determined.
struct TextColumn<'s> {
    /// The start of the texts of each segment, relative to the locale's part.
    starts: &'s mut [U32],
    /// Their length in bytes.
    length: &'s mut usize,
}

/// Determines the positions of texts in some locales, beginning with the `first`. `runs` returns those of a clip, each
/// with the number of its locale. The texts of a locale are consecutive, in the order of the segments' numbers. Equal
/// texts of different clips are stored once.
///
/// It makes two passes over the clips for any number of locales, because they do not fit into a cache.
fn lay_out<'c, R: Iterator<Item = (usize, TextRun<'c>)>>(
    numbering: &Numbering,
    first: usize,
    runs: impl Fn(usize) -> R,
    columns: &mut [TextColumn<'_>],
) {
    // The numbers of other locales are out of range.
    let runs = |at: usize| runs(at).map(move |(locale, run)| (locale.wrapping_sub(first), run));
    let places = places(numbering, runs, columns.len());
    for (at, clip) in numbering.order().enumerate() {
        let own = numbering.segments(clip);
        for (number, run) in runs(clip) {
            let Some((column, places)) = columns.get_mut(number).zip(places.get(number)) else { continue };
            if let TextPlacement::As(same) = places[at] {
                let same = numbering.segments(numbering.clip(same as usize));
                for (own, same) in zip(own.clone(), same) {
                    column.starts[own] = run.entry(column.starts[same].get() & !TEXT_FALLBACK);
                }
                continue;
            }
            let is_followed = matches!(places.get(at + 1), Some(TextPlacement::Next | TextPlacement::NextForOthers));
            let is_counted = run.is_counted || matches!(places[at], TextPlacement::NextForOthers) || !is_followed;
            *column.length = run.put_entries(*column.length, is_counted, &mut column.starts[own.clone()]);
        }
    }
}

/// Copies the texts of a clip with these `starts` to their part of the pool, which begins at `part_start`.
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

    /// Returns starts and pool of clips with these texts in one locale. A different locale also shows those of the
    /// second clip.
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
            Some(TextRun::new(text, ends, Displays::Of(clips[at], 0), at == 1 || text.is_empty()))
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
            Some(TextRun { ends: &ends, displays, hash: 7, is_fallback: false, stands_apart: false, is_counted: false })
        };
        let numbering = Numbering::new(texts.iter().map(|_| (false, 1)));
        let (starts, pool) = pool_of(&numbering, run).ok().unwrap();
        let offsets: Vec<u32> = starts.iter().map(|start| start.get() & TEXT_OFFSET).collect();
        assert_eq!(pool, b"\0\0\x01a\0\0\x01b\0\0\x01c");
        assert_eq!(offsets, [0, 4, 8, 4, 8, 0, 12]);
    }
}
