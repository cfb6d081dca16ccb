//! The locales of a bank: handles that text queries take.

use core::fmt;
use core::iter::FusedIterator;

use crate::layout::{LocaleRecord, LOCALE_DEFAULT, U32};
use crate::pool::Pool;
use crate::Bank;

/// A locale of a bank: where its texts are.
///
/// Look it up once, with [`Bank::locale`], and pass it to every text query.
#[derive(Clone, Copy)]
pub struct Locale<'data> {
    record: &'data LocaleRecord,
    names: Pool<'data>,
    /// This locale's part of the text index: one entry per slot.
    pub(crate) index: &'data [U32],
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

    pub(crate) fn tag_bytes(&self) -> Option<&'data [u8]> {
        let start = self.record.tag_offset_bytes.get() as usize;
        self.names.slice(start, start.checked_add(usize::from(self.record.tag_length_bytes.get()))?)
    }
}

/// The tag, not the texts.
impl fmt::Debug for Locale<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Locale({:?})", self.tag())
    }
}

/// The locales of a bank in the order of their tags.
#[derive(Clone, Debug)]
pub struct Locales<'data, 'bank> {
    bank: &'bank Bank<'data>,
    next: usize,
}

impl<'data, 'bank> Locales<'data, 'bank> {
    pub(crate) fn new(bank: &'bank Bank<'data>) -> Self {
        Locales { bank, next: 0 }
    }
}

impl<'data> Iterator for Locales<'data, '_> {
    type Item = Locale<'data>;

    fn next(&mut self) -> Option<Locale<'data>> {
        let bank = self.bank;
        let record = bank.locales.get(self.next)?;
        let start = self.next.checked_mul(bank.clips.len())?;
        let index = bank.text_index.get(start..start.checked_add(bank.clips.len())?)?;
        self.next = self.next.saturating_add(1);
        Some(Locale { record, names: bank.names, index, texts: bank.texts })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.bank.locales.len().saturating_sub(self.next);
        (0, Some(left))
    }
}

impl FusedIterator for Locales<'_, '_> {}
