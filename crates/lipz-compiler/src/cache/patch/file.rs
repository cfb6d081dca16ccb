//! The file of a patched bank: the sections of the old one, but for those that change.

use super::splice::Splices;
use crate::cache::old_bank::OldBank;
use lipz_layout::{CHECKED_FROM, DirectoryEntry, Header, MAX_SECTIONS, SECTION_ALIGNMENT, Tag, checksum};
use zerocopy::{FromBytes, IntoBytes};

/// Sections that are no longer what they were.
pub(super) struct NewSections<'s> {
    /// Of the same length.
    pub(super) tables: [(Tag, &'s [u8]); 3],
    pub(super) spliced: [(Tag, &'s Splices); 2],
}

/// The bank with these sections and all others of the old one, in the order of the old one. It is made in `room`, and every
/// byte of that is written.
pub(super) fn file(old: &OldBank, new: &NewSections<'_>, room: Vec<u8>) -> Option<Vec<u8>> {
    let tables = old.tables();
    let (mut header, rest) = Header::read_from_prefix(tables).ok()?;
    let count = (header.section_count.get() as usize).min(MAX_SECTIONS);
    let (old_directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).ok()?;
    let mut directory = old_directory.to_vec();
    let directory_end = size_of::<Header>() + directory.as_bytes().len();
    let mut end = directory_end;
    for entry in &mut directory {
        let offset = end.next_multiple_of(SECTION_ALIGNMENT as usize);
        let old_length = entry.length_bytes.get() as usize;
        let splices = new.spliced.iter().find(|(tag, _)| tag.0 == entry.tag);
        let length = splices.map_or(Some(old_length), |(_, splices)| splices.length(old_length))?;
        end = offset.checked_add(length)?;
        entry.offset_bytes = u32::try_from(offset).ok()?.into();
        entry.length_bytes = u32::try_from(length).ok()?.into();
    }
    header.file_length_bytes = u32::try_from(end).ok()?.into();
    let mut bank = resized(room, end);
    let mut written_end = directory_end;
    for (entry, before) in std::iter::zip(&directory, old_directory) {
        let start = entry.offset_bytes.get() as usize;
        bank.get_mut(written_end..start)?.fill(0);
        written_end = start + entry.length_bytes.get() as usize;
        let place = bank.get_mut(start..start + entry.length_bytes.get() as usize)?;
        let old_start = before.offset_bytes.get() as usize;
        let old_place = old_start..old_start + before.length_bytes.get() as usize;
        if let Some((_, table)) = new.tables.iter().find(|(tag, _)| tag.0 == entry.tag) {
            (table.len() == place.len()).then(|| place.copy_from_slice(table))?;
        } else if let Some((_, splices)) = new.spliced.iter().find(|(tag, _)| tag.0 == entry.tag) {
            splices.write(old, old_place, place)?;
        } else {
            old.read(old_start, place)?;
        }
    }
    bank.get_mut(size_of::<Header>()..directory_end)?.copy_from_slice(directory.as_bytes());
    header.checksum = {
        bank.get_mut(..size_of::<Header>())?.copy_from_slice(header.as_bytes());
        checksum(bank.get(CHECKED_FROM..)?).into()
    };
    bank.get_mut(..size_of::<Header>())?.copy_from_slice(header.as_bytes());
    Some(bank)
}

/// Room for so many bytes, with anything in it. New memory is zero already.
fn resized(mut room: Vec<u8>, length: usize) -> Vec<u8> {
    if room.capacity() == 0 {
        return vec![0; length];
    }
    room.reserve_exact(length.saturating_sub(room.len()));
    room.resize(length, 0);
    room
}
