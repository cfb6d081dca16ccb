//! The full check of a bank: every byte and every reference, with constant stack.

use crate::layout::{self, ClipRecord, LocaleRecord, FLAG_FAR_STARTS, FLAG_VISEMES, U32};
use crate::pool::Pool;
use crate::segment::{far_starts, text_end};
use crate::{Bank, Clip, ClipId, Error, ErrorKind};

/// Checks the bank and marks its pools as checked.
pub(crate) fn verify(bank: &mut Bank<'_>) -> Result<(), Error> {
    let checked = bank.bytes.get(layout::CHECKED_FROM..).unwrap_or(&[]);
    if layout::checksum(checked) != bank.header.checksum.get() {
        return Err(Error::new(ErrorKind::Checksum, 8));
    }
    bank.names = checked_pool(bank, bank.names)?;
    bank.texts = checked_pool(bank, bank.texts)?;
    bank.event_strings = checked_pool(bank, bank.event_strings)?;
    table_lengths(bank)?;
    locales(bank)?;
    events(bank)?;
    for slot in 0..bank.clips.len() as u32 {
        if let Some(clip) = bank.clip_at(slot) {
            clip_record(bank, &clip).map_err(|kind| error_at(bank, kind, clip.record))?;
        }
    }
    key_order(bank)?;
    texts(bank)
}

/// An error at the place of `item`, which lies in the bank.
fn error_at<T: ?Sized>(bank: &Bank<'_>, kind: ErrorKind, item: &T) -> Error {
    let item = item as *const T as *const u8 as usize;
    Error::new(kind, item.wrapping_sub(bank.bytes.as_ptr() as usize) as u32)
}

fn checked_pool<'data>(bank: &Bank<'data>, pool: Pool<'data>) -> Result<Pool<'data>, Error> {
    let bytes = pool.bytes();
    match core::str::from_utf8(bytes) {
        Ok(text) => Ok(Pool::Checked(text)),
        Err(error) => {
            let behind = bytes.get(error.valid_up_to()..).unwrap_or(bytes);
            Err(error_at(bank, ErrorKind::Utf8, behind))
        }
    }
}

/// Tables that run parallel to others have their lengths.
fn table_lengths(bank: &Bank<'_>) -> Result<(), Error> {
    if bank.key_order.len() != bank.clips.len() {
        return Err(error_at(bank, ErrorKind::ClipOrder, bank.key_order));
    }
    if bank.locales.len().checked_mul(bank.clips.len()) != Some(bank.text_index.len()) {
        return Err(error_at(bank, ErrorKind::TextReference, bank.text_index));
    }
    Ok(())
}

/// Tags are strings of the pool, in strictly ascending order.
fn locales(bank: &Bank<'_>) -> Result<(), Error> {
    let tag = |record: &LocaleRecord| {
        bank.names.text_at(record.tag_offset_bytes.get(), u32::from(record.tag_length_bytes.get()))
    };
    let mut before = "";
    for record in bank.locales {
        match tag(record) {
            Some(tag) if tag > before && record.flags.get() & !layout::LOCALE_DEFAULT == 0 => before = tag,
            _ => return Err(error_at(bank, ErrorKind::LocaleOrder, record)),
        }
    }
    Ok(())
}

/// Event strings lie in their pool, event references in the table of strings.
fn events(bank: &Bank<'_>) -> Result<(), Error> {
    for record in bank.events {
        if bank.event_strings.text_at(record.offset_bytes.get(), record.length_bytes.get()).is_none() {
            return Err(error_at(bank, ErrorKind::EventReference, record));
        }
    }
    for reference in bank.event_refs {
        if reference.get() as usize >= bank.events.len() {
            return Err(error_at(bank, ErrorKind::EventReference, reference));
        }
    }
    Ok(())
}

/// Everything that one clip record says, but its texts.
fn clip_record(bank: &Bank<'_>, clip: &Clip<'_, '_>) -> Result<(), ErrorKind> {
    let record = clip.record;
    if bank.slot(clip.id()) != Some(clip.slot()) {
        return Err(ErrorKind::ClipIndex);
    }
    let key = bank.names.text_at(record.key_offset_bytes.get(), u32::from(record.key_length_bytes.get()));
    if key.map(ClipId::of) != Some(clip.id()) {
        return Err(ErrorKind::ClipKey);
    }
    if record.flags & !(FLAG_VISEMES | FLAG_FAR_STARTS) != 0
        || (record.viseme_type != 0 && clip.viseme_type().is_none())
        || (record.flags & FLAG_VISEMES == 0 && record.frame_count.get() != 0)
    {
        return Err(ErrorKind::ClipFlags);
    }
    frame_rate(record, clip)?;
    frame_codes(clip)?;
    segment_starts(bank, clip)?;
    if clip.has_events() {
        let end = (record.events_first.get() as usize).checked_add(clip.segment_count() as usize);
        if end.map_or(true, |end| end > bank.event_refs.len()) {
            return Err(ErrorKind::EventReference);
        }
    }
    Ok(())
}

