//! What all files of the format have: a header, a directory, and sections.

use crate::{Error, ErrorKind};
use core::mem::size_of;
use lipz_layout::{DirectoryEntry, Header, Tag};
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

/// Where the number of sections stands in the header.
const SECTION_COUNT_OFFSET: u32 = 40;

const DIRECTORY_OUT_OF_BOUNDS: Error = Error::new(ErrorKind::DirectoryOutOfBounds, SECTION_COUNT_OFFSET);

/// A file of which header and directory are checked.
#[derive(Clone, Copy)]
pub(crate) struct File<'data> {
    pub(crate) bytes: &'data [u8],
    pub(crate) header: &'data Header,
    pub(crate) directory: &'data [DirectoryEntry],
}

/// The contents of the sections that every bank has, in the order of [`Tag::REQUIRED`].
pub(crate) type Sections<'data> = [&'data [u8]; Tag::REQUIRED.len()];

/// Which of [`Sections`] a file needs: a bit each.
pub(crate) type SectionSet = u32;

/// Every section of a bank.
pub(crate) const ALL_SECTIONS: SectionSet = (1 << Tag::REQUIRED.len()) - 1;

/// What a text bank has of them.
pub(crate) const TEXT_SECTIONS: SectionSet =
    1 << place::NAMES | 1 << place::LOCALES | 1 << place::TEXT_STARTS | 1 << place::TEXTS;

/// The places of sections in [`Sections`].
pub(crate) mod place {
    use super::place_of;
    use lipz_layout::Tag;

    pub(crate) const CLIPS: usize = place_of(Tag::CLIPS);
    pub(crate) const KEYS: usize = place_of(Tag::KEYS);
    pub(crate) const RATES: usize = place_of(Tag::RATES);
    pub(crate) const PILOTS: usize = place_of(Tag::PILOTS);
    pub(crate) const KEY_ORDER: usize = place_of(Tag::KEY_ORDER);
    pub(crate) const NAMES: usize = place_of(Tag::NAMES);
    pub(crate) const FRAMES: usize = place_of(Tag::FRAMES);
    pub(crate) const STARTS: usize = place_of(Tag::STARTS);
    pub(crate) const LOCALES: usize = place_of(Tag::LOCALES);
    pub(crate) const TEXT_STARTS: usize = place_of(Tag::TEXT_STARTS);
    pub(crate) const TEXTS: usize = place_of(Tag::TEXTS);
    pub(crate) const EVENT_REFS: usize = place_of(Tag::EVENT_REFS);
    pub(crate) const EVENTS: usize = place_of(Tag::EVENTS);
    pub(crate) const TYPED_EVENTS: usize = place_of(Tag::TYPED_EVENTS);
    pub(crate) const EVENT_NAMES: usize = place_of(Tag::EVENT_NAMES);
    pub(crate) const EVENT_STRINGS: usize = place_of(Tag::EVENT_STRINGS);
}

/// The place of a tag, found while compiling.
#[allow(clippy::indexing_slicing, clippy::arithmetic_side_effects)]
const fn place_of(tag: Tag) -> usize {
    let mut place = 0;
    while u32::from_le_bytes(Tag::REQUIRED[place].0.0) != u32::from_le_bytes(tag.0) {
        place += 1;
    }
    place
}

