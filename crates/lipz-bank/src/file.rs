//! What all files of the format have: a header, a directory, and sections.

use crate::layout::{self, DirectoryEntry, Header, Tag};
use crate::{Error, ErrorKind};
use core::mem::size_of;
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

/// Where the number of sections stands in the header.
const SECTION_COUNT_OFFSET: u32 = 40;

/// A file of which header and directory are checked.
#[derive(Clone, Copy)]
pub(crate) struct File<'data> {
    pub(crate) bytes: &'data [u8],
    pub(crate) header: &'data Header,
    pub(crate) directory: &'data [DirectoryEntry],
}

impl<'data> File<'data> {
    /// Checks header and directory, in a time that depends only on the number of sections.
    pub(crate) fn open(bytes: &'data [u8]) -> Result<File<'data>, Error> {
        let (header, rest) = open_header(bytes)?;
        let count = header.section_count.get() as usize;
        if count > layout::MAX_SECTIONS {
            return Err(Error::new(ErrorKind::DirectoryTooLong, SECTION_COUNT_OFFSET));
        }
        let (directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count)
            .map_err(|_| Error::new(ErrorKind::DirectoryOutOfBounds, SECTION_COUNT_OFFSET))?;
        let file = File { bytes, header, directory };
        for (index, entry) in directory.iter().enumerate() {
            if file.contents(entry).is_none() {
                return Err(Error::new(ErrorKind::SectionOutOfBounds, entry_offset(index)));
            }
            let known = Tag::REQUIRED.iter().chain(&Tag::OPTIONAL).any(|(tag, _)| tag.0 == entry.tag);
            if !known && entry.flags.get() & layout::SECTION_REQUIRED != 0 {
                return Err(Error::new(ErrorKind::SectionUnknown, entry_offset(index)));
            }
        }
        Ok(file)
    }

    /// The contents of a section, if they lie in the file.
    pub(crate) fn contents(&self, entry: &DirectoryEntry) -> Option<&'data [u8]> {
        let start = entry.offset_bytes.get() as usize;
        let end = start.checked_add(entry.length_bytes.get() as usize)?;
        self.bytes.get(start..end)
    }

    /// The one section with this tag, as entries of type `T`.
    pub(crate) fn array<T>(&self, tag: Tag) -> Result<&'data [T], Error>
    where
        T: FromBytes + Immutable + KnownLayout + Unaligned,
    {
        let mut found = self.directory.iter().enumerate().filter(|(_, entry)| entry.tag == tag.0);
        let (index, entry) = found.next().ok_or(Error::new(ErrorKind::SectionMissing, SECTION_COUNT_OFFSET))?;
        if let Some((second, _)) = found.next() {
            return Err(Error::new(ErrorKind::SectionTwice, entry_offset(second)));
        }
        let at = entry_offset(index);
        let bytes = self.contents(entry).ok_or(Error::new(ErrorKind::SectionOutOfBounds, at))?;
        if usize::from(entry.entry_bytes.get()) != size_of::<T>() {
            return Err(Error::new(ErrorKind::SectionShape, at));
        }
        <[T]>::ref_from_bytes(bytes).map_err(|_| Error::new(ErrorKind::SectionShape, at))
    }

    /// The sections in the order of the directory, known or not.
    pub(crate) fn sections(&self) -> impl Iterator<Item = (Tag, &'data [u8])> + '_ {
        self.directory.iter().filter_map(move |entry| Some((Tag(entry.tag), self.contents(entry)?)))
    }

    /// Whether the directory has a section with this tag.
    pub(crate) fn has(&self, tag: Tag) -> bool {
        self.directory.iter().any(|entry| entry.tag == tag.0)
    }
}

/// Checks everything of the header but the checksum.
fn open_header(bytes: &[u8]) -> Result<(&Header, &[u8]), Error> {
    let magic_start = bytes.get(..4);
    let (header, rest) = Header::ref_from_prefix(bytes).map_err(|_| match magic_start {
        Some(start) if start != &layout::MAGIC[..4] => Error::new(ErrorKind::NotABank, 0),
        _ => Error::new(ErrorKind::TooShort, bytes.len() as u32),
    })?;
    if header.magic != layout::MAGIC {
        let kind = if magic_start == Some(&layout::MAGIC[..4]) { ErrorKind::TextMode } else { ErrorKind::NotABank };
        return Err(Error::new(kind, 0));
    }
    if header.format_major.get() != layout::FORMAT_MAJOR {
        return Err(Error::new(ErrorKind::UnsupportedVersion, 20));
    }
    if header.file_length_bytes.get() as usize != bytes.len() {
        return Err(Error::new(ErrorKind::WrongLength, 16));
    }
    Ok((header, rest))
}

/// Where a directory entry stands in the file.
#[allow(clippy::arithmetic_side_effects)] // the directory lies in a file of less than 4 GiB
fn entry_offset(index: usize) -> u32 {
    (size_of::<Header>() + index * size_of::<DirectoryEntry>()) as u32
}
