//! Opening a bank and finding its clips and locales.

use crate::layout::{self, ClipRecord, DirectoryEntry, Header, LocaleRecord, Tag, U32};
use crate::layout::{EventNameRecord, EventRecord, TypedEventRecord};
use crate::pool::Pool;
use crate::{Clip, ClipId, Clips, Error, ErrorKind, EventName, Locale, Locales};
use core::fmt;
use core::mem::size_of;
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

/// A bank, used in place: a few slices into the caller's bytes.
///
/// `'data` is the life of the bytes. Strings and frame codes that queries return live that long,
/// not only as long as this value.
#[derive(Clone, Copy)]
pub struct Bank<'data> {
    pub(crate) bytes: &'data [u8],
    pub(crate) header: &'data Header,
    pub(crate) directory: &'data [DirectoryEntry],
    pub(crate) clips: &'data [ClipRecord],
    pub(crate) pilots: &'data [U32],
    pub(crate) key_order: &'data [U32],
    pub(crate) names: Pool<'data>,
    pub(crate) frames: &'data [u8],
    pub(crate) starts: &'data [U32],
    pub(crate) locales: &'data [LocaleRecord],
    pub(crate) text_index: &'data [U32],
    pub(crate) texts: Pool<'data>,
    pub(crate) event_refs: &'data [U32],
    pub(crate) events: &'data [EventRecord],
    pub(crate) typed_events: &'data [TypedEventRecord],
    pub(crate) event_names: &'data [EventNameRecord],
    pub(crate) event_strings: Pool<'data>,
}

impl<'data> Bank<'data> {
    /// Opens the bank that fills `bytes`: checks header and directory, in a time that depends
    /// only on the number of sections.
    ///
    /// # Errors
    /// When the bytes are not a bank of a known format version, were cut off, or have a directory
    /// that leads out of them.
    pub fn open(bytes: &'data [u8]) -> Result<Bank<'data>, Error> {
        let (header, rest) = open_header(bytes)?;
        let count = header.section_count.get() as usize;
        if count > layout::MAX_SECTIONS {
            return Err(Error::new(ErrorKind::DirectoryTooLong, SECTION_COUNT_OFFSET));
        }
        let (directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count)
            .map_err(|_| Error::new(ErrorKind::DirectoryOutOfBounds, SECTION_COUNT_OFFSET))?;
        let sections = Sections { bytes, directory };
        for (index, entry) in directory.iter().enumerate() {
            if sections.contents(entry).is_none() {
                return Err(Error::new(ErrorKind::SectionOutOfBounds, entry_offset(index)));
            }
            let known = Tag::REQUIRED.iter().chain(&Tag::OPTIONAL).any(|(tag, _)| tag.0 == entry.tag);
            if !known && entry.flags.get() & layout::SECTION_REQUIRED != 0 {
                return Err(Error::new(ErrorKind::SectionUnknown, entry_offset(index)));
            }
        }
        let bank = Bank {
            bytes,
            header,
            directory,
            clips: sections.array(Tag::CLIPS)?,
            pilots: sections.array(Tag::PILOTS)?,
            key_order: sections.array(Tag::KEY_ORDER)?,
            names: Pool::Bytes(sections.array(Tag::NAMES)?),
            frames: sections.array(Tag::FRAMES)?,
            starts: sections.array(Tag::STARTS)?,
            locales: sections.array(Tag::LOCALES)?,
            text_index: sections.array(Tag::TEXT_INDEX)?,
            texts: Pool::Bytes(sections.array(Tag::TEXTS)?),
            event_refs: sections.array(Tag::EVENT_REFS)?,
            events: sections.array(Tag::EVENTS)?,
            typed_events: sections.array(Tag::TYPED_EVENTS)?,
            event_names: sections.array(Tag::EVENT_NAMES)?,
            event_strings: Pool::Bytes(sections.array(Tag::EVENT_STRINGS)?),
        };
        Ok(bank)
    }

    /// Checks every byte and every reference, and returns the bank with its strings marked as
    /// checked: from then on no query fails for which there is data, and texts cost no UTF-8 check.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify(mut self) -> Result<Bank<'data>, Error> {
        crate::verify::verify(&mut self)?;
        Ok(self)
    }

    /// The number of clips.
    #[inline]
    pub const fn clip_count(&self) -> usize {
        self.clips.len()
    }

