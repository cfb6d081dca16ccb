//! The full check of a bank: every byte and every reference, with constant stack and in a time that
//! is proportional to the length of the file, whatever the bytes are.
//!
//! What the clips own lies in the order of their keys, without gaps and without overlap, as the
//! compiler writes it. That is checked, too: it is what keeps a forged bank, in which all clips
//! claim the same bytes, from being checked over and over.

mod babble;
mod clips;
mod events;
mod sections;
mod texts;

use crate::file::File;
use crate::layout::{self, LocaleRecord};
use crate::locale::LocaleTable;
use crate::pool::Pool;
use crate::{Bank, Error, ErrorKind, TextBank};
use texts::TextCheck;

/// Gives bytes as a string if they are UTF-8.
pub(crate) type Utf8<'data> = fn(&'data [u8]) -> Option<&'data str>;

/// The check of the standard library.
pub(crate) fn core_utf8(bytes: &[u8]) -> Option<&str> {
    core::str::from_utf8(bytes).ok()
}

/// Checks the bank and marks its pools as checked.
pub(crate) fn verify<'data>(bank: &mut Bank<'data>, utf8: Utf8<'data>) -> Result<(), Error> {
    checksum(&bank.file)?;
    sections::sections(&bank.file)?;
    sections::table_lengths(bank)?;
    check_pools(&bank.file, &mut bank.texts, utf8)?;
    bank.names = bank.texts.names;
    bank.event_strings = checked_pool(&bank.file, bank.event_strings, utf8)?;
    let keys_end = clips::clips(bank)?;
    locales(&bank.file, &bank.texts, keys_end)?;
    events::events(bank)?;
    babble::babble(bank)?;
    if layout::fingerprint(bank.clips) != bank.file.header.fingerprint.get() {
        return Err(Error::new(ErrorKind::Fingerprint, 24));
    }
    Ok(())
}

/// Checks a text bank against the bank of its clips, and marks its pools as checked.
pub(crate) fn verify_texts<'data>(
    texts: &mut TextBank<'data>,
    bank: &Bank<'_>,
    utf8: Utf8<'data>,
) -> Result<(), Error> {
    let file = texts.file;
    checksum(&file)?;
    sections::sections(&file)?;
    sections::text_index_length(&file, &texts.table)?;
    check_pools(&file, &mut texts.table, utf8)?;
    // Another bank's tags stand behind its keys.
    let start = texts.table.records.first().map_or(0, |first| first.tag_offset_bytes.get());
    locales(&file, &texts.table, start)?;
    if file.header.fingerprint.get() != bank.fingerprint() || texts.table.clip_count != bank.clip_count() {
        return Err(Error::new(ErrorKind::OtherClips, 24));
    }
    let mut check = TextCheck::of(file, texts.table);
    bank.clips().try_for_each(|clip| check.clip(&clip))
}

fn checksum(file: &File<'_>) -> Result<(), Error> {
    let checked = file.bytes.get(layout::CHECKED_FROM..).unwrap_or(&[]);
    if layout::checksum(checked) != file.header.checksum.get() {
        return Err(Error::new(ErrorKind::Checksum, 8));
    }
    Ok(())
}

/// An error at the place of `item`, which lies in the file.
fn error_in<T: ?Sized>(file: &File<'_>, kind: ErrorKind, item: &T) -> Error {
    let item = item as *const T as *const u8 as usize;
    Error::new(kind, item.wrapping_sub(file.bytes.as_ptr() as usize) as u32)
}

/// An error at the place of `item`, which lies in the bank.
fn error_at<T: ?Sized>(bank: &Bank<'_>, kind: ErrorKind, item: &T) -> Error {
    error_in(&bank.file, kind, item)
}

/// Checks the strings of a file's locales.
fn check_pools<'data>(file: &File<'data>, table: &mut LocaleTable<'data>, utf8: Utf8<'data>) -> Result<(), Error> {
    table.names = checked_pool(file, table.names, utf8)?;
    table.texts = checked_pool(file, table.texts, utf8)?;
    Ok(())
}

fn checked_pool<'data>(file: &File<'data>, pool: Pool<'data>, utf8: Utf8<'data>) -> Result<Pool<'data>, Error> {
    let bytes = pool.bytes();
    // A string that is not these very bytes would be an answer to another question.
    if let Some(text) = utf8(bytes).filter(|text| core::ptr::eq(text.as_bytes(), bytes)) {
        return Ok(Pool::Checked(text));
    }
    match core::str::from_utf8(bytes) {
        Ok(text) => Ok(Pool::Checked(text)),
        Err(error) => {
            let behind = bytes.get(error.valid_up_to()..).unwrap_or(bytes);
            Err(error_in(file, ErrorKind::Utf8, behind))
        }
    }
}

/// Tags ascend strictly and fill the pool of names from `end` on; one locale at most is the default.
fn locales(file: &File<'_>, table: &LocaleTable<'_>, mut end: u32) -> Result<(), Error> {
    let mut before = "";
    let mut has_default = false;
    let tag = |record: &LocaleRecord| {
        table.names.text_at(record.tag_offset_bytes.get(), u32::from(record.tag_length_bytes.get()))
    };
    for record in table.records {
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
            _ => return Err(error_in(file, ErrorKind::LocaleOrder, record)),
        }
        has_default |= is_default;
        end = end.wrapping_add(u32::from(record.tag_length_bytes.get()));
    }
    if end as usize != table.names.bytes().len() {
        return Err(error_in(file, ErrorKind::LocaleOrder, table.records));
    }
    Ok(())
}
