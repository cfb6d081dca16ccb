//! Clip records, in the order of their keys, and what they own.

use super::error_at;
use super::strings::Strings;
use super::texts::TextCheck;
use crate::clip::key;
use crate::layout::{ClipRecord, FLAG_FAR_STARTS, FLAG_VISEMES, NO_EVENTS};
use crate::segment::{far_starts, segment_count, start_frame};
use crate::{Bank, ClipId, Error, ErrorKind, Fps, VisemeType};

/// What stands in a clip record in place of a start that the clip does not have.
const UNUSED_START: u16 = 0xFFFF;
/// Entries of a clip record that lead to far starts.
const FAR_ENTRIES: usize = 2;

/// Where the parts of the clips so far end in their sections.
#[derive(Default)]
struct Ends {
    frames: u32,
    starts: usize,
    event_refs: u32,
}

/// Checks every clip with its texts; returns where the keys end in the pool of names.
///
/// Keys that ascend strictly are distinct, so the order table, which has as many entries as there
/// are clips, names every clip once.
pub(super) fn clips(bank: &Bank<'_>) -> Result<u32, Error> {
    let mut ends = Ends::default();
    let mut texts = TextCheck::of(&bank.file, &bank.texts);
    let mut keys = Strings::of(bank.texts.names, 0);
    for entry in bank.key_order {
        let slot = entry.get();
        let record = bank.clips.get(slot as usize).ok_or(error_at(bank, ErrorKind::ClipOrder, entry))?;
        let failed = |kind| error_at(bank, kind, record);
        let key = key(bank, record).filter(|key| !key.is_empty()).ok_or(failed(ErrorKind::ClipKey))?;
        if !keys.ascends(key) {
            return Err(error_at(bank, ErrorKind::ClipOrder, entry));
        }
        if bank.record(ClipId::from_u64(record.id.get())).map(|(slot, _)| slot) != Some(slot) {
            return Err(failed(ErrorKind::ClipIndex));
        }
        let follows = keys.follows(record.key_offset_bytes.get(), u32::from(record.key_length_bytes.get()));
        if !follows || ClipId::of(key).get() != record.id.get() {
            return Err(failed(ErrorKind::ClipKey));
        }
        let segment_count = contents(bank, record, &mut ends).map_err(failed)?;
        texts.clip(slot as usize, segment_count)?;
    }
    if ends.frames as usize != bank.frames.len() {
        return Err(error_at(bank, ErrorKind::FrameRange, bank.frames));
    }
    if ends.starts != bank.starts.len() {
        return Err(error_at(bank, ErrorKind::SegmentStarts, bank.starts));
    }
    if ends.event_refs as usize != bank.event_refs.len() {
        return Err(error_at(bank, ErrorKind::EventReference, bank.event_refs));
    }
    Ok(keys.end())
}

/// Checks what a clip record says of frames and segments; returns how many those are.
fn contents(bank: &Bank<'_>, record: &ClipRecord, ends: &mut Ends) -> Result<u32, ErrorKind> {
    let viseme_type = VisemeType::from_u8(record.viseme_type);
    if record.flags & !(FLAG_VISEMES | FLAG_FAR_STARTS) != 0
        || (record.viseme_type != 0 && viseme_type.is_none())
        || (record.flags & FLAG_VISEMES == 0 && record.frame_count.get() != 0)
    {
        return Err(ErrorKind::ClipFlags);
    }
    if !frame_rate_is_valid(record) {
        return Err(ErrorKind::FrameRate);
    }
    let start = record.frames_offset_bytes.get();
    let end = start.checked_add(record.frame_count.get()).ok_or(ErrorKind::FrameRange)?;
    let frames = bank.frames.get(start as usize..end as usize).ok_or(ErrorKind::FrameRange)?;
    if start != ends.frames {
        return Err(ErrorKind::FrameRange);
    }
    ends.frames = end;
    let may_be = |kind: &VisemeType| viseme_type.map_or(true, |own| own == *kind) && kind.contains_all(frames);
    if !VisemeType::ALL.iter().any(may_be) {
        return Err(ErrorKind::FrameCode);
    }
    let segment_count = segment_count(bank, record);
    if !starts_are_valid(bank, record, segment_count, ends) {
        return Err(ErrorKind::SegmentStarts);
    }
    let events_first = record.events_first.get();
    if events_first != NO_EVENTS {
        if events_first != ends.event_refs {
            return Err(ErrorKind::EventReference);
        }
        // Far starts have an entry a segment, inline ones nine at most: the sum fits 32 bits.
        ends.event_refs = ends.event_refs.wrapping_add(segment_count);
    }
    Ok(segment_count)
}

fn frame_rate_is_valid(record: &ClipRecord) -> bool {
    let (numerator, denominator) = (record.fps_numerator.get(), record.fps_denominator.get());
    let reciprocal = record.frames_per_micro_q64.get();
    match denominator {
        0 => numerator == 0 && reciprocal == 0,
        _ => Fps::from_parts(numerator, denominator, reciprocal).is_valid(),
    }
}

/// Starts exist, do not decrease and do not pass the end; unused ones are 0xFFFF.
fn starts_are_valid(bank: &Bank<'_>, record: &ClipRecord, count: u32, ends: &mut Ends) -> bool {
    let used = (count as usize).wrapping_sub(1);
    let frame_count = record.frame_count.get();
    let (used_entries, is_in_place) = match far_starts(record) {
        None => (used, frame_count <= u32::from(UNUSED_START)),
        Some(first) => {
            let before = core::mem::replace(&mut ends.starts, first.wrapping_add(used));
            (FAR_ENTRIES, first == before)
        }
    };
    // The reader clamps the count that a damaged record says.
    let count_is_valid = count != 0 && count == record.segment_count.get();
    if !count_is_valid
        || !is_in_place
        || record.starts.iter().skip(used_entries).any(|start| start.get() != UNUSED_START)
    {
        return false;
    }
    let mut before = 0;
    for index in 0..count {
        match start_frame(bank, record, index) {
            Some(start) if start >= before => before = start,
            _ => return false,
        }
    }
    before <= frame_count
}
