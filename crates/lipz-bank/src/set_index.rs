//! The index of a set: its banks, and the location of each clip.

use crate::file::{File, entries};
use crate::pool::Pool;
use crate::{Bank, ClipId, Error, ErrorKind};
use core::fmt;
use core::mem::size_of;
use lipz_layout::{Header, KeyRecord, MAX_SET_BANKS, SECTION_REQUIRED, SetBankRecord, Tag, U16, U64, shard_of};

/// The index of a set, used in place: a small file (`.lipzset`) that names the banks of a project, one for each shard.
///
/// It finds the bank of a clip without reading any bank. The top bits of the clip's id select the bank, except for
/// dubs, which are in the bank of their originals. The program opens all banks, or only those that it needs, and
/// queries the one that [`bank_of`](SetIndex::bank_of) returns; a [`Dialogue`](crate::Dialogue) does this for all of
/// them.
///
/// ```
/// use lipz_bank::files::SetIndex;
/// use lipz_bank::{Bank, ClipId, Error};
///
/// fn has_clip(index: &[u8], banks: &[&[u8]], key: &str) -> Result<bool, Error> {
///     let index = SetIndex::open(index)?.verify()?;
///     let id = ClipId::from_key(key);
///     let Some(bytes) = banks.get(index.bank_of(id)) else { return Ok(false) };
///     Ok(Bank::open(bytes)?.verify()?.clip(id).is_some())
/// }
/// # assert!(has_clip(b"", &[], "a").is_err());
/// ```
#[derive(Clone, Copy)]
pub struct SetIndex<'data> {
    file: File<'data>,
    banks: &'data [SetBankRecord],
    /// Ids of the clips that are not in the bank of their id, ascending, and the numbers of their banks.
    moved: &'data [U64],
    homes: &'data [U16],
    names: Pool<'data>,
}

/// An index's entry for a bank.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct SetBank<'data> {
    /// The name of its file, which is in the folder of the index. Empty in a damaged index that was not verified.
    pub file_name: &'data str,
    /// Its [checksum](crate::Bank::checksum).
    pub checksum: u64,
    /// Its [fingerprint](crate::Bank::fingerprint).
    pub fingerprint: u64,
    /// Its length in bytes.
    pub length_bytes: u32,
    /// The number of its clips.
    pub clip_count: u32,
}

impl SetBank<'_> {
    /// Whether this entry describes `bank`, by all of its values. If the bank is not [verified](crate::Bank::verify),
    /// only its header is compared.
    pub fn is_of(&self, bank: &Bank<'_>) -> bool {
        let length_bytes = bank.length_bytes() as u64;
        self.checksum == bank.checksum()
            && self.fingerprint == bank.fingerprint()
            && u64::from(self.length_bytes) == length_bytes
            && u64::from(self.clip_count) == bank.clip_count() as u64
    }
}

/// The offset of the number of sections in the header.
const SECTION_COUNT_OFFSET: u32 = 40;

