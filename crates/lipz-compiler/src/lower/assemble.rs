//! Header, directory and sections in one file.

use super::{fit, too_large};
use crate::Report;
use lipz_bank::layout::{
    CHECKED_FROM, DirectoryEntry, FORMAT_MAJOR, FORMAT_MINOR, Header, MAGIC, SECTION_ALIGNMENT, SECTION_REQUIRED, Tag,
    U16, checksum,
};
use rayon::prelude::*;
use zerocopy::IntoBytes;

/// Sections start at multiples of a cache line.
const ALIGNMENT: usize = SECTION_ALIGNMENT as usize;

/// Pieces that a thread copies before it asks for more.
const PIECES_AT_A_TIME: usize = 1024;

/// A section to be written: pieces that are copied one behind the other.
pub(super) struct Section<'b> {
    tag: Tag,
    pieces: Vec<&'b [u8]>,
    entry_bytes: usize,
    flags: u16,
}

impl<'b> Section<'b> {
    /// A section of [`Tag::REQUIRED`].
    pub(super) fn required(tag: Tag, bytes: &'b [u8]) -> Section<'b> {
        Section::of_pieces(tag, vec![bytes])
    }

    /// A section of [`Tag::REQUIRED`] or [`Tag::OPTIONAL`], in pieces.
    pub(super) fn of_pieces(tag: Tag, pieces: Vec<&'b [u8]>) -> Section<'b> {
        let bytes_of = |table: &[(Tag, usize)]| table.iter().find(|(known, _)| *known == tag).map(|(_, bytes)| *bytes);
        let required = bytes_of(&Tag::REQUIRED);
        Section {
            tag,
            pieces,
            entry_bytes: required.or_else(|| bytes_of(&Tag::OPTIONAL)).unwrap_or(1),
            flags: if required.is_some() { SECTION_REQUIRED } else { 0 },
        }
    }
}

/// The file: header, directory, sections in the order given, zeros between them.
pub(super) fn assemble(sections: &[Section<'_>], index_seed: u64, fingerprint: u64) -> Result<Vec<u8>, Report> {
    let directory_end = size_of::<Header>() + sections.len() * size_of::<DirectoryEntry>();
    let mut directory = Vec::with_capacity(sections.len());
    let mut end = directory_end;
    for section in sections {
        let offset = end.next_multiple_of(ALIGNMENT);
        let length = length(&section.pieces);
        end = offset + length;
        directory.push(DirectoryEntry {
            tag: section.tag.0,
            offset_bytes: fit(offset, "sections")?.into(),
            length_bytes: fit(length, "sections")?.into(),
            entry_bytes: U16::new(u16::try_from(section.entry_bytes).map_err(|_| too_large("entries"))?),
            flags: section.flags.into(),
        });
    }
    let mut header = Header {
        magic: MAGIC,
        checksum: 0.into(),
        file_length_bytes: fit(end, "sections")?.into(),
        format_major: FORMAT_MAJOR.into(),
        format_minor: FORMAT_MINOR.into(),
        fingerprint: fingerprint.into(),
        index_seed: index_seed.into(),
        section_count: fit(sections.len(), "sections")?.into(),
        reserved: [0; 20],
    };
    // Zeros straight from the system, touched only where a section is written.
    let mut bank = vec![0; end];
    bank[..size_of::<Header>()].copy_from_slice(header.as_bytes());
    bank[size_of::<Header>()..directory_end].copy_from_slice(directory.as_bytes());
    let mut places = Vec::new();
    let (mut rest, mut at) = (bank.as_mut_slice(), 0);
    for (section, entry) in std::iter::zip(sections, &directory) {
        let offset = entry.offset_bytes.get() as usize;
        rest = &mut rest[offset - at..];
        at = offset;
        for pieces in section.pieces.chunks(PIECES_AT_A_TIME) {
            let length = length(pieces);
            let (place, behind) = rest.split_at_mut(length);
            places.push((place, pieces));
            rest = behind;
            at += length;
        }
    }
    places.into_par_iter().for_each(|(place, pieces)| copy(pieces, place));
    header.checksum = checksum(&bank[CHECKED_FROM..]).into();
    bank[..size_of::<Header>()].copy_from_slice(header.as_bytes());
    Ok(bank)
}

/// Bytes of all `pieces`.
fn length(pieces: &[&[u8]]) -> usize {
    pieces.iter().map(|piece| piece.len()).sum()
}

/// Copies `pieces` one behind the other to `place`, which has their length.
fn copy(pieces: &[&[u8]], mut place: &mut [u8]) {
    for piece in pieces {
        let (to, behind) = place.split_at_mut(piece.len());
        to.copy_from_slice(piece);
        place = behind;
    }
}
