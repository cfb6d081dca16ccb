//! Every text of every clip in every locale is a string of the pool.

use super::error_in;
use crate::file::File;
use crate::layout;
use crate::locale::LocaleTable;
use crate::pool::Pool;
use crate::segment::text_end;
use crate::{Clip, Error, ErrorKind};

/// Steps per byte of the file before it is refused as forged: one for each entry of the text index,
/// and one for each segment of a run that is checked.
///
/// Clips with equal texts share a run, which is checked for each of them. A real bank needs about one
/// step a byte; one in which many clips say the same thousand segments in 200 locales needs 40.
const STEPS_PER_BYTE: u64 = 64;

/// The check of the texts while the clips are gone through.
pub(super) struct TextCheck<'data> {
    file: File<'data>,
    table: LocaleTable<'data>,
    pool: &'data str,
    steps_left: u64,
}

impl<'data> TextCheck<'data> {
    /// The check of the texts of `table`, which is that of `file`.
    pub(super) fn of(file: File<'data>, table: LocaleTable<'data>) -> TextCheck<'data> {
        let pool = match table.texts {
            Pool::Checked(pool) => pool,
            Pool::Bytes(_) => "",
        };
        TextCheck { file, table, pool, steps_left: (file.bytes.len() as u64).wrapping_mul(STEPS_PER_BYTE) }
    }

    /// Checks the texts of one clip, whose segment count is checked, in all locales.
    pub(super) fn clip(&mut self, clip: &Clip<'_, '_>) -> Result<(), Error> {
        // The last runs found valid for this clip: locales that fall back to one are not checked again.
        let mut known = [layout::NO_TEXT; 4];
        for (number, locale) in self.table.locales().enumerate() {
            let entry = match locale.index.get(clip.slot() as usize) {
                Some(entry) => entry,
                None => continue, // a locale has an entry per slot
            };
            self.charge(1).ok_or(error_in(&self.file, ErrorKind::TooManySteps, entry))?;
            let run = entry.get() & !layout::TEXT_FALLBACK;
            if entry.get() == layout::NO_TEXT || known.contains(&run) {
                continue;
            }
            self.charge(clip.segment_count()).ok_or(error_in(&self.file, ErrorKind::TooManySteps, entry))?;
            if !run_is_valid(self.pool, run, clip.segment_count()) {
                return Err(error_in(&self.file, ErrorKind::TextReference, entry));
            }
            if let Some(place) = known.get_mut(number % 4) {
                *place = run;
            }
        }
        Ok(())
    }

    fn charge(&mut self, steps: u32) -> Option<()> {
        self.steps_left = self.steps_left.checked_sub(u64::from(steps))?;
        Some(())
    }
}

/// The table of ends is ASCII, the ends ascend, and they stand between characters of the pool.
fn run_is_valid(pool: &str, entry: u32, segment_count: u32) -> bool {
    let wide = entry & layout::TEXT_WIDE != 0;
    let offset = (entry & layout::TEXT_OFFSET) as usize;
    let width = if wide { layout::WIDE_END_BYTES } else { layout::NARROW_END_BYTES };
    let table_bytes = (segment_count as usize).checked_mul(width);
    let run = pool.as_bytes().get(offset..).unwrap_or(&[]);
    let texts = match table_bytes.and_then(|bytes| run.get(..bytes)) {
        Some(table) if table.is_ascii() => offset.wrapping_add(table.len()),
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
