//! Every text of every clip in every locale is a string of the pool.

use super::error_at;
use crate::layout::{self, U32};
use crate::pool::Pool;
use crate::segment::text_end;
use crate::{Bank, Clip, Error, ErrorKind};

/// Segments that are checked per byte of the file before it is refused as forged.
///
/// Locales that fall back, and clips with equal texts, share runs: a run is checked once for each
/// entry that leads to it. A real bank needs about one step a byte; even one of 200 locales that
/// all show the same text of a clip of a thousand segments needs 30.
const STEPS_PER_BYTE: u64 = 32;

/// The check of the texts while the clips are checked.
pub(super) struct Texts<'data> {
    pool: &'data str,
    steps_left: u64,
}

impl<'data> Texts<'data> {
    pub(super) fn of(bank: &Bank<'data>) -> Texts<'data> {
        let pool = match bank.texts {
            Pool::Checked(pool) => pool,
            Pool::Bytes(_) => "",
        };
        Texts { pool, steps_left: (bank.bytes.len() as u64).wrapping_mul(STEPS_PER_BYTE) }
    }

    /// Checks the texts of one clip, whose segment count is checked, in all locales.
    pub(super) fn clip(&mut self, bank: &Bank<'_>, clip: &Clip<'_, '_>) -> Result<(), Error> {
        for index in bank.text_index.chunks_exact(bank.clips.len()) {
            let entry = match index.get(clip.slot() as usize) {
                Some(entry) => entry,
                None => continue, // a slot is less than the length of a chunk
            };
            match self.steps_left.checked_sub(u64::from(clip.segment_count())) {
                Some(steps) => self.steps_left = steps,
                None => return Err(error_at(bank, ErrorKind::TooManySteps, entry)),
            }
            if !run_is_valid(self.pool, entry, clip.segment_count()) {
                return Err(error_at(bank, ErrorKind::TextReference, entry));
            }
        }
        Ok(())
    }
}

/// The table of ends is ASCII, the ends ascend, and they stand between characters of the pool.
fn run_is_valid(pool: &str, entry: &U32, segment_count: u32) -> bool {
    let entry = entry.get();
    if entry == layout::NO_TEXT {
        return true;
    }
    let wide = entry & layout::TEXT_WIDE != 0;
    let offset = (entry & layout::TEXT_OFFSET) as usize;
    let width = if wide { 4 } else { 2 };
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
