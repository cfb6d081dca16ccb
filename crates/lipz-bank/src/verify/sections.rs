//! Sections: in the order of the directory, one behind the other, each tag once.

use super::{error_at, error_in};
use crate::file::File;
use crate::locale::LocaleTable;
use crate::{Bank, Error, ErrorKind};
use core::mem::size_of_val;
use lipz_layout::{DirectoryEntry, SECTION_ALIGNMENT, TEXT_OFFSET, Tag};

/// Checks places and tags of all sections, known or not.
pub(super) fn sections(file: &File<'_>) -> Result<(), Error> {
    // `open` has found directory and sections in the file, and no more than 64 of them.
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

/// Checks the lengths of tables that run parallel to others.
pub(super) fn table_lengths(bank: &Bank<'_>) -> Result<(), Error> {
    if bank.key_order.len() != bank.clips.len() {
        return Err(error_at(bank, ErrorKind::ClipOrder, bank.key_order));
    }
    if bank.keys.len() != bank.clips.len() {
        return Err(error_at(bank, ErrorKind::ClipKey, bank.keys));
    }
    text_lengths(&bank.file, &bank.texts)
}

/// Checks the shapes of sections that a bank may have.
pub(super) fn optional_sections(bank: &Bank<'_>) -> Result<(), Error> {
    let has_shape =
        |entry: &DirectoryEntry, (_, entry_bytes): (Tag, usize)| usize::from(entry.entry_bytes.get()) == entry_bytes;
    let [
        of_babble,
        of_faces,
        of_recordings,
        of_curve_clips,
        of_curves,
        of_curve_keys,
        of_voices,
        of_dubs,
        of_index,
        of_sources,
        _of_layer,
    ] = Tag::OPTIONAL;
    for of_profiles in [of_babble, of_faces] {
        if let Some(profiles) = bank.file.entry(of_profiles.0).filter(|entry| !has_shape(entry, of_profiles)) {
            return Err(error_at(bank, ErrorKind::SectionShape, profiles));
        }
    }
    if let Some(recordings) = bank.file.entry(of_recordings.0) {
        let length = bank.clips.len().checked_mul(of_recordings.1);
        if !has_shape(recordings, of_recordings) || length != Some(recordings.length_bytes.get() as usize) {
            return Err(error_at(bank, ErrorKind::SectionShape, recordings));
        }
    }
    together(bank, &[of_curve_clips, of_curves, of_curve_keys])?;
    together(bank, &[of_voices, of_dubs])?;
    match (bank.file.entry(of_index.0), bank.file.entry(of_sources.0)) {
        (None, None) => Ok(()),
        (Some(index), Some(sources)) => {
            let length = bank.clips.len().checked_mul(4);
            if !has_shape(index, of_index) || length != Some(index.length_bytes.get() as usize) {
                return Err(error_at(bank, ErrorKind::SectionShape, index));
            }
            if !has_shape(sources, of_sources) {
                return Err(error_at(bank, ErrorKind::SectionShape, sources));
            }
            Ok(())
        }
        (Some(lonely), None) | (None, Some(lonely)) => Err(error_at(bank, ErrorKind::SectionMissing, lonely)),
    }
}

/// Checks that a bank has all of these sections or none, each filled with entries of its length.
fn together(bank: &Bank<'_>, sections: &[(Tag, usize)]) -> Result<(), Error> {
    let found = || sections.iter().filter_map(|(tag, entry_bytes)| Some((bank.file.entry(*tag)?, *entry_bytes)));
    for (entry, entry_bytes) in found() {
        if found().count() != sections.len() {
            return Err(error_at(bank, ErrorKind::SectionMissing, entry));
        }
        let is_filled = entry.length_bytes.get() & (entry_bytes as u32).wrapping_sub(1) == 0;
        if usize::from(entry.entry_bytes.get()) != entry_bytes || !is_filled {
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
    // So the count that `NO_TEXT` seems to refer to lies outside of the pool.
    if texts_end != segments.map(|count| (pool_length, count)) || pool_length > TEXT_OFFSET as usize {
        return Err(error_in(file, ErrorKind::TextReference, table.starts));
    }
    Ok(())
}
