//! Opening a bank and finding its clips.

use crate::clip::Clips;
use crate::file::{ALL_SECTIONS, File, Sections, TEXT_SECTIONS, entries, place};
use crate::locale::LocaleTable;
use crate::origin::{Origin, add_checksum};
use crate::pool::Pool;
use crate::{Clip, ClipId, Error, ErrorKind};
use core::fmt;
use core::mem::size_of;
use core::sync::atomic::{Ordering, compiler_fence};
use lipz_layout::{ClipRecord, EventNameRecord, EventRecord, KeyRecord, RateRecord, Tag, TypedEventRecord, U32};

/// A bank, used in place: a few slices into the caller's bytes.
///
/// `'data` is the lifetime of the bytes. Strings and frame codes that queries return live that long, which may be
/// longer than this value.
#[derive(Clone, Copy)]
pub struct Bank<'data> {
    pub(crate) file: File<'data>,
    /// The origin of the bank's handles.
    pub(crate) origin: Origin,
    /// The number of the bank among the files of its dialogue.
    pub(crate) number: u32,
    /// In a dialogue, the hash of the bank's list of locales.
    pub(crate) locale_list: u32,
    pub(crate) clips: &'data [ClipRecord],
    pub(crate) keys: &'data [KeyRecord],
    pub(crate) rates: &'data [RateRecord],
    pub(crate) pilots: &'data [U32],
    pub(crate) key_order: &'data [U32],
    pub(crate) frames: &'data [u8],
    pub(crate) starts: &'data [U32],
    /// Keys of clips, and tags of locales.
    pub(crate) names: Pool<'data>,
    /// The locales, possibly those of a text bank.
    pub(crate) texts: LocaleTable<'data>,
    pub(crate) event_refs: &'data [U32],
    pub(crate) events: &'data [EventRecord],
    pub(crate) typed_events: &'data [TypedEventRecord],
    pub(crate) event_names: &'data [EventNameRecord],
    pub(crate) event_strings: Pool<'data>,
}

impl<'data> Bank<'data> {
    /// Opens the bank that fills `bytes`. Checks its header and directory, in a time that depends only on the number of
    /// sections.
    ///
    /// # Errors
    /// If the bytes are not a bank of a known format version, are cut off, or have a directory that reaches past their
    /// end.
    pub fn open(bytes: &'data [u8]) -> Result<Bank<'data>, Error> {
        let file = File::open(bytes)?;
        if file.has_texts_only() {
            return Err(Error::new(ErrorKind::TextsOnly, 0));
        }
        Bank::of_file(file)
    }

    /// Returns the bank in a file that contains clips.
    #[inline(always)]
    pub(crate) fn of_file(file: File<'data>) -> Result<Bank<'data>, Error> {
        let mut found: Sections<'data> = [&[]; Tag::REQUIRED.len()];
        file.find(ALL_SECTIONS, &mut found)?;
        Ok(Bank::from_sections(file, &found))
    }

    /// Returns the bank made of these sections.
    #[inline(always)] // a bank is many words, which are built directly in the caller's place
    pub(crate) fn from_sections(file: File<'data>, found: &Sections<'data>) -> Bank<'data> {
        let starts: &[U32] = entries(found[place::STARTS]);
        Bank {
            file,
            origin: Origin::of_file(file.header),
            number: 0,
            locale_list: 0,
            clips: entries(found[place::CLIPS]),
            keys: entries(found[place::KEYS]),
            rates: entries(found[place::RATES]),
            pilots: entries(found[place::PILOTS]),
            key_order: entries(found[place::KEY_ORDER]),
            frames: found[place::FRAMES],
            starts,
            names: Pool::Bytes(found[place::NAMES]),
            texts: LocaleTable::new(found, starts.len().saturating_sub(1)),
            event_refs: entries(found[place::EVENT_REFS]),
            events: entries(found[place::EVENTS]),
            typed_events: entries(found[place::TYPED_EVENTS]),
            event_names: entries(found[place::EVENT_NAMES]),
            event_strings: Pool::Bytes(found[place::EVENT_STRINGS]),
        }
    }

    /// Checks every byte and every reference, and returns the bank with its strings marked as checked. After that, no
    /// query fails for stored data, and texts need no UTF-8 check.
    ///
    /// # Errors
    /// The first damage found.
    #[inline(always)]
    pub fn verify(self) -> Result<Bank<'data>, Error> {
        self.verify_with(crate::verify::core_utf8)
    }

