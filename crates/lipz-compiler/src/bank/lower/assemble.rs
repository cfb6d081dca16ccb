//! Assembling header, directory and sections into one file.

use super::limits::{fit, too_large};
use lipz_diagnostics::Report;
use lipz_layout::{
    CHECKED_FROM, DirectoryEntry, FORMAT_MAJOR, FORMAT_MINOR, Header, MAGIC, SECTION_ALIGNMENT, SECTION_REQUIRED, Tag,
    U16, checksum,
};
use zerocopy::IntoBytes;

/// Sections start at multiples of a cache line.
const ALIGNMENT: usize = SECTION_ALIGNMENT as usize;

/// A section to write.
pub(crate) struct Section<'b> {
    pub(super) tag: Tag,
    length: usize,
    /// The section, or `None` if it is copied from the clips.
    pub(super) table: Option<&'b [u8]>,
    entry_bytes: usize,
    flags: u16,
}

impl<'b> Section<'b> {
    /// Creates an existing section.
    pub(crate) fn table(tag: Tag, bytes: &'b [u8]) -> Section<'b> {
        Section { table: Some(bytes), ..Section::of_clips(tag, bytes.len()) }
    }

    /// Creates a section of this length that is copied from the clips.
    pub(crate) fn of_clips(tag: Tag, length: usize) -> Section<'b> {
        let bytes_of = |table: &[(Tag, usize)]| table.iter().find(|(known, _)| *known == tag).map(|(_, bytes)| *bytes);
        let required = bytes_of(&Tag::REQUIRED).or_else(|| bytes_of(&Tag::SET));
        let optional = Tag::OPTIONAL.iter().find(|known| known.tag == tag).map(|known| known.entry_bytes);
        Section {
            tag,
            length,
            table: None,
            entry_bytes: required.or(optional).unwrap_or(1),
            flags: if required.is_some() { SECTION_REQUIRED } else { 0 },
        }
    }
}

/// Header and directory of a file with these sections in order, padded with zeros.
pub(super) struct FileHead {
    pub(super) header: Header,
    pub(super) directory: Vec<DirectoryEntry>,
    /// The length of the file.
    pub(super) end: usize,
}

impl FileHead {
    pub(super) fn new(sections: &[Section<'_>], index_seed: u64, fingerprint: u64) -> Result<FileHead, Report> {
        let mut directory = Vec::with_capacity(sections.len());
        let mut end = size_of::<Header>() + sections.len() * size_of::<DirectoryEntry>();
        for section in sections {
            let offset = end.next_multiple_of(ALIGNMENT);
            end = offset + section.length;
            directory.push(DirectoryEntry {
                tag: section.tag.0,
                offset_bytes: fit(offset, "sections")?.into(),
                length_bytes: fit(section.length, "sections")?.into(),
                entry_bytes: U16::new(u16::try_from(section.entry_bytes).map_err(|_| too_large("entries"))?),
                flags: section.flags.into(),
            });
        }
        let header = Header {
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
        Ok(FileHead { header, directory, end })
    }
}

/// Assembles the file: header, directory, and sections in order, padded with zeros. `copy` receives the slices of the
/// sections that are copied from the clips.
pub(crate) fn assemble(
    sections: &[Section<'_>],
    index_seed: u64,
    fingerprint: u64,
    copy: impl FnOnce(Vec<&mut [u8]>),
) -> Result<Vec<u8>, Report> {
    let (mut bank, mut header) = without_checksum(sections, index_seed, fingerprint, copy)?;
    header.checksum = checksum(&bank[CHECKED_FROM..]).into();
    bank[..size_of::<Header>()].copy_from_slice(header.as_bytes());
    Ok(bank)
}

/// Returns the file without its checksum, and the header that is to contain it.
pub(super) fn without_checksum(
    sections: &[Section<'_>],
    index_seed: u64,
    fingerprint: u64,
    copy: impl FnOnce(Vec<&mut [u8]>),
) -> Result<(Vec<u8>, Header), Report> {
    let FileHead { header, directory, end } = FileHead::new(sections, index_seed, fingerprint)?;
    let directory_end = size_of::<Header>() + directory.as_bytes().len();
    // The system provides zeroed pages. Only written sections touch them.
    let mut bank = vec![0; end];
    bank[..size_of::<Header>()].copy_from_slice(header.as_bytes());
    bank[size_of::<Header>()..directory_end].copy_from_slice(directory.as_bytes());
    let (mut places, mut tables) = (Vec::new(), Vec::new());
    let mut rest = &mut bank[directory_end..];
    for (section, entry) in std::iter::zip(sections, &directory) {
        let gap = entry.offset_bytes.get() as usize - (end - rest.len());
        let (place, behind) = rest[gap..].split_at_mut(section.length);
        match section.table {
            Some(table) => tables.push((place, table)),
            None => places.push(place),
        }
        rest = behind;
    }
    // Tables come last: copying frees the clips, which makes room for the tables.
    copy(places);
    tables.into_iter().for_each(|(place, table)| place.copy_from_slice(table));
    Ok((bank, header))
}
