//! The full check of a bank: every byte and every reference, with constant stack and in a time that
//! is proportional to the length of the file, whatever the bytes are.
//!
//! What the clips own lies in the order of their keys, without gaps and without overlap, as the
//! compiler writes it. That is checked, too: it is what keeps a forged bank, in which all clips
//! claim the same bytes, from being checked over and over.

mod clips;
mod events;
mod sections;
mod texts;

use crate::layout::{self, LocaleRecord};
use crate::pool::Pool;
use crate::{Bank, Error, ErrorKind};

/// Checks the bank and marks its pools as checked.
pub(crate) fn verify(bank: &mut Bank<'_>) -> Result<(), Error> {
    let checked = bank.bytes.get(layout::CHECKED_FROM..).unwrap_or(&[]);
    if layout::checksum(checked) != bank.header.checksum.get() {
        return Err(Error::new(ErrorKind::Checksum, 8));
    }
    sections::sections(bank)?;
    bank.names = checked_pool(bank, bank.names)?;
    bank.texts = checked_pool(bank, bank.texts)?;
    bank.event_strings = checked_pool(bank, bank.event_strings)?;
    let keys_end = clips::clips(bank)?;
    locales(bank, keys_end)?;
    events::events(bank)?;
    if layout::fingerprint(bank.clips) != bank.header.fingerprint.get() {
        return Err(Error::new(ErrorKind::Fingerprint, 24));
    }
    Ok(())
}

/// An error at the place of `item`, which lies in the bank.
fn error_at<T: ?Sized>(bank: &Bank<'_>, kind: ErrorKind, item: &T) -> Error {
    let item = item as *const T as *const u8 as usize;
    Error::new(kind, item.wrapping_sub(bank.bytes.as_ptr() as usize) as u32)
}

fn checked_pool<'data>(bank: &Bank<'data>, pool: Pool<'data>) -> Result<Pool<'data>, Error> {
    let bytes = pool.bytes();
    match core::str::from_utf8(bytes) {
        Ok(text) => Ok(Pool::Checked(text)),
        Err(error) => {
            let behind = bytes.get(error.valid_up_to()..).unwrap_or(bytes);
            Err(error_at(bank, ErrorKind::Utf8, behind))
        }
    }
}

/// Tags ascend strictly and fill the pool of names from `end` on; one locale at most is the default.
fn locales(bank: &Bank<'_>, mut end: u32) -> Result<(), Error> {
    let mut before = "";
    let mut has_default = false;
    let tag = |record: &LocaleRecord| {
        bank.names.text_at(record.tag_offset_bytes.get(), u32::from(record.tag_length_bytes.get()))
    };
    for record in bank.locales {
        let is_default = record.flags.get() & layout::LOCALE_DEFAULT != 0;
        let flags_are_known = record.flags.get() & !layout::LOCALE_DEFAULT == 0;
        match tag(record) {
            Some(tag)
                if tag > before
                    && flags_are_known
                    && !(is_default && has_default)
                    && record.tag_offset_bytes.get() == end =>
            {
                before = tag;
            }
            _ => return Err(error_at(bank, ErrorKind::LocaleOrder, record)),
        }
        has_default |= is_default;
        end = end.wrapping_add(u32::from(record.tag_length_bytes.get()));
    }
    if end as usize != bank.names.bytes().len() {
        return Err(error_at(bank, ErrorKind::LocaleOrder, bank.locales));
    }
    Ok(())
}
