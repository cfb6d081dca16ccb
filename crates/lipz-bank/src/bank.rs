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
/// `'data` is the life of the bytes. Strings and frame codes that queries return live that long,
/// not only as long as this value.
#[derive(Clone, Copy)]
pub struct Bank<'data> {
    pub(crate) file: File<'data>,
    /// What the handles of this bank have.
    pub(crate) origin: Origin,
    /// The number of the bank among the files of its dialogue.
    pub(crate) number: u32,
    /// The hash of the list of its locales, in a dialogue.
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
    /// The locales, which may be those of a text bank.
    pub(crate) texts: LocaleTable<'data>,
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
        let file = File::open(bytes)?;
        if file.has_texts_only() {
            return Err(Error::new(ErrorKind::TextsOnly, 0));
        }
        Bank::of_file(file)
    }

    /// The bank in a file that has clips.
    #[inline(always)]
    pub(crate) fn of_file(file: File<'data>) -> Result<Bank<'data>, Error> {
        let mut found: Sections<'data> = [&[]; Tag::REQUIRED.len()];
        file.find(ALL_SECTIONS, &mut found)?;
        Ok(Bank::from_sections(file, &found))
    }

    /// The bank of these sections.
    #[inline(always)] // a bank is many words, and the caller knows where they go
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

    /// Checks every byte and every reference, and returns the bank with its strings marked as
    /// checked: from then on no query fails for which there is data, and texts cost no UTF-8 check.
    ///
    /// # Errors
    /// The first damage found.
    #[inline(always)]
    pub fn verify(self) -> Result<Bank<'data>, Error> {
        self.verify_with(crate::verify::core_utf8)
    }

    /// Like [`Bank::verify`], with a UTF-8 check of the program's own: that of the standard library takes
    /// half of the time.
    ///
    /// `utf8` gives the bytes that it gets as a string, or nothing if they are not UTF-8. That of
    /// [simdutf8](https://docs.rs/simdutf8) is many times faster than the standard library's:
    /// `bank.verify_with(|bytes| simdutf8::basic::from_utf8(bytes).ok())`.
    ///
    /// # Errors
    /// The first damage found.
    #[inline(always)] // a bank is many words, and the caller knows where they go
    pub fn verify_with(mut self, utf8: fn(&'data [u8]) -> Option<&'data str>) -> Result<Bank<'data>, Error> {
        crate::verify::verify(&mut self, utf8)?;
        Ok(self)
    }

    /// Like [`Bank::verify`], for programs on small machines that show mouths, texts and events, and nothing else: leaves out
    /// the sections of babble, faces, recordings, curves and voices, and so the code that checks them. Their bytes are in the checksum
    /// all the same; of a forged bank, queries about them may have wrong answers or none.
    ///
    /// # Errors
    /// The first damage found.
    #[inline(always)]
    pub fn verify_lines(mut self) -> Result<Bank<'data>, Error> {
        crate::verify::lines(&mut self, crate::verify::core_utf8)?;
        Ok(self)
    }

    /// Checks all of the bank but the checksum and what frames and texts say: for tools that copy these from verified banks, and
    /// have the tables in memory before them. Queries gain nothing by it.
    ///
    /// # Errors
    /// The first damage found.
    pub fn verify_tables(&self) -> Result<(), Error> {
        crate::verify::tables(*self)
    }

    /// Opens and verifies the text bank that fills `bytes`, and puts its locales in place of those of the bank. Handles of locales
    /// that were looked up before lead to no text any more.
    ///
    /// A program that has one language in memory packs with `--split-locales`, and opens the bank with the text bank of the
    /// language. A [`Dialogue`](crate::Dialogue) takes several at the same time.
    ///
    /// ```
    /// use lipz_bank::{Bank, Error};
    ///
    /// # fn main() -> Result<(), Error> {
    /// # let base: &[u8] = include_bytes!("../examples/act1.lipzbank");
    /// # let german = base; // a whole bank is accepted, too
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
    /// As [`Bank::verify`]; when the texts belong to other clips, or when the bank itself is not
    /// [verified](Bank::is_verified). The bank stays as it was.
    pub fn open_texts(&mut self, bytes: &'data [u8]) -> Result<(), Error> {
        let (file, mut table) = self.text_file(bytes)?;
        crate::verify::text_file(&file, &mut table, self, crate::verify::core_utf8)?;
        self.take_texts(&file, table);
        Ok(())
    }

    /// Like [`Bank::open_texts`], without verifying anything, in a time that depends only on the number of sections.
    ///
    /// # Errors
    /// As [`Bank::open`], and when the texts belong to other clips. The bank stays as it was.
    pub fn open_texts_unverified(&mut self, bytes: &'data [u8]) -> Result<(), Error> {
        let (file, table) = self.text_file(bytes)?;
        self.take_texts(&file, table);
        Ok(())
    }

    /// The table of a text bank for the clips of this bank.
    fn text_file(&self, bytes: &'data [u8]) -> Result<(File<'data>, LocaleTable<'data>), Error> {
        let file = File::open(bytes)?;
        let table = text_table(&file, self.texts.segment_count)?;
        if file.header.fingerprint.get() != self.fingerprint() {
            return Err(Error::new(ErrorKind::OtherClips, 24));
        }
        Ok((file, table))
    }

    /// Puts the locales of another file in place of those of the bank, as a different origin of handles.
    fn take_texts(&mut self, file: &File<'data>, texts: LocaleTable<'data>) {
        self.texts = texts;
        self.origin = Origin::of_hash(add_checksum(self.checksum(), file.header.checksum.get()));
    }

    /// Whether the bank came from [`Bank::verify`], [`Bank::verify_with`] or [`Bank::verify_lines`], which leaves out some sections.
    pub const fn is_verified(&self) -> bool {
        self.event_strings.is_checked()
    }

    /// The number of clips.
    #[inline]
    pub const fn clip_count(&self) -> usize {
        self.clips.len()
    }

    /// The clip with this id: one pilot, two records, no loop.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        let (slot, _) = self.find(id)?;
        self.clip_at(slot)
    }

    /// The clip with this key, compared whole.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        let (slot, record) = self.find(ClipId::from_key(key))?;
        if self.key_bytes(record)? == key.as_bytes() { self.clip_at(slot) } else { None }
    }

    /// The clip in this slot, a number below [`Bank::clip_count`]. Slots are in no order that means anything.
    #[inline]
    pub fn clip_at(&self, slot: u32) -> Option<Clip<'_>> {
        Clip::new(self, slot, None, true)
    }

    /// The number of the clip with this record, which is one of the table.
    #[inline]
    pub(crate) fn slot_of(&self, record: &ClipRecord) -> u32 {
        let table = self.clips.as_ptr() as usize;
        let offset_bytes = (record as *const ClipRecord as usize).wrapping_sub(table);
        const CLIP_BYTES: usize = size_of::<ClipRecord>();
        offset_bytes.checked_div(CLIP_BYTES).unwrap_or(0) as u32
    }

    /// All clips in the order of their keys.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'_>> + Clone + '_ {
        Clips::new(self, 0, self.key_order.len())
    }

    /// The clips whose keys start with `prefix`, in the order of their keys: `act1/` gives those of
    /// a folder.
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

    /// The slot that the index names for `id`, and the key record there, if it has that id.
    // Long code where 64-bit products are not instructions.
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

    /// The key of a clip, not checked to be UTF-8.
    #[inline]
    pub(crate) fn key_bytes(&self, record: &KeyRecord) -> Option<&'data [u8]> {
        let start = record.key_offset_bytes.get() as usize;
        self.names.slice(start, start.checked_add(usize::from(record.key_length_bytes.get()))?)
    }

    /// Hash of what the clips of this bank are: files that belong together share it.
    pub fn fingerprint(&self) -> u64 {
        self.file.header.fingerprint.get()
    }

    /// Checksum of the contents, as the header has it: banks of different contents have different ones. `verify`
    /// compares it with the contents; before that, a damaged bank may have any.
    pub fn checksum(&self) -> u64 {
        self.file.header.checksum.get()
    }

    /// Format version, major and minor.
    pub fn format_version(&self) -> (u16, u16) {
        (self.file.header.format_major.get(), self.file.header.format_minor.get())
    }

    /// Length of the bank.
    pub const fn length_bytes(&self) -> usize {
        self.file.bytes.len()
    }

    /// The sections of the bank in the order of its directory, known or not: tag, such as `*b"CLIP"`, and
    /// contents. For tools; `docs/reference/bank-format.md` says what is in them.
    pub fn sections(&self) -> impl Iterator<Item = ([u8; 4], &'data [u8])> + '_ {
        self.file.sections()
    }
}

/// Keeps the compiler from choosing between two answers without a branch, at no instruction: a processor predicts a branch, and
/// goes on with the clip before it has compared the ids. A choice would make all that follows wait for both.
#[inline(always)]
fn keep_branch() {
    compiler_fence(Ordering::SeqCst);
}

/// The locales in a file with texts for so many segments, which may be a whole bank.
pub(crate) fn text_table<'data>(file: &File<'data>, segment_count: usize) -> Result<LocaleTable<'data>, Error> {
    let mut found: Sections<'data> = [&[]; Tag::REQUIRED.len()];
    file.find(if file.has_texts_only() { TEXT_SECTIONS } else { ALL_SECTIONS }, &mut found)?;
    Ok(LocaleTable::new(&found, segment_count))
}

/// What the bank has, not its bytes.
impl fmt::Debug for Bank<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Bank")
            .field("length_bytes", &self.file.bytes.len())
            .field("clip_count", &self.clips.len())
            .field("locale_count", &self.texts.records.len())
            .finish_non_exhaustive()
    }
}