impl<'data> SetIndex<'data> {
    /// Opens the index that fills `bytes`. Checks its header and directory, in a time that depends only on the number
    /// of sections.
    ///
    /// # Errors
    /// If the bytes are not an index of a known format version, are cut off, or have a directory that reaches past
    /// their end.
    pub fn open(bytes: &'data [u8]) -> Result<SetIndex<'data>, Error> {
        let file = open_file(bytes)?;
        let mut found: [&[u8]; Tag::SET.len()] = [&[]; Tag::SET.len()];
        let mut rest = found.iter_mut().zip(&Tag::SET);
        let mut next = rest.next();
        for entry in file.directory {
            let at = |kind| Error::new(kind, file.place_of(entry));
            let contents = file.contents(entry).ok_or_else(|| at(ErrorKind::SectionOutOfBounds))?;
            match next {
                Some((ref mut place, (tag, entry_bytes))) if tag.0 == entry.tag => {
                    let is_filled = entry.length_bytes.get() & (*entry_bytes as u32).wrapping_sub(1) == 0;
                    if usize::from(entry.entry_bytes.get()) != *entry_bytes || !is_filled {
                        return Err(at(ErrorKind::SectionShape));
                    }
                    **place = contents;
                    next = rest.next();
                }
                _ if entry.flags.get() & SECTION_REQUIRED != 0 => return Err(at(ErrorKind::SectionUnknown)),
                _ => {}
            }
        }
        if next.is_some() {
            return Err(Error::new(ErrorKind::SectionMissing, SECTION_COUNT_OFFSET));
        }
        let [banks, moved, homes, names] = found;
        let index = SetIndex {
            file,
            banks: entries(banks),
            moved: entries(moved),
            homes: entries(homes),
            names: Pool::Bytes(names),
        };
        let has_banks = (1..=MAX_SET_BANKS).contains(&index.banks.len());
        if has_banks && index.moved.len() == index.homes.len() {
            Ok(index)
        } else {
            Err(Error::new(ErrorKind::Set, size_of::<Header>() as u32))
        }
    }

    /// Checks every byte, and returns the index with its names marked as checked. The banks have to be verified
    /// separately.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify(mut self) -> Result<SetIndex<'data>, Error> {
        self.names = crate::verify::set_index(&self.file, self.names)?;
        let mut end = 0;
        for record in self.banks {
            let (offset, length) = (record.name_offset_bytes.get(), record.name_length_bytes.get());
            let is_name = self.names.text_at(offset, length).map_or(false, is_file_name);
            if !is_name || offset != end {
                return Err(self.damage(record));
            }
            end = offset.wrapping_add(length);
        }
        if end as usize != self.names.bytes().len() {
            return Err(self.damage(self.banks));
        }
        let mut before = None;
        for (id, home) in self.moved.iter().zip(self.homes) {
            let place = usize::from(home.get());
            if before >= Some(id.get()) || place >= self.banks.len() || place == self.shard(id.get()) {
                return Err(self.damage(id));
            }
            before = Some(id.get());
        }
        if lipz_layout::set_fingerprint(self.banks) != self.fingerprint() {
            return Err(Error::new(ErrorKind::Fingerprint, 24));
        }
        Ok(self)
    }

    /// Checks that a bank is the one with this number, and that the index leads to it for each of its clips. Otherwise,
    /// a clip would never be found. Reads all ids. The bank has to be [verified](crate::Bank::verify) separately.
    ///
    /// # Errors
    /// [`ErrorKind::OtherBank`] if the index names a different bank, or leads to a different bank for a clip.
    pub fn verify_bank(&self, number: usize, bank: &Bank<'_>) -> Result<(), Error> {
        self.check_bank(number, bank)?;
        let is_here = |record: &KeyRecord| self.bank_of(ClipId::from_u64(record.id.get())) == number;
        if bank.keys.iter().all(is_here) { Ok(()) } else { Err(Error::new(ErrorKind::OtherBank, 0)) }
    }

    /// Checks that a bank is the one with this number, by all values in the index.
    ///
    /// # Errors
    /// [`ErrorKind::OtherBank`] if the index names a different bank.
    pub fn check_bank(&self, number: usize, bank: &Bank<'_>) -> Result<(), Error> {
        let is_named = self.bank_at(number).map_or(false, |named| named.is_of(bank));
        if is_named { Ok(()) } else { Err(Error::new(ErrorKind::OtherBank, 0)) }
    }

    /// Returns the number of banks.
    pub const fn bank_count(&self) -> usize {
        self.banks.len()
    }

    /// Returns the banks in their order, that of shard 0 first.
    pub fn banks(&self) -> impl ExactSizeIterator<Item = SetBank<'data>> + '_ {
        self.banks.iter().map(move |record| self.bank(record))
    }

