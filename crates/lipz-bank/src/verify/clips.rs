//! Checks clip records, ordered by key, and the data that they own.

use super::error_at;
use super::strings::Strings;
use super::texts::TextCheck;
use crate::clip::key;
use crate::{Bank, ClipId, Error, ErrorKind, VisemeType};
use lipz_layout::{ClipRecord, FLAG_VISEMES, KeyRecord, MAX_INTEGER_FPS, NO_RATE, RateRecord};
use lipz_types::StoredFps;

/// The segments counted so far: those of clips with events come first.
struct Segments {
    with_events: usize,
    others: usize,
}

/// Checks every clip with its texts, and with `CONTENTS` the codes of its frames. Returns the end of the keys in the
/// pool of names.
///
/// Keys that ascend strictly are distinct, so the order table, which has one entry per clip, names every clip once.
pub(super) fn clips<const CONTENTS: bool>(bank: &Bank<'_>) -> Result<u32, Error> {
    let mut segments = Segments { with_events: 0, others: bank.event_refs.len() };
    let texts = TextCheck::new(&bank.file, &bank.texts, CONTENTS);
    let mut keys = Strings::new(bank.names, 0);
    for entry in bank.key_order {
        let slot = entry.get();
        let records = (bank.clips.get(slot as usize), bank.keys.get(slot as usize));
        let (clip, record) = match records {
            (Some(clip), Some(record)) => (clip, record),
            _ => return Err(error_at(bank, ErrorKind::ClipOrder, entry)),
        };
        let failed = |kind| error_at(bank, kind, record);
        let key = key(bank, record).filter(|key| !key.is_empty()).ok_or(failed(ErrorKind::ClipKey))?;
        if !keys.ascends(key) {
            return Err(error_at(bank, ErrorKind::ClipOrder, entry));
        }
        if bank.find(ClipId::from_u64(record.id.get())).map(|(slot, _)| slot) != Some(slot) {
            return Err(failed(ErrorKind::ClipIndex));
        }
        let follows = keys.follows(record.key_offset_bytes.get(), u32::from(record.key_length_bytes.get()));
        if !follows || ClipId::from_key(key).get() != record.id.get() {
            return Err(failed(ErrorKind::ClipKey));
        }
        contents::<CONTENTS>(bank, clip, record, &mut segments).map_err(|kind| error_at(bank, kind, clip))?;
        texts.clip(clip, record)?;
    }
    if segments.with_events != bank.event_refs.len() {
        return Err(error_at(bank, ErrorKind::EventReference, bank.event_refs));
    }
    // These cover the first frame of all to the last, because each clip starts where another ends.
    let ends = (bank.starts.first().map(|first| first.get()), bank.starts.get(segments.others..));
    match ends {
        (Some(0), Some([last])) if last.get() as usize == bank.frames.len() => {}
        _ => return Err(error_at(bank, ErrorKind::SegmentStarts, bank.starts)),
    }
    Ok(keys.end())
}

/// Checks the frames and segments of a clip record.
fn contents<const CONTENTS: bool>(
    bank: &Bank<'_>,
    record: &ClipRecord,
    key: &KeyRecord,
    segments: &mut Segments,
) -> Result<(), ErrorKind> {
    let viseme_type = VisemeType::from_number(record.viseme_type);
    if record.flags & !FLAG_VISEMES != 0
        || (record.viseme_type != 0 && viseme_type.is_none())
        || (record.flags & FLAG_VISEMES == 0 && record.frame_count.get() != 0)
    {
        return Err(ErrorKind::ClipFlags);
    }
    let rate = record.rate.get();
    if rate != NO_RATE && lipz_layout::stored_fps(rate, bank.rates).is_none() {
        return Err(ErrorKind::FrameRate);
    }
    let (first, count) = (record.segments_first.get() as usize, usize::from(key.segment_count.get()));
    let end = first.wrapping_add(count);
    let group = if first < bank.event_refs.len() { &mut segments.with_events } else { &mut segments.others };
    if count == 0 || core::mem::replace(group, end) != first {
        return Err(ErrorKind::SegmentStarts);
    }
    let starts = bank.starts.get(first..=end).ok_or(ErrorKind::SegmentStarts)?;
    let frames_start = record.frames_offset_bytes.get();
    if starts.first().map(|first| first.get()) != Some(frames_start) {
        return Err(ErrorKind::FrameRange);
    }
    let mut frames_end = frames_start;
    for start in starts {
        if start.get() < frames_end {
            return Err(ErrorKind::SegmentStarts);
        }
        frames_end = start.get();
    }
    if frames_end.wrapping_sub(frames_start) != record.frame_count.get() {
        return Err(ErrorKind::FrameRange);
    }
    let frames = bank.frames.get(frames_start as usize..frames_end as usize).ok_or(ErrorKind::FrameRange)?;
    let may_be = |kind: &VisemeType| viseme_type.map_or(true, |own| own == *kind) && kind.contains_all(frames);
    if !CONTENTS || VisemeType::ALL.iter().any(may_be) { Ok(()) } else { Err(ErrorKind::FrameCode) }
}

/// Checks the frame rates that are not whole numbers. There are at most as many as a clip record can refer to.
pub(super) fn rates(bank: &Bank<'_>) -> Result<(), Error> {
    let is_valid =
        |rate: &RateRecord| rate.fps_denominator.get() != 1 && rate.fps().and_then(StoredFps::checked).is_some();
    if bank.rates.len() >= usize::from(NO_RATE - MAX_INTEGER_FPS) {
        return Err(error_at(bank, ErrorKind::FrameRate, bank.rates));
    }
    match bank.rates.iter().find(|rate| !is_valid(rate)) {
        Some(rate) => Err(error_at(bank, ErrorKind::FrameRate, rate)),
        None => Ok(()),
    }
}
