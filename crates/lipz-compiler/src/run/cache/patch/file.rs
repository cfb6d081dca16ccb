//! The file of a patched bank: the sections of the old one, except for changed ones.

use super::splice::Splices;
use crate::run::cache::old_bank::{OldBank, Pass};
use lipz_layout::{CHECKED_FROM, DirectoryEntry, Header, MAX_SECTIONS, RunningChecksum, SECTION_ALIGNMENT, Tag};
use zerocopy::{FromBytes, IntoBytes};

/// Changed sections.
pub(super) struct NewSections<'s> {
    /// Sections of the same length, with functions that update the old one in place.
    pub(super) tables: [(Tag, &'s Renewal<'s>); 3],
    pub(super) spliced: [(Tag, &'s Splices); 2],
}

/// Updates a table of the old bank to that of the new one; `None` if that is impossible.
pub(super) type Renewal<'s> = dyn Fn(&mut [u8]) -> Option<()> + 's;

/// The part of the new bank that has been written, and the part of the old one that has been read.
pub(super) struct NewFile<'o> {
    old: Pass<'o>,
    checksum: RunningChecksum,
}

impl NewFile<'_> {
    /// Copies the data at this offset of the old bank.
    pub(super) fn keep(&mut self, offset: usize, place: &mut [u8]) -> Option<()> {
        self.old.read(offset, place, |piece| self.checksum.add(piece))
    }

    /// Writes an updated table, which is in memory, to its place.
    fn renew(&mut self, old: &[u8], renewal: &Renewal<'_>, place: &mut [u8]) -> Option<()> {
        (old.len() == place.len()).then(|| place.copy_from_slice(old))?;
        renewal(place)?;
        self.checksum.add(place);
        Some(())
    }

    /// Writes new data to its place.
    pub(super) fn put(&mut self, bytes: &[u8], place: &mut [u8]) -> Option<()> {
        self.checksum.add(bytes);
        (bytes.len() == place.len()).then(|| place.copy_from_slice(bytes))
    }
}

/// Returns the bank with these sections and all others of the old one, in the old order; `None` if the old bank is not
/// the verified one. It is made in `room`, and every byte of that is overwritten.
pub(super) fn file(old: &OldBank, new: &NewSections<'_>, room: Vec<u8>) -> Option<Vec<u8>> {
    let tables = old.tables();
    let (mut header, rest) = Header::read_from_prefix(tables).ok()?;
    let count = (header.section_count.get() as usize).min(MAX_SECTIONS);
    let (old_directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).ok()?;
    let (directory, end) = directory(old_directory, new)?;
    header.file_length_bytes = u32::try_from(end).ok()?.into();
    let mut bank = resized(room, end);
    let (head, _) = bank.split_at_mut_checked(size_of::<Header>() + directory.as_bytes().len())?;
    head.copy_from_slice(&[header.as_bytes(), directory.as_bytes()].concat());
    let mut file = NewFile { old: old.pass(), checksum: RunningChecksum::default() };
    file.checksum.add(head.get(CHECKED_FROM..)?);
    let mut written_end = head.len();
    for (entry, before) in std::iter::zip(&directory, old_directory) {
        let start = entry.offset_bytes.get() as usize;
        let gap = bank.get_mut(written_end..start)?;
        file.put(&vec![0; gap.len()], gap)?;
        written_end = start + entry.length_bytes.get() as usize;
        let place = bank.get_mut(start..written_end)?;
        let old_start = before.offset_bytes.get() as usize;
        let old_place = old_start..old_start.checked_add(before.length_bytes.get() as usize)?;
        if let Some((_, renewal)) = new.tables.iter().find(|(tag, _)| tag.0 == entry.tag) {
            file.renew(tables.get(old_place)?, renewal, place)?;
        } else if let Some((_, splices)) = new.spliced.iter().find(|(tag, _)| tag.0 == entry.tag) {
            splices.write(&mut file, old_place, place)?;
        } else {
            file.keep(old_start, place)?;
        }
    }
    header.checksum = file.checksum.finish().into();
    bank.get_mut(..size_of::<Header>())?.copy_from_slice(header.as_bytes());
    file.old.proves().then_some(bank)
}

/// Returns the directory of the new bank, and the end of its last section.
fn directory(old: &[DirectoryEntry], new: &NewSections<'_>) -> Option<(Vec<DirectoryEntry>, usize)> {
    let mut directory = old.to_vec();
    let mut end = size_of::<Header>() + old.as_bytes().len();
    for entry in &mut directory {
        let offset = end.next_multiple_of(SECTION_ALIGNMENT as usize);
        let old_length = entry.length_bytes.get() as usize;
        let splices = new.spliced.iter().find(|(tag, _)| tag.0 == entry.tag);
        let length = splices.map_or(Some(old_length), |(_, splices)| splices.length(old_length))?;
        end = offset.checked_add(length)?;
        entry.offset_bytes = u32::try_from(offset).ok()?.into();
        entry.length_bytes = u32::try_from(length).ok()?.into();
    }
    Some((directory, end))
}

/// Resizes a buffer, with unspecified contents. New memory is already zeroed.
fn resized(mut room: Vec<u8>, length: usize) -> Vec<u8> {
    if room.capacity() == 0 {
        return vec![0; length];
    }
    room.reserve_exact(length.saturating_sub(room.len()));
    room.resize(length, 0);
    room
}