    /// The clip with this id: one pilot, one clip record, no loop.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'data, '_>> {
        let slot = self.slot(id)?;
        self.clip_at(slot)
    }

    /// The clip with this key, compared whole.
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'data, '_>> {
        self.clip(ClipId::of(key)).filter(|clip| clip.key_bytes() == Some(key.as_bytes()))
    }

    /// The clip in this slot, a number below [`Bank::clip_count`]. Slots are in no order that means anything.
    #[inline]
    pub fn clip_at(&self, slot: u32) -> Option<Clip<'data, '_>> {
        let record = self.clips.get(slot as usize)?;
        Some(Clip::new(self, record, slot))
    }

    /// All clips in the order of their keys.
    pub fn clips(&self) -> Clips<'data, '_> {
        Clips::new(self, 0, self.key_order.len())
    }

    /// The clips whose keys start with `prefix`, in the order of their keys: `act1/` gives those of
    /// a folder.
    pub fn clips_under(&self, prefix: &str) -> Clips<'data, '_> {
        let prefix = prefix.as_bytes();
        let key_at = |position: &U32| self.clip_at(position.get()).and_then(|clip| clip.key_bytes());
        let first = self.key_order.partition_point(|at| key_at(at).map_or(true, |key| key < prefix));
        let behind = self.key_order.get(first..).unwrap_or(&[]);
        let count = behind.partition_point(|at| key_at(at).map_or(false, |key| key.starts_with(prefix)));
        Clips::new(self, first, first.saturating_add(count))
    }

    /// The slot that the index names for `id`, if the clip there has that id.
    #[inline]
    pub(crate) fn slot(&self, id: ClipId) -> Option<u32> {
        let spread = layout::spread(id.get(), self.header.index_seed.get());
        let bucket = layout::bucket_of(spread, self.pilots.len() as u32);
        let pilot = self.pilots.get(bucket as usize)?.get();
        let slot = layout::slot_of(spread, pilot, self.clips.len() as u32);
        if self.clips.get(slot as usize)?.id.get() == id.get() {
            Some(slot)
        } else {
            None
        }
    }

    /// The locale with this tag, spelled as in the bank (`en-us`). Keep it: queries take it.
    pub fn locale(&self, tag: &str) -> Option<Locale<'data>> {
        self.locales().find(|locale| locale.tag_bytes() == Some(tag.as_bytes()))
    }

    /// The default locale, if one was set when the bank was packed.
    pub fn default_locale(&self) -> Option<Locale<'data>> {
        self.locales().find(Locale::is_default)
    }

    /// All locales of the bank, in the order of their tags.
    pub fn locales(&self) -> Locales<'data, '_> {
        Locales::new(self)
    }

    /// The name that events mention, spelled as there (`amy`); `None` if no event does.
    ///
    /// Look names up once and compare their [ids](EventName::id) per event.
    pub fn event_name(&self, name: &str) -> Option<EventName<'data>> {
        EventName::find(self, name)
    }

    /// Hash of what the clips of this bank are: files that belong together share it.
    pub fn fingerprint(&self) -> u64 {
        self.header.fingerprint.get()
    }

    /// Format version, major and minor.
    pub fn format_version(&self) -> (u16, u16) {
        (self.header.format_major.get(), self.header.format_minor.get())
    }

    /// Length of the bank.
    pub const fn length_bytes(&self) -> usize {
        self.bytes.len()
    }

    /// The sections of the bank in the order of its directory, known or not: tag and contents.
    pub fn sections(&self) -> impl Iterator<Item = (Tag, &'data [u8])> + '_ {
        let sections = Sections { bytes: self.bytes, directory: self.directory };
        self.directory.iter().filter_map(move |entry| Some((Tag(entry.tag), sections.contents(entry)?)))
    }
}

/// What the bank has, not its bytes.
impl fmt::Debug for Bank<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Bank")
            .field("length_bytes", &self.bytes.len())
            .field("clip_count", &self.clips.len())
            .field("locale_count", &self.locales.len())
            .finish_non_exhaustive()
    }
}

/// Where the number of sections stands in the header.
const SECTION_COUNT_OFFSET: u32 = 40;

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

/// The directory while a bank is being opened.
struct Sections<'data> {
    bytes: &'data [u8],
    directory: &'data [DirectoryEntry],
}

impl<'data> Sections<'data> {
    /// The contents of a section, if they lie in the file.
    fn contents(&self, entry: &DirectoryEntry) -> Option<&'data [u8]> {
        let start = entry.offset_bytes.get() as usize;
        let end = start.checked_add(entry.length_bytes.get() as usize)?;
        self.bytes.get(start..end)
    }

    /// The one section with this tag, as entries of type `T`.
    fn array<T>(&self, tag: Tag) -> Result<&'data [T], Error>
    where
        T: FromBytes + Immutable + KnownLayout + Unaligned,
    {
        let (bytes, at) = self.required(tag, size_of::<T>())?;
        <[T]>::ref_from_bytes(bytes).map_err(|_| Error::new(ErrorKind::SectionShape, at))
    }

    /// The one section with this tag, and where its entry stands: the code that all types share.
    fn required(&self, tag: Tag, entry_bytes: usize) -> Result<(&'data [u8], u32), Error> {
        let mut found = self.directory.iter().enumerate().filter(|(_, entry)| entry.tag == tag.0);
        let (index, entry) = found.next().ok_or(Error::new(ErrorKind::SectionMissing, SECTION_COUNT_OFFSET))?;
        if let Some((second, _)) = found.next() {
            return Err(Error::new(ErrorKind::SectionTwice, entry_offset(second)));
        }
        let at = entry_offset(index);
        if usize::from(entry.entry_bytes.get()) != entry_bytes {
            return Err(Error::new(ErrorKind::SectionShape, at));
        }
        let bytes = self.contents(entry).ok_or(Error::new(ErrorKind::SectionOutOfBounds, at))?;
        Ok((bytes, at))
    }
}
