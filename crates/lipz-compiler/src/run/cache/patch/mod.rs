//! A new bank made from the old one, for small changes in few clips.
//!
//! Keys, segments, events, rates and locales are those of the old bank, and so is most of the new one: it is copied,
//! and changed frames and texts are inserted. The result is, byte for byte, the bank that would be made from all clips.
//! If that is not certain, no bank is made. For example, texts that several clips share are stored only once.
//!
//! The copied data was verified before the old bank was written. Copying proves that it still has its checksum. New
//! data is compared with the clips that it was made from.

mod change;
mod file;
mod splice;
#[cfg(test)]
mod tests;

use super::old_bank::section;
use super::recall::{Recall, table};
use crate::clip::Clip;
use change::{ChangedClip, TextChange};
use file::{NewSections, file};
use lipz_bank::Bank;
use lipz_layout::{ClipRecord, FLAG_VISEMES, NO_TEXT, TEXT_OFFSET, Tag, U32};
use memchr::memmem;
use splice::Splices;
use zerocopy::FromBytes;

/// The most clips that may have changed, because each is searched for among all records and starts.
const MOST_CLIPS: usize = 32;

/// The most changed texts, because each is searched for in the whole pool.
const MOST_TEXTS: usize = 32;

/// The most positions of a text that are examined before all clips are searched instead.
const MOST_PLACES: usize = 64;

/// Returns the bank in which the `changed` clips are new, and all others come from the old bank, which has the same
/// keys; `None` if it must be made from all clips. It is made in `room`, whose contents are overwritten.
pub(super) fn patched(recall: &Recall<'_>, changed: &[Clip<'_>], room: Vec<u8>) -> Option<Vec<u8>> {
    let has_other = [Tag::LAYER, Tag::EXPORT].into_iter().any(|tag| table(recall, tag).is_some());
    let is_plain = recall.bank.voices().next().is_none() && !has_other && changed.len() <= MOST_CLIPS;
    let changes: Vec<ChangedClip<'_>> = changed
        .iter()
        .filter(|_| is_plain)
        .map(|clip| ChangedClip::new(recall, clip))
        .collect::<Option<_>>()
        .filter(|changes: &Vec<_>| !changes.is_empty())?;
    let texts: Vec<&TextChange> = changes.iter().flat_map(|change| &change.texts).collect();
    if texts.iter().filter(|text| text.is_new).count() > MOST_TEXTS {
        return None;
    }
    let (mut frame_splices, mut text_splices) = (Splices::default(), Splices::default());
    for change in &changes {
        frame_splices.add(change.old_frames.clone(), change.clip.frames().bytes().into_owned());
        let new_texts = change.texts.iter().filter(|text| text.is_new);
        new_texts.for_each(|text| text_splices.add(text.old.clone(), text.bytes.clone()));
    }
    frame_splices.finish()?;
    text_splices.finish()?;
    let records = |table: &mut [u8]| records(<[_]>::mut_from_bytes(table).ok()?, &changes, &frame_splices);
    let starts = |table: &mut [u8]| starts(<[_]>::mut_from_bytes(table).ok()?, &changes, &frame_splices);
    let text_starts = |table: &mut [u8]| {
        text_starts(<[_]>::mut_from_bytes(table).ok()?, recall.segment_count, &changes, &text_splices)
    };
    let bank = file(
        recall.old,
        &NewSections {
            tables: [(Tag::CLIPS, &records), (Tag::STARTS, &starts), (Tag::TEXT_STARTS, &text_starts)],
            spliced: [(Tag::FRAMES, &frame_splices), (Tag::TEXTS, &text_splices)],
        },
        room,
    )?;
    let in_bank = |tag: Tag| bank.get(section(&bank, tag)?);
    let (pool, starts) = (in_bank(Tag::TEXTS)?, <[U32]>::ref_from_bytes(in_bank(Tag::TEXT_STARTS)?).ok()?);
    let mut new_texts = texts.iter().filter(|text| text.is_new);
    let stand_alone = new_texts.all(|text| stands_alone(text, &text_splices, starts, pool));
    (stand_alone && recall.is_whole() && changes.iter().all(|change| is_there(&bank, change.clip))).then_some(bank)
}

