//! Every text of every clip in every locale is a string of the pool.

use super::error_in;
use crate::file::File;
use crate::layout::{ClipRecord, KeyRecord, NO_TEXT, TEXT_OFFSET, TEXT_WIDE};
use crate::locale::LocaleTable;
use crate::pool::Pool;
use crate::segment::end_behind;
use crate::{Error, ErrorKind};

/// The most bytes of a clip's texts whose ends do not wrap around.
const MAX_NARROW: usize = 0xFFFF;

/// The check of the texts while the clips are gone through.
pub(super) struct TextCheck<'a, 'data> {
    file: &'a File<'data>,
    table: &'a LocaleTable<'data>,
    pool: &'data str,
}

impl<'a, 'data> TextCheck<'a, 'data> {
    /// The check of the texts of `table`, which is that of `file`.
    pub(super) fn of(file: &'a File<'data>, table: &'a LocaleTable<'data>) -> Self {
        let pool = match table.texts {
            Pool::Checked(pool) => pool,
            Pool::Bytes(_) => "",
        };
        TextCheck { file, table, pool }
    }

    /// Checks the texts of the clip in this slot, whose segments are checked, in all locales: each end once.
    pub(super) fn clip(&self, slot: usize, clip: &ClipRecord, key: &KeyRecord) -> Result<(), Error> {
        let count = usize::from(key.segment_count.get());
        // Behind the entry that no text has.
        let mut first = (clip.segments_first.get() as usize).wrapping_add(1);
        let mut at = slot;
        // A locale has an entry per slot; there is a slot, so this ends.
        while let Some(entry) = self.table.index.get(at) {
            let ends = self.table.ends.get(first..first.wrapping_add(count)).unwrap_or(&[]);
            let (offset, mut end, mut is_valid) = ((entry.get() & TEXT_OFFSET) as usize, 0, true);
            for low in ends {
                end = end_behind(end, *low);
                is_valid &= self.pool.is_char_boundary(offset.wrapping_add(end));
            }
            is_valid &= self.pool.is_char_boundary(offset) && (end > MAX_NARROW) == (entry.get() & TEXT_WIDE != 0);
            if entry.get() == NO_TEXT {
                is_valid = end == 0;
            }
            if !is_valid {
                return Err(error_in(self.file, ErrorKind::TextReference, entry));
            }
            at = at.wrapping_add(self.table.clip_count);
            first = first.wrapping_add(self.table.segment_count);
        }
        Ok(())
    }
}
