//! Checks curves, which follow each other: those of each clip ordered by name, with keys that ascend.

use crate::curve::table::{CurveTable, Keys};
use crate::verify::error_at;
use crate::{Bank, Error, ErrorKind};
use lipz_layout::{CURVE_WIDE, ClipRecord, FLAG_VISEMES};

/// Checks the sections, if the bank has them. Each of their entries belongs to one clip and is checked once.
pub(crate) fn check(bank: &Bank<'_>) -> Result<(), Error> {
    let table = CurveTable::new(bank);
    let (mut slots_end, mut curves_end) = (0, 0);
    for (place, record) in table.clips.iter().enumerate() {
        let failed = error_at(bank, ErrorKind::Curve, record);
        let slot = record.slot.get();
        let clip = bank.clips.get(slot as usize).filter(|_| slot >= slots_end).ok_or(failed)?;
        slots_end = slot.wrapping_add(1);
        let curves = table.curves_of(place).filter(|curves| curves.start == curves_end).ok_or(failed)?;
        curves_end = curves.end;
        if curves.end > table.curves.len() || curves.is_empty() {
            return Err(failed);
        }
        let mut names_end = 0;
        for index in curves {
            let name = name(bank, &table, index).filter(|name| *name >= names_end);
            names_end = name.unwrap_or(0).wrapping_add(1);
            if name.is_none() || !table.keys_of(index).map_or(false, |keys| is_valid(keys, clip)) {
                return Err(table.curves.get(index).map_or(failed, |curve| error_at(bank, ErrorKind::Curve, curve)));
            }
        }
    }
    // The keys of the first curve start with their section, and those of the last end with it.
    let keys_start = table.curves.first().map_or(table.units.len(), |first| first.keys_first.get() as usize);
    if curves_end != table.curves.len() || keys_start != 0 {
        return Err(error_at(bank, ErrorKind::Curve, table.curves));
    }
    Ok(())
}

/// Returns the number of a curve's name, if the name exists and the curve's keys fill their place.
fn name(bank: &Bank<'_>, table: &CurveTable<'_>, index: usize) -> Option<u32> {
    let record = table.curves.get(index)?;
    let (number, is_wide) = (record.name_and_width.get() & !CURVE_WIDE, record.name_and_width.get() & CURVE_WIDE != 0);
    let is_filled = !is_wide || (table.keys_end(index) as u32).wrapping_sub(record.keys_first.get()) & 1 == 0;
    if (number as usize) < bank.event_names.len() && is_filled { Some(number) } else { None }
}

/// Whether there are keys, which ascend and are not after the end of the clip.
fn is_valid(keys: Keys<'_>, clip: &ClipRecord) -> bool {
    let mut frames_end = 0;
    for index in 0..keys.count() {
        let frame = keys.get(index).map(|key| key.frame).filter(|frame| u64::from(*frame) >= frames_end);
        frames_end = u64::from(frame.unwrap_or(u32::MAX)).wrapping_add(1);
        if frame.is_none() {
            return false;
        }
    }
    // A clip without visemes has no end.
    let has_end = clip.flags & FLAG_VISEMES != 0;
    keys.count() > 0 && (!has_end || frames_end <= u64::from(clip.frame_count.get()).wrapping_add(1))
}