/// Updates the records of all clips.
fn records(records: &mut [ClipRecord], changes: &[ChangedClip<'_>], frames: &Splices) -> Option<()> {
    for change in changes {
        let record = records.get_mut(change.slot as usize)?;
        record.frame_count = u32::try_from(change.clip.frame_count()).ok()?.into();
        record.viseme_type = change.clip.viseme_type().map_or(0, |viseme_type| viseme_type as u8);
        record.flags = if change.clip.has_visemes() { FLAG_VISEMES } else { 0 };
    }
    for (slot, record) in (0..).zip(records) {
        let offset = record.frames_offset_bytes.get() as usize;
        let is_changed = changes.iter().any(|change| change.slot == slot);
        let moved = if is_changed { frames.start(offset) } else { frames.moved(offset) };
        record.frames_offset_bytes = u32::try_from(moved?).ok()?.into();
    }
    Some(())
}

/// Updates the first frames of all segments, and the end of the last.
fn starts(starts: &mut [U32], changes: &[ChangedClip<'_>], frames: &Splices) -> Option<()> {
    let is_changed = |number: usize| changes.iter().any(|change| change.segments.contains(&number));
    for (_, start) in starts.iter_mut().enumerate().filter(|(number, _)| !is_changed(*number)) {
        *start = u32::try_from(frames.moved(start.get() as usize)?).ok()?.into();
    }
    for change in changes {
        let first = u32::try_from(frames.start(change.old_frames.start)?).ok()?;
        let own = std::iter::zip(starts.get_mut(change.segments.clone())?, change.clip.starts());
        own.for_each(|(start, in_clip)| *start = (first + in_clip).into());
    }
    Some(())
}

/// Updates the starts of all texts, for this number of segments in each locale, and the length of the pool.
fn text_starts(starts: &mut [U32], count: usize, changes: &[ChangedClip<'_>], texts: &Splices) -> Option<()> {
    let (pool_end, of_locales) = starts.split_last_mut()?;
    let length = texts.length(pool_end.get() as usize).filter(|length| *length <= TEXT_OFFSET as usize)?;
    *pool_end = u32::try_from(length).ok()?.into();
    for of_locale in of_locales.chunks_mut(count.max(1)) {
        let mut next = 0;
        let mut own: Vec<_> = changes.iter().map(|change| change.segments.clone()).collect();
        own.sort_unstable_by_key(|segments| segments.start);
        for segments in own.into_iter().chain(std::iter::once(count..count)) {
            for start in of_locale.get_mut(next..segments.start)?.iter_mut().filter(|start| start.get() != NO_TEXT) {
                let offset = (start.get() & TEXT_OFFSET) as usize;
                let moved = u32::try_from(texts.moved(offset)?).ok()?;
                *start = (start.get() & !TEXT_OFFSET | moved).into();
            }
            next = segments.end;
        }
    }
    for change in changes {
        for text in &change.texts {
            let first =
                u32::try_from(if text.is_new { texts.start(text.old.start)? } else { texts.moved(text.old.start)? });
            let first = first.ok()?;
            let segment = change.segments.start;
            for (locale, flag) in &text.locales {
                let own = starts.get_mut(locale * count + segment..)?;
                std::iter::zip(own, &text.entries).for_each(|(start, entry)| *start = ((first + entry) | flag).into());
            }
        }
    }
    Some(())
}

/// Whether no other clip can have the same text in the new bank, which would then be stored only once.
fn stands_alone(text: &TextChange, splices: &Splices, starts: &[U32], pool: &[u8]) -> bool {
    let own = splices.start(text.old.start);
    let is_start =
        |at: usize| starts.iter().any(|start| start.get() != NO_TEXT && (start.get() & TEXT_OFFSET) as usize == at);
    // With and without a count.
    [text.bytes.as_slice(), &text.other_form()].into_iter().all(|bytes| {
        let places: Vec<usize> = places(pool, bytes).take(MOST_PLACES).filter(|at| Some(*at) != own).collect();
        places.len() + 1 < MOST_PLACES && !places.into_iter().any(is_start)
    })
}

/// Returns the positions of `bytes` in the pool, including overlapping ones: a text may start within the end of
/// another.
fn places<'p>(pool: &'p [u8], bytes: &'p [u8]) -> impl Iterator<Item = usize> + 'p {
    let finder = memmem::Finder::new(bytes);
    let mut next = 0;
    std::iter::from_fn(move || {
        let at = next + finder.find(pool.get(next..)?)?;
        next = at + 1;
        Some(at)
    })
}

/// Whether the reader finds the checked clip in the bank.
fn is_there(bank: &[u8], clip: &Clip<'_>) -> bool {
    let Ok(bank) = Bank::open(bank) else { return false };
    let Some(found) = bank.clip_by_key(clip.key()) else { return false };
    let has_text = |(index, text)| {
        let Some(locale) = bank.locale(clip.tag(text)) else { return false };
        let texts = clip.displays(index).bytes();
        let mut texts: &[u8] = &texts;
        let are_same = found.segments().all(|segment| {
            let shown = segment.text_bytes(locale);
            let rest = shown.and_then(|shown| texts.strip_prefix(shown));
            rest.map(|rest| texts = rest).is_some()
        });
        are_same && texts.is_empty()
    };
    found.frames() == &*clip.frames().bytes()
        && found.viseme_type() == clip.viseme_type()
        && found.segments().map(|segment| segment.start_frame()).eq(clip.starts().iter().copied())
        && clip.texts().iter().enumerate().all(has_text)
}