impl<'data> File<'data> {
    /// Checks header and directory, but not the places of the sections.
    #[inline(always)] // a result of several words otherwise takes code that copies it
    pub(crate) fn open(bytes: &'data [u8]) -> Result<File<'data>, Error> {
        check_header(bytes)?;
        File::read(bytes).ok_or(DIRECTORY_OUT_OF_BOUNDS)
    }

    /// Header and directory, if there is room for them.
    #[inline(always)]
    pub(crate) fn read(bytes: &'data [u8]) -> Option<File<'data>> {
        let (header, rest) = Header::ref_from_prefix(bytes).ok()?;
        let count = header.section_count.get() as usize;
        let (directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).ok()?;
        Some(File { bytes, header, directory })
    }

    /// Whether the file begins as a text bank does.
    pub(crate) fn has_texts_only(&self) -> bool {
        self.directory.first().map_or(false, |first| first.tag == Tag::NAMES.0)
    }

    /// Checks the places of all sections and finds those that are `needed`, which stand in the order of
    /// [`Tag::REQUIRED`], in a time that depends only on the number of sections.
    ///
    /// They are put into place, because returning so many costs a copy.
    pub(crate) fn find(&self, mut needed: SectionSet, sections: &mut Sections<'data>) -> Result<(), Error> {
        for (index, entry) in self.directory.iter().enumerate() {
            self.place(entry, &mut needed, sections).map_err(|kind| Error::new(kind, entry_offset(index)))?;
        }
        if needed == 0 { Ok(()) } else { Err(Error::new(ErrorKind::SectionMissing, SECTION_COUNT_OFFSET)) }
    }

    /// Puts the contents of a section to its place, if it is the next of those that are still needed.
    fn place(
        &self,
        entry: &DirectoryEntry,
        needed: &mut SectionSet,
        sections: &mut Sections<'data>,
    ) -> Result<(), ErrorKind> {
        let contents = self.contents(entry).ok_or(ErrorKind::SectionOutOfBounds)?;
        let next = needed.trailing_zeros() as usize;
        match (Tag::REQUIRED.get(next), sections.get_mut(next)) {
            (Some((tag, entry_bytes)), Some(place)) if tag.0 == entry.tag => {
                let is_filled = entry.length_bytes.get() & (*entry_bytes as u32).wrapping_sub(1) == 0;
                if usize::from(entry.entry_bytes.get()) != *entry_bytes || !is_filled {
                    return Err(ErrorKind::SectionShape);
                }
                *place = contents;
                *needed &= needed.wrapping_sub(1);
                Ok(())
            }
            _ if entry.flags.get() & lipz_layout::SECTION_REQUIRED != 0 => Err(ErrorKind::SectionUnknown),
            _ => Ok(()),
        }
    }

    /// The contents of a section, if they lie in the file.
    pub(crate) fn contents(&self, entry: &DirectoryEntry) -> Option<&'data [u8]> {
        let start = entry.offset_bytes.get() as usize;
        let end = start.checked_add(entry.length_bytes.get() as usize)?;
        self.bytes.get(start..end)
    }

    /// The place in the directory of a section that a file need not have.
    #[inline(never)] // asked for in several places, once per file
    pub(crate) fn entry(&self, tag: Tag) -> Option<&'data DirectoryEntry> {
        self.directory.iter().find(|entry| entry.tag == tag.0)
    }

    /// The contents of a section that a file need not have; empty without it, and if it does not lie in the file.
    // Short code where memory is scarce: it is needed in several places.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn section(&self, tag: Tag) -> &'data [u8] {
        self.entry(tag).and_then(|entry| self.contents(entry)).unwrap_or(&[])
    }

    /// The sections in the order of the directory, known or not.
    pub(crate) fn sections(&self) -> impl Iterator<Item = ([u8; 4], &'data [u8])> + '_ {
        self.directory.iter().filter_map(move |entry| Some((entry.tag, self.contents(entry)?)))
    }
}

/// The contents of a section as entries of type `T`, which fill it: [`File::open`] has made sure of that.
pub(crate) fn entries<T>(contents: &[u8]) -> &[T]
where
    T: FromBytes + Immutable + KnownLayout + Unaligned,
{
    <[T]>::ref_from_prefix(contents).map_or(&[], |(entries, _)| entries)
}

/// Checks everything of the header but the checksum, and that the directory may be as long as it is.
fn check_header(bytes: &[u8]) -> Result<(), Error> {
    let magic_start = bytes.get(..4);
    let (header, _) = Header::ref_from_prefix(bytes).map_err(|_| match magic_start {
        Some(start) if start != &lipz_layout::MAGIC[..4] => Error::new(ErrorKind::NotABank, 0),
        _ => Error::new(ErrorKind::TooShort, bytes.len() as u32),
    })?;
    if header.magic != lipz_layout::MAGIC {
        let kind =
            if magic_start == Some(&lipz_layout::MAGIC[..4]) { ErrorKind::TextMode } else { ErrorKind::NotABank };
        return Err(Error::new(kind, 0));
    }
    if header.format_major.get() != lipz_layout::FORMAT_MAJOR {
        return Err(Error::new(ErrorKind::UnsupportedVersion, 20));
    }
    if header.file_length_bytes.get() as usize != bytes.len() {
        return Err(Error::new(ErrorKind::WrongLength, 16));
    }
    if header.section_count.get() as usize > lipz_layout::MAX_SECTIONS {
        return Err(Error::new(ErrorKind::DirectoryTooLong, SECTION_COUNT_OFFSET));
    }
    Ok(())
}

/// Where a directory entry stands in the file.
#[allow(clippy::arithmetic_side_effects)] // the directory lies in a file of less than 4 GiB
fn entry_offset(index: usize) -> u32 {
    (size_of::<Header>() + index * size_of::<DirectoryEntry>()) as u32
}

/// The first profile of a section, and the bytes after it; `None` if it is damaged.
type First<'data, T> = Option<(T, &'data [u8])>;

/// The profiles of a section, one after the other.
pub(crate) fn profiles<'data, T: 'data>(
    mut rest: &'data [u8],
    split_first: fn(&'data [u8]) -> First<'data, T>,
) -> impl Iterator<Item = T> + Clone + 'data {
    core::iter::from_fn(move || {
        // A damaged profile ends the iteration.
        let (profile, behind) = split_first(rest)?;
        rest = behind;
        Some(profile)
    })
}
