//! The parts that all files of the format share: a header, a directory, and sections.

use crate::{Error, ErrorKind};
use core::mem::size_of;
use lipz_layout::{DirectoryEntry, Header, Tag};
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

/// The offset of the number of sections in the header.
const SECTION_COUNT_OFFSET: u32 = 40;

const DIRECTORY_OUT_OF_BOUNDS: Error = Error::new(ErrorKind::DirectoryOutOfBounds, SECTION_COUNT_OFFSET);

/// A file whose header and directory are checked.
#[derive(Clone, Copy)]
pub(crate) struct File<'data> {
    pub(crate) bytes: &'data [u8],
    pub(crate) header: &'data Header,
    pub(crate) directory: &'data [DirectoryEntry],
}

/// The contents of the sections that every bank has, in the order of [`Tag::REQUIRED`].
pub(crate) type Sections<'data> = [&'data [u8]; Tag::REQUIRED.len()];

/// The [`Sections`] that a file needs, one bit each.
pub(crate) type SectionSet = u32;

/// All sections of a bank.
pub(crate) const ALL_SECTIONS: SectionSet = (1 << Tag::REQUIRED.len()) - 1;

/// The sections of a text bank.
pub(crate) const TEXT_SECTIONS: SectionSet =
    1 << place::NAMES | 1 << place::LOCALES | 1 << place::TEXT_STARTS | 1 << place::TEXTS;

/// The indices of sections in [`Sections`].
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

/// Returns the index of a tag, at compile time.
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
    #[inline(always)] // otherwise, a result of several words is copied
    pub(crate) fn open(bytes: &'data [u8]) -> Result<File<'data>, Error> {
        check_header(bytes)?;
        File::read(bytes).ok_or(DIRECTORY_OUT_OF_BOUNDS)
    }

    /// Returns header and directory, if the file is long enough.
    #[inline(always)]
    pub(crate) fn read(bytes: &'data [u8]) -> Option<File<'data>> {
        let (header, rest) = Header::ref_from_prefix(bytes).ok()?;
        let count = header.section_count.get() as usize;
        let (directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).ok()?;
        Some(File { bytes, header, directory })
    }

    /// Whether the file starts like a text bank.
    pub(crate) fn has_texts_only(&self) -> bool {
        self.directory.first().map_or(false, |first| first.tag == Tag::NAMES.0)
    }

    /// Checks the places of all sections and finds those that are `needed`, which must be in the order of
    /// [`Tag::REQUIRED`], in a time that depends only on the number of sections.
    ///
    /// They are stored in an argument, because returning so many costs a copy.
    pub(crate) fn find(&self, mut needed: SectionSet, sections: &mut Sections<'data>) -> Result<(), Error> {
        for (index, entry) in self.directory.iter().enumerate() {
            self.place(entry, &mut needed, sections).map_err(|kind| Error::new(kind, entry_offset(index)))?;
        }
        if needed == 0 { Ok(()) } else { Err(Error::new(ErrorKind::SectionMissing, SECTION_COUNT_OFFSET)) }
    }

    /// Stores the contents of a section, if it is the next of those still needed.
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

    /// Returns the contents of a section, if they are in the file.
    pub(crate) fn contents(&self, entry: &DirectoryEntry) -> Option<&'data [u8]> {
        let start = entry.offset_bytes.get() as usize;
        let end = start.checked_add(entry.length_bytes.get() as usize)?;
        self.bytes.get(start..end)
    }

    /// Returns the directory entry of an optional section.
    #[inline(never)] // used in several places, once per file
    pub(crate) fn entry(&self, tag: Tag) -> Option<&'data DirectoryEntry> {
        self.directory.iter().find(|entry| entry.tag == tag.0)
    }

    /// Returns the contents of an optional section; empty if it is missing or not inside the file.
    // Not inlined where memory is scarce, because several places need it.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn section(&self, tag: Tag) -> &'data [u8] {
        self.entry(tag).and_then(|entry| self.contents(entry)).unwrap_or(&[])
    }

    /// Returns the sections in the order of the directory, known or not.
    pub(crate) fn sections(&self) -> impl Iterator<Item = ([u8; 4], &'data [u8])> + '_ {
        self.directory.iter().filter_map(move |entry| Some((entry.tag, self.contents(entry)?)))
    }
}

/// Returns the contents of a section as entries of type `T`, which fill it: [`File::open`] has checked that.
pub(crate) fn entries<T>(contents: &[u8]) -> &[T]
where
    T: FromBytes + Immutable + KnownLayout + Unaligned,
{
    <[T]>::ref_from_prefix(contents).map_or(&[], |(entries, _)| entries)
}

/// Checks the whole header except the checksum, and checks that the directory may have its length.
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

/// Returns the offset of a directory entry in the file.
#[allow(clippy::arithmetic_side_effects)] // the directory is inside a file of less than 4 GiB
fn entry_offset(index: usize) -> u32 {
    (size_of::<Header>() + index * size_of::<DirectoryEntry>()) as u32
}

/// The first profile of a section, and the bytes after it; `None` if it is damaged.
type FirstProfile<'data, T> = Option<(T, &'data [u8])>;

/// Returns the profiles of a section, which follow each other.
pub(crate) fn profiles<'data, T: 'data>(
    mut rest: &'data [u8],
    split_first: fn(&'data [u8]) -> FirstProfile<'data, T>,
) -> impl Iterator<Item = T> + Clone + 'data {
    core::iter::from_fn(move || {
        // A damaged profile ends the iteration.
        let (profile, behind) = split_first(rest)?;
        rest = behind;
        Some(profile)
    })
}
