//! The locales of a file: handles that text queries take.

use core::fmt;
use core::iter::FusedIterator;

use crate::Bank;
use crate::file::{Sections, entries, place};
use crate::origin::Origin;
use crate::pool::Pool;
use lipz_layout::{LOCALE_DEFAULT, LocaleRecord, U32};

/// The locales of a file with their texts: four of the sections of a bank, all that a text bank
/// has.
#[derive(Clone, Copy)]
pub(crate) struct LocaleTable<'data> {
    pub(crate) records: &'data [LocaleRecord],
    pub(crate) names: Pool<'data>,
    /// For each locale in turn, one entry per segment, and one behind them.
    pub(crate) starts: &'data [U32],
    pub(crate) texts: Pool<'data>,
    pub(crate) segment_count: usize,
}

impl<'data> LocaleTable<'data> {
    /// The table of a file about clips with so many segments.
    pub(crate) fn new(sections: &Sections<'data>, segment_count: usize) -> LocaleTable<'data> {
        LocaleTable {
            records: entries(sections[place::LOCALES]),
            names: Pool::Bytes(sections[place::NAMES]),
            starts: entries(sections[place::TEXT_STARTS]),
            texts: Pool::Bytes(sections[place::TEXTS]),
            segment_count,
        }
    }

    /// The locale of `bank` with this tag.
    pub(crate) fn locale(&self, bank: Origin, tag: &str) -> Option<Locale<'data>> {
        self.locales(bank).find(|locale| locale.tag_bytes() == Some(tag.as_bytes()))
    }

    /// The locale at this place, as one of `bank`.
    pub(crate) fn at(&self, bank: Origin, place: usize) -> Option<Locale<'data>> {
        let record = self.records.get(place)?;
        let start = place.checked_mul(self.segment_count)?;
        let starts = self.starts.get(start..=start.checked_add(self.segment_count)?)?;
        Some(Locale { bank, record, names: self.names, starts, texts: self.texts })
    }

    /// The locales, as those of `bank`.
    pub(crate) fn locales(&self, bank: Origin) -> Locales<'data> {
        Locales { bank, table: *self, next: 0 }
    }
}

/// A locale of a bank: where its texts are.
///
/// Look it up once, with [`Bank::locale`], and pass it to every text query.
///
/// A locale knows its bank. With a segment of another bank, or of another version of its bank, there is no text
/// (and debug builds stop with an assertion): look it up again when a bank is replaced.
///
/// Equal are locales of one bank with equal tags.
#[derive(Clone, Copy)]
pub struct Locale<'data> {
    pub(crate) bank: Origin,
    record: &'data LocaleRecord,
    names: Pool<'data>,
    /// This locale's text starts: one per segment, and the entry behind them.
    pub(crate) starts: &'data [U32],
    pub(crate) texts: Pool<'data>,
}

impl<'data> Locale<'data> {
    /// The tag, as in `text_en-us` of a Lipz file: `en-us`. Empty only in a damaged bank.
    pub fn tag(&self) -> &'data str {
        let record = self.record;
        self.names.text_at(record.tag_offset_bytes.get(), u32::from(record.tag_length_bytes.get())).unwrap_or("")
    }

    /// Whether this is the default locale that was set when the bank was packed.
    pub fn is_default(&self) -> bool {
        self.record.flags.get() & LOCALE_DEFAULT != 0
    }

    /// Whether the locale is one of `bank`, or of a text bank beside it.
    pub fn is_of(&self, bank: &Bank<'_>) -> bool {
        self.bank == bank.origin()
    }

    fn tag_bytes(&self) -> Option<&'data [u8]> {
        let start = self.record.tag_offset_bytes.get() as usize;
        self.names.slice(start, start.checked_add(usize::from(self.record.tag_length_bytes.get()))?)
    }
}

impl PartialEq for Locale<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.bank == other.bank && self.tag_bytes() == other.tag_bytes()
    }
}
impl Eq for Locale<'_> {}

/// The tag, not the texts.
impl fmt::Debug for Locale<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Locale({:?})", self.tag())
    }
}

/// The locales of a file in the order of their tags.
#[derive(Clone)]
pub struct Locales<'data> {
    bank: Origin,
    table: LocaleTable<'data>,
    next: usize,
}

impl<'data> Iterator for Locales<'data> {
    type Item = Locale<'data>;

    fn next(&mut self) -> Option<Locale<'data>> {
        let locale = self.table.at(self.bank, self.next)?;
        self.next = self.next.saturating_add(1);
        Some(locale)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.table.records.len().saturating_sub(self.next);
        (0, Some(left))
    }
}

impl FusedIterator for Locales<'_> {}

/// The locales that are left.
impl fmt::Debug for Locales<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.clone()).finish()
    }
}
