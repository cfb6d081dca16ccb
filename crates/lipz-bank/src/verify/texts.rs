//! Every text of every clip in every locale is a string of the pool.

use super::error_in;
use crate::file::File;
use crate::layout;
use crate::locale::LocaleTable;
use crate::pool::Pool;
use crate::{Error, ErrorKind};

/// Steps per byte of the file before it is refused as forged: one for each entry of the text index,
/// and one for each segment of a run that is checked.
///
/// Clips with equal texts share a run, which is checked for each of them. A real bank needs about one
/// step a byte; one in which many clips say the same thousand segments in 200 locales needs 40.
const STEPS_PER_BYTE: u64 = 64;

/// The check of the texts while the clips are gone through.
pub(super) struct TextCheck<'a, 'data> {
    file: &'a File<'data>,
    table: &'a LocaleTable<'data>,
    pool: &'data str,
    steps_left: u64,
}

impl<'a, 'data> TextCheck<'a, 'data> {
    /// The check of the texts of `table`, which is that of `file`.
    pub(super) fn of(file: &'a File<'data>, table: &'a LocaleTable<'data>) -> Self {
        let pool = match table.texts {
            Pool::Checked(pool) => pool,
            Pool::Bytes(_) => "",
        };
        TextCheck { file, table, pool, steps_left: (file.bytes.len() as u64).wrapping_mul(STEPS_PER_BYTE) }
    }

    /// Checks the texts of the clip in this slot, whose segment count is checked, in all locales.
    pub(super) fn clip(&mut self, slot: usize, segment_count: u32) -> Result<(), Error> {
        // The last runs found valid for this clip: locales that fall back to one are not checked again.
        let mut known = [layout::NO_TEXT; 4];
        let (mut at, mut number) = (slot, 0_usize);
        // A locale has an entry per slot; there is a slot, so this ends.
        while let Some(entry) = self.table.index.get(at) {
            at = at.wrapping_add(self.table.clip_count);
            number = number.wrapping_add(1);
            let run = entry.get() & !layout::TEXT_FALLBACK;
            let is_known = entry.get() == layout::NO_TEXT || known.contains(&run);
            let steps = if is_known { 1 } else { u64::from(segment_count).wrapping_add(1) };
            self.steps_left = match self.steps_left.checked_sub(steps) {
                Some(left) => left,
                None => return Err(error_in(self.file, ErrorKind::TooManySteps, entry)),
            };
            if is_known {
                continue;
            }
            if !run_is_valid(self.pool, run, segment_count) {
                return Err(error_in(self.file, ErrorKind::TextReference, entry));
            }
            if let Some(place) = known.get_mut(number % 4) {
                *place = run;
            }
        }
        Ok(())
    }
}

/// The table of ends is ASCII, the ends ascend, and they stand between characters of the pool.
fn run_is_valid(pool: &str, entry: u32, segment_count: u32) -> bool {
    let offset = (entry & layout::TEXT_OFFSET) as usize;
    let width = if entry & layout::TEXT_WIDE != 0 { layout::WIDE_END_BYTES } else { layout::NARROW_END_BYTES };
    let run = pool.as_bytes().get(offset..).unwrap_or(&[]);
    let table_bytes = (segment_count as usize).checked_mul(width);
    let mut table = match table_bytes.and_then(|bytes| run.get(..bytes)) {
        Some(table) => table,
        None => return false,
    };
    let texts = offset.wrapping_add(table.len());
    let mut before = 0;
    while let (Some(digits), Some(behind)) = (table.get(..width), table.get(width..)) {
        let end = digits.iter().rev().fold(0, |end, digit| end << 7 | usize::from(*digit));
        let is_ascii = digits.iter().all(u8::is_ascii);
        if !is_ascii || end < before || !pool.is_char_boundary(texts.wrapping_add(end)) {
            return false;
        }
        before = end;
        table = behind;
    }
    true
}
