//! Checks sections: they follow each other in the order of the directory, and each tag appears once.

use super::{error_at, error_in};
use crate::file::File;
use crate::locale::LocaleTable;
use crate::{Bank, Error, ErrorKind};
use core::mem::size_of_val;
use lipz_layout::{DirectoryEntry, SECTION_ALIGNMENT, TEXT_OFFSET, Tag};

/// Checks places and tags of all sections, known or not.
pub(super) fn sections(file: &File<'_>) -> Result<(), Error> {
    // `open` has checked that the directory and the sections are in the file, and that there are at most 64.
    let mut end = size_of_val(file.header).wrapping_add(size_of_val(file.directory));
    let mut before: &[_] = &[];
    for (index, entry) in file.directory.iter().enumerate() {
        if before.iter().any(|other: &DirectoryEntry| other.tag == entry.tag) {
            return Err(error_in(file, ErrorKind::SectionTwice, entry));
        }
        let gap = (entry.offset_bytes.get() as usize).checked_sub(end);
        let is_aligned = entry.offset_bytes.get() % SECTION_ALIGNMENT == 0;
        if !is_aligned || gap.map_or(true, |gap| gap >= SECTION_ALIGNMENT as usize) {
            return Err(error_in(file, ErrorKind::SectionPlace, entry));
        }
        end = (entry.offset_bytes.get() as usize).wrapping_add(entry.length_bytes.get() as usize);
        before = file.directory.get(..=index).unwrap_or(before);
    }
    if end != file.bytes.len() {
        return Err(error_in(file, ErrorKind::SectionPlace, file.directory));
    }
    Ok(())
}

/// Checks the lengths of parallel tables.
pub(super) fn table_lengths(bank: &Bank<'_>) -> Result<(), Error> {
    if bank.key_order.len() != bank.clips.len() {
        return Err(error_at(bank, ErrorKind::ClipOrder, bank.key_order));
    }
    if bank.keys.len() != bank.clips.len() {
        return Err(error_at(bank, ErrorKind::ClipKey, bank.keys));
    }
    text_lengths(&bank.file, &bank.texts)
}

/// Checks the shapes of optional sections, and that a bank has all sections of a group or none.
pub(super) fn optional_sections(bank: &Bank<'_>) -> Result<(), Error> {
    for section in &Tag::OPTIONAL {
        let entry = match bank.file.entry(section.tag) {
            Some(entry) => entry,
            None => continue,
        };
        let mut group = Tag::OPTIONAL.iter().filter(|other| other.group == section.group);
        if group.any(|other| bank.file.entry(other.tag).is_none()) {
            return Err(error_at(bank, ErrorKind::SectionMissing, entry));
        }
        let length = entry.length_bytes.get() as usize;
        let is_filled = if section.is_per_clip {
            bank.clips.len().checked_mul(section.entry_bytes) == Some(length)
        } else {
            // The length of an entry is a power of two.
            length & section.entry_bytes.wrapping_sub(1) == 0
        };
        if usize::from(entry.entry_bytes.get()) != section.entry_bytes || !is_filled {
            return Err(error_at(bank, ErrorKind::SectionShape, entry));
        }
    }
    Ok(())
}

/// Checks that there is a text start for each segment in each locale, and that the last one ends with the pool.
pub(super) fn text_lengths(file: &File<'_>, table: &LocaleTable<'_>) -> Result<(), Error> {
    let texts_end = table.starts.split_last().map(|(end, starts)| (end.get() as usize, starts.len()));
    let segments = table.records.len().checked_mul(table.segment_count);
    let pool_length = table.texts.bytes().len();
    // This ensures that the count that `NO_TEXT` seems to refer to is outside of the pool.
    if texts_end != segments.map(|count| (pool_length, count)) || pool_length > TEXT_OFFSET as usize {
        return Err(error_in(file, ErrorKind::TextReference, table.starts));
    }
    Ok(())
}
