//! The full check of a bank: every byte and every reference, with constant stack and in a time that is proportional to
//! the length of the file, whatever the bytes are.
//!
//! The data of the clips follows in the order of their keys, without gaps or overlap, as the compiler writes it. This
//! is checked as well. Otherwise, the clips of a forged bank could all refer to the same bytes, which would then be
//! checked over and over.

mod clips;
mod events;
mod sections;
mod strings;
mod texts;

use crate::file::File;
use crate::locale::LocaleTable;
use crate::pool::Pool;
use crate::{Bank, Error, ErrorKind};
use strings::Strings;
use texts::TextCheck;

/// Returns bytes as a string if they are UTF-8.
pub(crate) type Utf8<'data> = fn(&'data [u8]) -> Option<&'data str>;

/// The UTF-8 check of the standard library.
pub(crate) fn core_utf8(bytes: &[u8]) -> Option<&str> {
    core::str::from_utf8(bytes).ok()
}

/// Checks the bank and marks its pools as checked.
pub(crate) fn verify<'data>(bank: &mut Bank<'data>, utf8: Utf8<'data>) -> Result<(), Error> {
    lines(bank, utf8)?;
    optional(bank)
}

/// Checks everything except the checksum and the contents of frames and texts.
pub(crate) fn tables(mut bank: Bank<'_>) -> Result<(), Error> {
    required::<false>(&mut bank, core_utf8)?;
    optional(&bank)
}

/// Checks the optional sections of a bank. The check of a section's contents is next to its queries.
fn optional(bank: &Bank<'_>) -> Result<(), Error> {
    sections::optional_sections(bank)?;
    crate::babble::check(bank)?;
    crate::face::check(bank)?;
    crate::recording::check(bank)?;
    crate::curve::check(bank)?;
    crate::articulation::check(bank)?;
    crate::voice::check(bank)
}

/// Checks visemes, texts and events, which all banks have, and marks the pools as checked.
pub(crate) fn lines<'data>(bank: &mut Bank<'data>, utf8: Utf8<'data>) -> Result<(), Error> {
    checksum(&bank.file)?;
    required::<true>(bank, utf8)
}

/// Checks the sections that all banks have. Without `CONTENTS`, the contents of frames and texts are skipped.
fn required<'data, const CONTENTS: bool>(bank: &mut Bank<'data>, utf8: Utf8<'data>) -> Result<(), Error> {
    sections::sections(&bank.file)?;
    sections::table_lengths(bank)?;
    check_pool(&bank.file, &mut bank.names, utf8)?;
    if CONTENTS {
        check_pool(&bank.file, &mut bank.texts.texts, utf8)?;
    }
    bank.texts.names = bank.names;
    check_pool(&bank.file, &mut bank.event_strings, utf8)?;
    clips::rates(bank)?;
    let keys_end = clips::clips::<CONTENTS>(bank)?;
    locales(&bank.file, &bank.texts, keys_end)?;
    events::events(bank)?;
    if lipz_layout::fingerprint(bank.keys, bank.clips) != bank.file.header.fingerprint.get() {
        return Err(Error::new(ErrorKind::Fingerprint, 24));
    }
    Ok(())
}

/// Checks the texts in a file against the verified bank of their clips, and marks their pools as checked.
pub(crate) fn text_file<'data>(
    file: &File<'data>,
    table: &mut LocaleTable<'data>,
    bank: &Bank<'_>,
    utf8: Utf8<'data>,
) -> Result<(), Error> {
    if !bank.is_verified() {
        return Err(Error::new(ErrorKind::BankNotVerified, 0));
    }
    checksum(file)?;
    sections::sections(file)?;
    sections::text_lengths(file, table)?;
    for pool in [&mut table.names, &mut table.texts] {
        check_pool(file, pool, utf8)?;
    }
    // In a bank, the tags follow the keys.
    let start = table.records.first().map_or(0, |first| first.tag_offset_bytes.get());
    locales(file, table, start)?;
    let is_about_bank = table.segment_count == bank.texts.segment_count;
    if file.header.fingerprint.get() != bank.fingerprint() || !is_about_bank {
        return Err(Error::new(ErrorKind::OtherClips, 24));
    }
    let check = TextCheck::new(file, table, true);
    for (clip, record) in bank.clips.iter().zip(bank.keys) {
        check.clip(clip, record)?;
    }
    Ok(())
}

/// Checks the checksum and the sections of a set's index, and returns its names as checked.
pub(crate) fn set_index<'data>(file: &File<'data>, mut names: Pool<'data>) -> Result<Pool<'data>, Error> {
    checksum(file)?;
    sections::sections(file)?;
    check_pool(file, &mut names, core_utf8)?;
    Ok(names)
}

fn checksum(file: &File<'_>) -> Result<(), Error> {
    let checked = file.bytes.get(lipz_layout::CHECKED_FROM..).unwrap_or(&[]);
    if lipz_layout::checksum(checked) != file.header.checksum.get() {
        return Err(Error::new(ErrorKind::Checksum, 8));
    }
    Ok(())
}

/// Returns an error at the offset of `item`, which must be in the file.
pub(crate) fn error_in<T: ?Sized>(file: &File<'_>, kind: ErrorKind, item: &T) -> Error {
    let item = item as *const T as *const u8 as usize;
    Error::new(kind, item.wrapping_sub(file.bytes.as_ptr() as usize) as u32)
}

/// Returns an error at the offset of `item`, which must be in the bank.
pub(crate) fn error_at<T: ?Sized>(bank: &Bank<'_>, kind: ErrorKind, item: &T) -> Error {
    error_in(&bank.file, kind, item)
}

/// Checks the strings of a pool, and marks them as checked.
fn check_pool<'data>(file: &File<'data>, pool: &mut Pool<'data>, utf8: Utf8<'data>) -> Result<(), Error> {
    let bytes = pool.bytes();
    // Reject a string that is not made of these very bytes.
    let checked = utf8(bytes).filter(|text| core::ptr::eq(text.as_bytes(), bytes));
    match checked.map_or_else(|| core::str::from_utf8(bytes), Ok) {
        Ok(text) => {
            *pool = Pool::Checked(text);
            Ok(())
        }
        Err(error) => {
            let behind = bytes.get(error.valid_up_to()..).unwrap_or(bytes);
            Err(error_in(file, ErrorKind::Utf8, behind))
        }
    }
}

/// Checks that tags ascend strictly and fill the pool of names from `start` on, and that at most one locale is the
/// default.
fn locales(file: &File<'_>, table: &LocaleTable<'_>, start: u32) -> Result<(), Error> {
    let mut tags = Strings::new(table.names, start);
    let mut known_flags = lipz_layout::LOCALE_DEFAULT;
    for record in table.records {
        let (offset, length) = (record.tag_offset_bytes.get(), record.tag_length_bytes.get());
        let flags = record.flags.get();
        if tags.next_ascending(offset, u32::from(length)).is_none() || flags & !known_flags != 0 {
            return Err(error_in(file, ErrorKind::LocaleOrder, record));
        }
        known_flags &= !flags;
    }
    if !tags.fill_the_pool() {
        return Err(error_in(file, ErrorKind::LocaleOrder, table.records));
    }
    Ok(())
}
