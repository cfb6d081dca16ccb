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

/// The contents of the sections that every bank has, in the order of [`Tag::REQUIRED`].
pub(crate) type Sections<'data> = [Option<&'data [u8]>; Tag::REQUIRED.len()];

/// The place for [`Sections`].
pub(crate) const NO_SECTIONS: Sections<'static> = [None; Tag::REQUIRED.len()];

impl<'data> File<'data> {
    /// Checks header and directory, and finds the sections, in a time that depends only on their
    /// number. They are put into place, because returning so many costs a copy.
    pub(crate) fn open(bytes: &'data [u8], sections: &mut Sections<'data>) -> Result<File<'data>, Error> {
        let (header, rest) = open_header(bytes)?;
        let count = header.section_count.get() as usize;
        if count > layout::MAX_SECTIONS {
            return Err(Error::new(ErrorKind::DirectoryTooLong, SECTION_COUNT_OFFSET));
        }
        let (directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count)
            .map_err(|_| Error::new(ErrorKind::DirectoryOutOfBounds, SECTION_COUNT_OFFSET))?;
        let file = File { bytes, header, directory };
        for (index, entry) in directory.iter().enumerate() {
            file.place(entry, sections).map_err(|kind| Error::new(kind, entry_offset(index)))?;
        }
        Ok(file)
    }

    /// Puts the contents of one section to its place.
    fn place(&self, entry: &DirectoryEntry, sections: &mut Sections<'data>) -> Result<(), ErrorKind> {
        let contents = self.contents(entry).ok_or(ErrorKind::SectionOutOfBounds)?;
        let mut required = Tag::REQUIRED.iter().zip(sections);
        if let Some(((_, entry_bytes), place)) = required.find(|((tag, _), _)| tag.0 == entry.tag) {
            if place.replace(contents).is_some() {
                return Err(ErrorKind::SectionTwice);
            }
            let has_shape = usize::from(entry.entry_bytes.get()) == *entry_bytes;
            return has_shape.then_some(()).ok_or(ErrorKind::SectionShape);
        }
        let is_known = Tag::OPTIONAL.iter().any(|(tag, _)| tag.0 == entry.tag);
        if !is_known && entry.flags.get() & layout::SECTION_REQUIRED != 0 {
            return Err(ErrorKind::SectionUnknown);
        }
        Ok(())
    }

    /// The contents of a section, if they lie in the file.
    pub(crate) fn contents(&self, entry: &DirectoryEntry) -> Option<&'data [u8]> {
        let start = entry.offset_bytes.get() as usize;
        let end = start.checked_add(entry.length_bytes.get() as usize)?;
        self.bytes.get(start..end)
    }

    /// Why [`entries`] did not find what every file has: a section that entries do not fill, or else
    /// one that is missing.
    pub(crate) fn misfit(&self) -> Error {
        for (index, entry) in self.directory.iter().enumerate() {
            let required = Tag::REQUIRED.iter().find(|(tag, _)| tag.0 == entry.tag);
            let entry_bytes = required.map_or(1, |(_, entry_bytes)| *entry_bytes as u32);
            if entry.length_bytes.get().checked_rem(entry_bytes) != Some(0) {
                return Error::new(ErrorKind::SectionShape, entry_offset(index));
            }
        }
        Error::new(ErrorKind::SectionMissing, SECTION_COUNT_OFFSET)
    }

    /// The sections in the order of the directory, known or not.
    pub(crate) fn sections(&self) -> impl Iterator<Item = (Tag, &'data [u8])> + '_ {
        self.directory.iter().filter_map(move |entry| Some((Tag(entry.tag), self.contents(entry)?)))
    }
}

/// The contents of a section as entries of type `T`, if there is such a section and they fill it.
pub(crate) fn entries<T>(section: Option<&[u8]>) -> Option<&[T]>
where
    T: FromBytes + Immutable + KnownLayout + Unaligned,
{
    <[T]>::ref_from_bytes(section?).ok()
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
