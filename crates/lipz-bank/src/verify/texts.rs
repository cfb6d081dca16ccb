//! Checks that every text of every clip in every locale is a string of the pool.

use super::error_in;
use crate::file::File;
use crate::locale::LocaleTable;
use crate::text::TextPlace;
use crate::{Error, ErrorKind};
use lipz_layout::{ClipRecord, KeyRecord, NO_TEXT, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_MAX_BYTES, TEXT_OFFSET, U32};

/// The state of the check of texts, while the clips are visited.
pub(super) struct TextCheck<'a, 'data> {
    file: &'a File<'data>,
    table: &'a LocaleTable<'data>,
    /// Whether to check the texts, in addition to their places.
    has_contents: bool,
}

impl<'a, 'data> TextCheck<'a, 'data> {
    /// Starts the check of the texts of `table`, which belongs to `file`.
    pub(super) fn new(file: &'a File<'data>, table: &'a LocaleTable<'data>, has_contents: bool) -> Self {
        TextCheck { file, table, has_contents }
    }

    /// Checks the texts of a clip in all locales. The segments of the clip are already checked.
    pub(super) fn clip(&self, clip: &ClipRecord, key: &KeyRecord) -> Result<(), Error> {
        let count = usize::from(key.segment_count.get());
        let mut first = clip.segments_first.get() as usize;
        for _ in self.table.records {
            let starts = self.table.starts.get(first..=first.wrapping_add(count));
            let fault = match starts {
                // Nearly all clips pass this test. It is used only where code is cheap.
                Some(starts) if cfg!(target_pointer_width = "64") && self.has_plain_texts(starts) => None,
                Some(starts) => self.fault(starts),
                None => self.table.starts.first(),
            };
            if let Some(entry) = fault {
                return Err(error_in(self.file, ErrorKind::TextReference, entry));
            }
            first = first.wrapping_add(self.table.segment_count);
        }
        Ok(())
    }

    /// Whether the texts of a clip are of one kind, have no counts and follow each other in the pool. Other texts may
    /// still be valid.
    #[inline(always)]
    fn has_plain_texts(&self, starts: &[U32]) -> bool {
        let pool = self.table.texts.bytes();
        let (first, own, last) = match starts {
            [first, own @ .., last] if self.has_contents => (first.get(), own, last.get()),
            _ => return false,
        };
        let kind = first & TEXT_FALLBACK;
        let mut before = first & TEXT_OFFSET;
        let mut is_behind = |entry: u32| {
            let start = core::mem::replace(&mut before, entry & TEXT_OFFSET);
            before.wrapping_sub(start) <= TEXT_MAX_BYTES as u32 && starts_character(pool, before)
        };
        first & TEXT_HAS_LENGTH == 0
            && starts_character(pool, first & TEXT_OFFSET)
            && own.iter().all(|entry| {
                let entry = entry.get();
                entry & (TEXT_FALLBACK | TEXT_HAS_LENGTH) == kind && is_behind(entry)
            })
            && is_behind(last)
    }

    /// Returns the first invalid entry. A clip has a text in all of its segments or in none, and all are its own or all
    /// come from another locale. `starts` also has the entry after the clip's own.
    #[cfg_attr(target_pointer_width = "64", cold, inline(never))]
    fn fault<'s>(&self, starts: &'s [U32]) -> Option<&'s U32> {
        let first = starts.first().map_or(NO_TEXT, |first| first.get());
        starts.windows(2).find_map(|pair| match pair {
            [entry, _] if first == NO_TEXT && entry.get() == NO_TEXT => None,
            [entry, next] if first != NO_TEXT && self.is_text(*entry, *next, first) => None,
            pair => pair.first(),
        })
    }

    /// Whether an entry has a text, and is of the same kind as `first`.
    fn is_text(&self, entry: U32, next: U32, first: u32) -> bool {
        let texts = self.table.texts;
        let is_string = |place: TextPlace| if self.has_contents { place.is_valid(texts) } else { place.fits(texts) };
        (entry.get() ^ first) & TEXT_FALLBACK == 0 && TextPlace::between(entry, next, texts).map_or(false, is_string)
    }
}

/// Whether a UTF-8 character starts at this offset in the pool.
#[inline(always)]
fn starts_character(pool: &[u8], offset: u32) -> bool {
    pool.get(offset as usize).map_or(false, |byte| byte & 0xC0 != 0x80)
}
