//! Clip records, in the order of their keys, and what they own.

use super::error_at;
use super::texts::TextCheck;
use crate::layout::{self, FLAG_FAR_STARTS, FLAG_VISEMES};
use crate::segment::far_starts;
use crate::{Bank, Clip, ClipId, Error, ErrorKind, VisemeType};

/// Where the parts of the clips so far end in their sections.
#[derive(Default)]
struct Ends {
    names: u32,
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
    let mut texts = TextCheck::of(bank.file, bank.texts);
    let mut before: Option<&str> = None;
    for slot in bank.key_order {
        let clip = bank.clip_at(slot.get()).ok_or(error_at(bank, ErrorKind::ClipOrder, slot))?;
        let key = clip.checked_key().ok_or(error_at(bank, ErrorKind::ClipKey, clip.record))?;
        if Some(key) <= before {
            return Err(error_at(bank, ErrorKind::ClipOrder, slot));
        }
        before = Some(key);
        clip_record(bank, &clip, key, &mut ends).map_err(|kind| error_at(bank, kind, clip.record))?;
        texts.clip(&clip)?;
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
    Ok(ends.names)
}

/// Checks one clip record.
fn clip_record(bank: &Bank<'_>, clip: &Clip<'_, '_>, key: &str, ends: &mut Ends) -> Result<(), ErrorKind> {
    let record = clip.record;
    if bank.record(clip.id()).map(|(slot, _)| slot) != Some(clip.slot()) {
        return Err(ErrorKind::ClipIndex);
    }
    if key.is_empty() || record.key_offset_bytes.get() != ends.names || ClipId::of(key) != clip.id() {
        return Err(ErrorKind::ClipKey);
    }
    ends.names = ends.names.wrapping_add(key.len() as u32);
    if record.flags & !(FLAG_VISEMES | FLAG_FAR_STARTS) != 0
        || (record.viseme_type != 0 && clip.viseme_type().is_none())
        || (record.flags & FLAG_VISEMES == 0 && record.frame_count.get() != 0)
    {
        return Err(ErrorKind::ClipFlags);
    }
    frame_rate(clip)?;
    if record.frames_offset_bytes.get() != ends.frames {
        return Err(ErrorKind::FrameRange);
    }
    ends.frames = ends.frames.wrapping_add(record.frame_count.get());
    frame_codes(clip)?;
    segment_starts(bank, clip, ends)?;
    if clip.has_events() {
        if record.events_first.get() != ends.event_refs {
            return Err(ErrorKind::EventReference);
        }
        // Far starts have an entry a segment, inline ones nine at most: the sum fits 32 bits.
        ends.event_refs = ends.event_refs.wrapping_add(clip.segment_count());
    }
    Ok(())
}

fn frame_rate(clip: &Clip<'_, '_>) -> Result<(), ErrorKind> {
    let record = clip.record;
    let valid = match clip.fps() {
        Some(fps) => fps.is_valid(),
        None => record.fps_numerator.get() == 0 && record.frames_per_micro_q64.get() == 0,
    };
    valid.then_some(()).ok_or(ErrorKind::FrameRate)
}

fn frame_codes(clip: &Clip<'_, '_>) -> Result<(), ErrorKind> {
    let frames = clip.frames_between(0, clip.frame_count()).ok_or(ErrorKind::FrameRange)?;
    let legal = match clip.viseme_type() {
        Some(viseme_type) => viseme_type.contains_all(frames),
        None => VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(frames)),
    };
    legal.then_some(()).ok_or(ErrorKind::FrameCode)
}

/// Starts exist, do not decrease and do not pass the end; unused ones are 0xFFFF.
fn segment_starts(bank: &Bank<'_>, clip: &Clip<'_, '_>, ends: &mut Ends) -> Result<(), ErrorKind> {
    let count = clip.segment_count();
    // The reader clamps what a damaged record says.
    if count == 0 || count != clip.record.segment_count.get() {
        return Err(ErrorKind::SegmentStarts);
    }
    let used = (count as usize).wrapping_sub(1);
    let is_unused = |start: &layout::U16| start.get() == 0xFFFF;
    let starts_are_valid = match far_starts(clip) {
        None => {
            let (starts, unused) = clip.record.starts.split_at(used.min(layout::INLINE_STARTS));
            clip.frame_count() <= 0xFFFF
                && unused.iter().all(is_unused)
                && ascend(starts.iter().map(|start| u32::from(start.get())), clip.frame_count())
        }
        Some(first) => {
            let end = first.wrapping_add(used);
            let starts = bank.starts.get(first..end);
            let follows = first == ends.starts && clip.record.starts.iter().skip(2).all(is_unused);
            ends.starts = end;
            let ascends = |starts: &[layout::U32]| ascend(starts.iter().map(|start| start.get()), clip.frame_count());
            follows && starts.map_or(false, ascends)
        }
    };
    starts_are_valid.then_some(()).ok_or(ErrorKind::SegmentStarts)
}

fn ascend(starts: impl Iterator<Item = u32>, frame_count: u32) -> bool {
    let mut before = 0;
    for start in starts {
        if start < before {
            return false;
        }
        before = start;
    }
    before <= frame_count
}