fn frame_rate(record: &ClipRecord, clip: &Clip<'_, '_>) -> Result<(), ErrorKind> {
    let valid = match clip.fps() {
        Some(fps) => fps.is_valid(),
        None => record.fps_numerator.get() == 0 && record.frames_per_micro_q64.get() == 0,
    };
    if valid {
        Ok(())
    } else {
        Err(ErrorKind::FrameRate)
    }
}

fn frame_codes(clip: &Clip<'_, '_>) -> Result<(), ErrorKind> {
    let frames = clip.frames_between(0, clip.frame_count()).ok_or(ErrorKind::FrameRange)?;
    let legal = match clip.viseme_type() {
        Some(viseme_type) => viseme_type.contains_all(frames),
        None => crate::VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(frames)),
    };
    if legal {
        Ok(())
    } else {
        Err(ErrorKind::FrameCode)
    }
}

/// Starts exist, do not decrease and do not pass the end; unused ones are 0xFFFF.
fn segment_starts(bank: &Bank<'_>, clip: &Clip<'_, '_>) -> Result<(), ErrorKind> {
    let count = clip.segment_count();
    // The reader clamps what a damaged record says.
    if count == 0 || count != clip.record.segment_count.get() {
        return Err(ErrorKind::SegmentStarts);
    }
    let used = (count as usize).wrapping_sub(1);
    let starts_are_valid = match far_starts(clip) {
        None => {
            let (starts, unused) = clip.record.starts.split_at(used.min(layout::INLINE_STARTS));
            clip.frame_count() <= 0xFFFF
                && unused.iter().all(|start| start.get() == 0xFFFF)
                && ascend(starts.iter().map(|start| u32::from(start.get())), clip.frame_count())
        }
        Some(first) => match first.checked_add(used).and_then(|end| bank.starts.get(first..end)) {
            Some(starts) => ascend(starts.iter().map(|start| start.get()), clip.frame_count()),
            None => false,
        },
    };
    if starts_are_valid {
        Ok(())
    } else {
        Err(ErrorKind::SegmentStarts)
    }
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

/// The order table names every clip once: its keys ascend strictly and it has as many entries.
fn key_order(bank: &Bank<'_>) -> Result<(), Error> {
    let mut before: Option<&[u8]> = None;
    for slot in bank.key_order {
        let key = bank.clip_at(slot.get()).and_then(|clip| clip.key_bytes());
        if key.is_none() || key <= before {
            return Err(error_at(bank, ErrorKind::ClipOrder, slot));
        }
        before = key;
    }
    Ok(())
}

/// Every text of every clip in every locale is a string of the pool.
fn texts(bank: &Bank<'_>) -> Result<(), Error> {
    if bank.clips.is_empty() {
        return Ok(());
    }
    let pool = match bank.texts {
        Pool::Checked(pool) => pool,
        Pool::Bytes(_) => "",
    };
    for index in bank.text_index.chunks_exact(bank.clips.len()) {
        for (entry, record) in index.iter().zip(bank.clips) {
            if !run_is_valid(pool, entry, record.segment_count.get()) {
                return Err(error_at(bank, ErrorKind::TextReference, entry));
            }
        }
    }
    Ok(())
}

/// The ends of a run ascend and, with its start, stand between characters of the pool.
fn run_is_valid(pool: &str, entry: &U32, segment_count: u32) -> bool {
    let entry = entry.get();
    if entry == layout::NO_TEXT {
        return true;
    }
    let wide = entry & layout::TEXT_WIDE != 0;
    let offset = (entry & layout::TEXT_OFFSET) as usize;
    let width = if wide { 4 } else { 2 };
    let run = pool.as_bytes().get(offset..).unwrap_or(&[]);
    // Segment counts were checked against the starts: the product fits 34 bits.
    let table = (u64::from(segment_count)).wrapping_mul(width);
    let texts = match usize::try_from(table).ok().and_then(|table| offset.checked_add(table)) {
        Some(texts) if pool.is_char_boundary(texts) => texts,
        _ => return false,
    };
    let mut before = 0;
    for segment in 0..segment_count {
        match text_end(run, segment, wide) {
            Some(end) if end >= before && pool.is_char_boundary(texts.wrapping_add(end)) => before = end,
            _ => return false,
        }
    }
    true
}
