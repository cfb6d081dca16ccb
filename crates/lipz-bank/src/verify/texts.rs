//! Every text of every clip in every locale is a string of the pool.

use super::error_in;
use crate::file::File;
use crate::layout::{ClipRecord, KeyRecord, NO_TEXT, TEXT_FALLBACK, U32};
use crate::locale::LocaleTable;
use crate::text::TextPlace;
use crate::{Error, ErrorKind};

/// The check of the texts while the clips are gone through.
pub(super) struct TextCheck<'a, 'data> {
    file: &'a File<'data>,
    table: &'a LocaleTable<'data>,
}

impl<'a, 'data> TextCheck<'a, 'data> {
    /// The check of the texts of `table`, which is that of `file`.
    pub(super) fn of(file: &'a File<'data>, table: &'a LocaleTable<'data>) -> Self {
        TextCheck { file, table }
    }

    /// Checks the texts of a clip, whose segments are checked, in all locales.
    pub(super) fn clip(&self, clip: &ClipRecord, key: &KeyRecord) -> Result<(), Error> {
        let count = usize::from(key.segment_count.get());
        let mut first = clip.segments_first.get() as usize;
        for _ in self.table.records {
            let starts = self.table.starts.get(first..=first.wrapping_add(count)).unwrap_or(&[]);
            if !self.are_valid(starts) {
                return Err(error_in(self.file, ErrorKind::TextReference, starts));
            }
            first = first.wrapping_add(self.table.segment_count);
        }
        Ok(())
    }

    /// Whether a clip has a text in none of its segments or in all, own ones or those of another locale. `starts` has
    /// the entry behind its own, too.
    fn are_valid(&self, starts: &[U32]) -> bool {
        let first = starts.first().map_or(NO_TEXT, |first| first.get());
        starts.windows(2).all(|pair| match *pair {
            [entry, _] if first == NO_TEXT => entry.get() == NO_TEXT,
            [entry, next] => (entry.get() ^ first) & TEXT_FALLBACK == 0 && self.is_string(entry, next),
            _ => false,
        })
    }

    fn is_string(&self, entry: U32, next: U32) -> bool {
        let place = TextPlace::between(entry, next, self.table.texts);
        place.map_or(false, |place| place.is_in(self.table.texts))
    }
}