    /// Returns the bank with this number.
    pub fn bank_at(&self, number: usize) -> Option<SetBank<'data>> {
        self.banks.get(number).map(|record| self.bank(record))
    }

    /// Returns the number of clips in all banks.
    pub fn clip_count(&self) -> u64 {
        self.banks.iter().fold(0, |count: u64, bank| count.saturating_add(bank.clip_count.get().into()))
    }

    /// Returns the number of the bank with the clip with this id, if any bank has it.
    #[inline]
    pub fn bank_of(&self, id: ClipId) -> usize {
        self.moved_to(id.get()).unwrap_or_else(|| self.shard(id.get()))
    }

    /// Returns a hash of the clips of all banks.
    pub fn fingerprint(&self) -> u64 {
        self.file.header.fingerprint.get()
    }

    /// Returns the checksum of the index, which differs between sets of different contents.
    pub fn checksum(&self) -> u64 {
        self.file.header.checksum.get()
    }

    /// Returns the length of the index in bytes.
    pub const fn length_bytes(&self) -> usize {
        self.file.bytes.len()
    }

    /// Returns the number of clips that are not in the bank of their id.
    pub const fn moved_count(&self) -> usize {
        self.moved.len()
    }

    /// Returns the bank of a clip, if it is not the one of its id.
    pub(crate) fn moved_to(&self, id: u64) -> Option<usize> {
        let place = self.moved.binary_search_by_key(&id, |moved| moved.get()).ok()?;
        self.homes.get(place).map(|home| usize::from(home.get()))
    }

    fn shard(&self, id: u64) -> usize {
        shard_of(id, self.banks.len() as u32) as usize
    }

    fn bank(&self, record: &SetBankRecord) -> SetBank<'data> {
        let name = self.names.text_at(record.name_offset_bytes.get(), record.name_length_bytes.get());
        SetBank {
            file_name: name.unwrap_or(""),
            checksum: record.checksum.get(),
            fingerprint: record.fingerprint.get(),
            length_bytes: record.length_bytes.get(),
            clip_count: record.clip_count.get(),
        }
    }

    fn damage<T: ?Sized>(&self, item: &T) -> Error {
        Error::new(ErrorKind::Set, self.file.place_of(item))
    }
}

/// Whether a name is that of a file in the folder of the index, on every system.
fn is_file_name(name: &str) -> bool {
    let is_other = |letter: char| matches!(letter, '/' | '\\' | ':') || letter.is_control();
    !name.is_empty() && !name.starts_with('.') && !name.contains(is_other)
}

/// Checks header and directory, but not the places of the sections.
fn open_file(bytes: &[u8]) -> Result<File<'_>, Error> {
    let magic = bytes.get(..lipz_layout::SET_MAGIC.len());
    if magic.map_or(false, |magic| magic != lipz_layout::SET_MAGIC) {
        return Err(Error::new(ErrorKind::NotASet, 0));
    }
    let file = File::read(bytes).ok_or(Error::new(ErrorKind::TooShort, bytes.len() as u32))?;
    if file.header.format_major.get() != lipz_layout::FORMAT_MAJOR {
        return Err(Error::new(ErrorKind::UnsupportedVersion, 20));
    }
    if file.header.file_length_bytes.get() as usize != bytes.len() {
        return Err(Error::new(ErrorKind::WrongLength, 16));
    }
    if file.directory.len() > lipz_layout::MAX_SECTIONS {
        return Err(Error::new(ErrorKind::DirectoryTooLong, SECTION_COUNT_OFFSET));
    }
    Ok(file)
}

impl File<'_> {
    /// Returns the offset of an item in the file.
    fn place_of<T: ?Sized>(&self, item: &T) -> u32 {
        (item as *const T as *const u8 as usize).wrapping_sub(self.bytes.as_ptr() as usize) as u32
    }
}

/// Prints the number of banks, not their names.
impl fmt::Debug for SetIndex<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SetIndex")
            .field("bank_count", &self.banks.len())
            .field("moved_count", &self.moved.len())
            .finish_non_exhaustive()
    }
}
