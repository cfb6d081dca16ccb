//! Checks voices and dubs.

use super::{dubs, tags};
use crate::verify::error_in;
use crate::{Bank, Error, ErrorKind};
use lipz_layout::{DUB_OF, NO_DUB, OTHER_DUB, U32};

/// Checks both sections, if the bank has them.
pub(crate) fn check(bank: &Bank<'_>) -> Result<(), Error> {
    let (tags, table) = (tags(&bank.file), dubs(&bank.file));
    let voice_count = tags_of(bank, tags)?;
    let tables = voice_count.saturating_sub(1);
    // There are at least two voices, because the original alone needs no section.
    if tables == 0 && bank.file.entry(lipz_layout::Tag::VOICES).is_some()
        || Some(table.len()) != tables.checked_mul(bank.clips.len())
    {
        return Err(error_in(&bank.file, ErrorKind::Voice, table));
    }
    // Each table has an entry for each clip, and if there is a table, there are clips.
    let clip_count = bank.clips.len();
    let mut rest = table;
    while let (Some(voice), false) = (rest.get(..clip_count), rest.is_empty()) {
        for (slot, entry) in (0..).zip(voice) {
            if !is_valid(bank, voice, slot, entry.get()) {
                return Err(error_in(&bank.file, ErrorKind::Voice, entry));
            }
        }
        rest = rest.get(clip_count..).unwrap_or(&[]);
    }
    for slot in 0..clip_count {
        one_original(bank, table, slot)?;
    }
    Ok(())
}

/// Checks that a clip is a dub in at most one voice, and then has no entries in the others.
fn one_original(bank: &Bank<'_>, table: &[U32], slot: usize) -> Result<(), Error> {
    let mut before: Option<u32> = None;
    let mut at = slot;
    while let Some(entry) = table.get(at) {
        if entry.get() != NO_DUB {
            if before.map_or(false, |before| (before | entry.get()) & DUB_OF != 0) {
                return Err(error_in(&bank.file, ErrorKind::Voice, entry));
            }
            before = Some(entry.get());
        }
        at = at.saturating_add(bank.clips.len());
    }
    Ok(())
}

/// Checks the tags: the original's, then the others, which ascend strictly. Returns their number.
fn tags_of(bank: &Bank<'_>, mut tags: &[u8]) -> Result<usize, Error> {
    let mut before: Option<(&[u8], &[u8])> = None;
    let mut count = 0_usize;
    while !tags.is_empty() {
        let wrong = error_in(&bank.file, ErrorKind::Voice, tags);
        let end = tags.iter().position(|byte| *byte == 0).ok_or(wrong)?;
        let tag = tags.get(..end).unwrap_or(&[]);
        let is_in_order = before.map_or(true, |(original, before)| tag != original && (count < 2 || tag > before));
        if tag.is_empty() || !is_in_order || core::str::from_utf8(tag).is_err() {
            return Err(wrong);
        }
        before = Some((before.map_or(tag, |(original, _)| original), tag));
        tags = tags.get(end.wrapping_add(1)..).unwrap_or(&[]);
        count = count.wrapping_add(1);
    }
    Ok(count)
}

/// Whether an entry of the table of a voice leads to another clip with as many segments, and that clip refers back if
/// it is the voice's own dub.
fn is_valid(bank: &Bank<'_>, voice: &[U32], slot: u32, entry: u32) -> bool {
    if entry == NO_DUB {
        return true;
    }
    let other = entry & !(DUB_OF | OTHER_DUB);
    let leads_back = |back: u32| voice.get(other as usize).map_or(false, |entry| entry.get() == back);
    let segment_count = |slot: u32| bank.keys.get(slot as usize).map(|record| record.segment_count.get());
    let is_paired = match (entry & DUB_OF != 0, entry & OTHER_DUB != 0) {
        (false, false) => leads_back(slot | DUB_OF),
        (true, false) => leads_back(slot),
        (false, true) => true,
        (true, true) => false,
    };
    is_paired && other != slot && segment_count(other).is_some() && segment_count(other) == segment_count(slot)
}
