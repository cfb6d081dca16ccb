//! Runs of a bank: the display texts of a clip in one locale, behind a table of their ends.

use lipz_bank::layout::{NARROW_END_BYTES, NO_TEXT, TEXT_OFFSET, TEXT_WIDE, WIDE_END_BYTES};

/// The run that `entry` of a text index names in `pool`, of a clip with so many segments; `None` if there
/// is none, or it is damaged.
pub(crate) fn run(pool: &[u8], entry: u32, segment_count: u32) -> Option<&[u8]> {
    if entry == NO_TEXT {
        return None;
    }
    let end_bytes = if entry & TEXT_WIDE == 0 { NARROW_END_BYTES } else { WIDE_END_BYTES };
    let run = pool.get((entry & TEXT_OFFSET) as usize..)?;
    let table_bytes = (segment_count as usize).checked_mul(end_bytes)?;
    let last_end = run.get(table_bytes.checked_sub(end_bytes)?..table_bytes)?;
    let texts_bytes = last_end.iter().rev().fold(0, |end, &bits| end << 7 | usize::from(bits));
    run.get(..table_bytes.checked_add(texts_bytes)?)
}