    /// Like [`Bank::verify`], with the program's own UTF-8 check, because that of the standard library takes half of
    /// the time.
    ///
    /// `utf8` returns its bytes as a string, or `None` if they are not UTF-8. The check of
    /// [simdutf8](https://docs.rs/simdutf8) is many times faster than the standard library's: `bank.verify_with(|bytes|
    /// simdutf8::basic::from_utf8(bytes).ok())`.
    ///
    /// # Errors
    /// The first damage found.
    #[inline(always)] // a bank is many words, which are built directly in the caller's place
    pub fn verify_with(mut self, utf8: fn(&'data [u8]) -> Option<&'data str>) -> Result<Bank<'data>, Error> {
        crate::verify::verify(&mut self, utf8)?;
        Ok(self)
    }

    /// Like [`Bank::verify`], for programs on small machines that show only visemes, texts and events.
    ///
    /// Skips the sections for babble, faces, recordings, curves and voices, and so the code that checks them. The
    /// checksum still covers their bytes. In a forged bank, queries about them may return wrong values or `None`.
    ///
    /// # Errors
    /// The first damage found.
    #[inline(always)]
    pub fn verify_lines(mut self) -> Result<Bank<'data>, Error> {
        crate::verify::lines(&mut self, crate::verify::core_utf8)?;
        Ok(self)
    }

    /// Checks all of the bank except the checksum and the contents of frames and texts.
    ///
    /// For tools that copy these from verified banks, and have only the tables in memory. Queries become no faster.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify_tables(&self) -> Result<(), Error> {
        crate::verify::tables(*self)
    }

    /// Opens and verifies the text bank that fills `bytes`, and replaces the locales of the bank with its own. Handles
    /// of locales from before then lead to no text.
    ///
    /// A program with one language in memory packs with `--config split-locales=true`, and opens the bank with the text
    /// bank of that language. A [`Dialogue`](crate::Dialogue) takes several at the same time.
    ///
    /// ```
    /// use lipz_bank::{Bank, Error};
    ///
    /// # fn main() -> Result<(), Error> {
    /// # let base: &[u8] = include_bytes!("../examples/act1.lipzbank");
    /// # let german = base; // a whole bank is accepted as well
    /// let mut bank = Bank::open(base)?.verify()?;
    /// bank.open_texts(german)?;
    /// let segment = bank.clip_by_key("act1/mara-good-evening").and_then(|clip| clip.segment(0));
    /// let text = segment.zip(bank.locale("de-de")).and_then(|(segment, german)| segment.text(german));
    /// assert_eq!(text.map(|text| text.as_str()), Some("Guten Abend, Otto."));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As [`Bank::verify`]; also if the texts belong to different clips, or if the bank itself is not
    /// [verified](Bank::is_verified). The bank is then unchanged.
    pub fn open_texts(&mut self, bytes: &'data [u8]) -> Result<(), Error> {
        let (file, mut table) = self.text_file(bytes)?;
        crate::verify::text_file(&file, &mut table, self, crate::verify::core_utf8)?;
        self.take_texts(&file, table);
        Ok(())
    }

    /// Like [`Bank::open_texts`], without verifying anything, in a time that depends only on the number of sections.
    ///
    /// # Errors
    /// As [`Bank::open`], and if the texts belong to different clips. The bank is then unchanged.
    pub fn open_texts_unverified(&mut self, bytes: &'data [u8]) -> Result<(), Error> {
        let (file, table) = self.text_file(bytes)?;
        self.take_texts(&file, table);
        Ok(())
    }

    /// Returns the table of a text bank for the clips of this bank.
    fn text_file(&self, bytes: &'data [u8]) -> Result<(File<'data>, LocaleTable<'data>), Error> {
        let file = File::open(bytes)?;
        let table = text_table(&file, self.texts.segment_count)?;
        if file.header.fingerprint.get() != self.fingerprint() {
            return Err(Error::new(ErrorKind::OtherClips, 24));
        }
        Ok((file, table))
    }

    /// Replaces the bank's locales with those of another file, which gives handles a different origin.
    fn take_texts(&mut self, file: &File<'data>, texts: LocaleTable<'data>) {
        self.texts = texts;
        self.origin = Origin::of_hash(add_checksum(self.checksum(), file.header.checksum.get()));
    }

    /// Whether the bank comes from [`Bank::verify`], [`Bank::verify_with`] or [`Bank::verify_lines`], which skips some
    /// sections.
    pub const fn is_verified(&self) -> bool {
        self.event_strings.is_checked()
    }

    /// Returns the number of clips.
    #[inline]
    pub const fn clip_count(&self) -> usize {
        self.clips.len()
    }

    /// Returns the clip with this id, with one pilot, two records and no loop.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        let (slot, _) = self.find(id)?;
        self.clip_at(slot)
    }

    /// Returns the clip with this key, which is compared in full.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        let (slot, record) = self.find(ClipId::from_key(key))?;
        if self.key_bytes(record)? == key.as_bytes() { self.clip_at(slot) } else { None }
    }

    /// Returns the clip in this slot, a number below [`Bank::clip_count`]. The order of slots has no meaning.
    #[inline]
    pub fn clip_at(&self, slot: u32) -> Option<Clip<'_>> {
        Clip::new(self, slot, None, true)
    }

    /// Returns the slot of this record, which must be in the clip table.
    #[inline]
    pub(crate) fn slot_of(&self, record: &ClipRecord) -> u32 {
        let table = self.clips.as_ptr() as usize;
        let offset_bytes = (record as *const ClipRecord as usize).wrapping_sub(table);
        const CLIP_BYTES: usize = size_of::<ClipRecord>();
        offset_bytes.checked_div(CLIP_BYTES).unwrap_or(0) as u32
    }

    /// Returns all clips, ordered by key.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'_>> + Clone + '_ {
        Clips::new(self, 0, self.key_order.len())
    }

    /// Returns the clips whose keys start with `prefix`, ordered by key. `act1/` selects those of a folder.
    pub fn clips_under(&self, prefix: &str) -> impl Iterator<Item = Clip<'_>> + Clone + '_ {
        self.clips_from(prefix)
    }

    pub(crate) fn clips_from(&self, prefix: &str) -> Clips<'_> {
        let prefix = prefix.as_bytes();
        let key_at = |position: &U32| self.keys.get(position.get() as usize).and_then(|record| self.key_bytes(record));
        let first = self.key_order.partition_point(|at| key_at(at).map_or(true, |key| key < prefix));
        let behind = self.key_order.get(first..).unwrap_or(&[]);
        let count = behind.partition_point(|at| key_at(at).map_or(false, |key| key.starts_with(prefix)));
        Clips::new(self, first, first.saturating_add(count))
    }

    /// Returns the slot that the index names for `id`, and its key record, if that has the id.
    // 64-bit products take long code where they are not single instructions.
    #[cfg_attr(target_pointer_width = "64", inline(always))]
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn find(&self, id: ClipId) -> Option<(u32, &'data KeyRecord)> {
        let spread = lipz_layout::spread(id.get(), self.file.header.index_seed.get());
        let bucket = lipz_layout::bucket_of(spread, self.pilots.len() as u32);
        let pilot = self.pilots.get(bucket as usize)?.get();
        let slot = lipz_layout::slot_of(spread, pilot, self.clips.len() as u32);
        let record = self.keys.get(slot as usize)?;
        if record.id.get() != id.get() {
            keep_branch();
            return None;
        }
        Some((slot, record))
    }

    /// Returns the key of a clip, without a UTF-8 check.
    #[inline]
    pub(crate) fn key_bytes(&self, record: &KeyRecord) -> Option<&'data [u8]> {
        let start = record.key_offset_bytes.get() as usize;
        self.names.slice(start, start.checked_add(usize::from(record.key_length_bytes.get()))?)
    }

    /// Returns a hash of the clips. Files that belong together share it.
    pub fn fingerprint(&self) -> u64 {
        self.file.header.fingerprint.get()
    }

    /// Returns the checksum in the header, which differs between banks of different contents. `verify` compares it with
    /// the contents; an unverified, damaged bank may have any checksum.
    pub fn checksum(&self) -> u64 {
        self.file.header.checksum.get()
    }

    /// Returns the format version, major and minor.
    pub fn format_version(&self) -> (u16, u16) {
        (self.file.header.format_major.get(), self.file.header.format_minor.get())
    }

    /// Returns the length of the bank in bytes.
    pub const fn length_bytes(&self) -> usize {
        self.file.bytes.len()
    }

    /// Returns the sections of the bank, known or not, in the order of its directory: a tag, such as `*b"CLIP"`, and
    /// the contents. For tools; `docs/reference/bank-format.md` describes the contents.
    pub fn sections(&self) -> impl Iterator<Item = ([u8; 4], &'data [u8])> + '_ {
        self.file.sections()
    }
}

/// Keeps the compiler from selecting one of two results without a branch, at no instruction. A processor predicts a
/// branch, and continues with the clip before it has compared the ids. After a selection, everything would wait for
/// both results.
#[inline(always)]
fn keep_branch() {
    compiler_fence(Ordering::SeqCst);
}

/// Returns the locales of a file with texts for this number of segments, which may be a whole bank.
pub(crate) fn text_table<'data>(file: &File<'data>, segment_count: usize) -> Result<LocaleTable<'data>, Error> {
    let mut found: Sections<'data> = [&[]; Tag::REQUIRED.len()];
    file.find(if file.has_texts_only() { TEXT_SECTIONS } else { ALL_SECTIONS }, &mut found)?;
    Ok(LocaleTable::new(&found, segment_count))
}

/// Prints a summary of the bank, not its bytes.
impl fmt::Debug for Bank<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Bank")
            .field("length_bytes", &self.file.bytes.len())
            .field("clip_count", &self.clips.len())
            .field("locale_count", &self.texts.records.len())
            .finish_non_exhaustive()
    }
}
