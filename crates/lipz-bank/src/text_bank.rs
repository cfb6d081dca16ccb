//! Text banks: locales in files of their own, opened together with the bank of their clips.

use core::fmt;

use crate::file::{ALL_SECTIONS, File, Sections, TEXT_SECTIONS};
use crate::locale::LocaleTable;
use crate::origin::Origin;
use crate::{Bank, Error, ErrorKind, Locale, Locales};
use lipz_layout::Tag;

/// The texts of one or more locales in a file of their own, which belongs to one [`Bank`].
///
/// A game that ships in many languages packs a base bank and a text bank per locale, and opens the base with the
/// one that the player reads. A [`Locale`] from here is used as one of the bank itself; no query
/// costs more.
///
/// ```
/// use lipz_bank::{Bank, Error};
///
/// fn german_text<'a>(base: &'a [u8], texts: &'a [u8], key: &str) -> Result<Option<&'a str>, Error> {
///     let bank = Bank::open(base)?.verify()?;
///     let texts = bank.open_texts(texts)?.verify(&bank)?;
///     let segment = bank.clip_by_key(key).and_then(|clip| clip.segment(0));
///     let text = segment.zip(texts.locale("de-de")).and_then(|(segment, german)| segment.text(german));
///     Ok(text.map(|text| text.as_str()))
/// }
/// # let base = include_bytes!("../examples/act1.lipzbank");
/// # let texts = base; // a whole bank serves, too
/// assert_eq!(german_text(base, texts, "act1/mara-good-evening")?, Some("Guten Abend, Otto."));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct TextBank<'data> {
    /// The bank of the clips.
    pub(crate) bank: Origin,
    pub(crate) file: File<'data>,
    pub(crate) table: LocaleTable<'data>,
}

impl Bank<'_> {
    /// Opens a text bank for the clips of this bank, in a time that depends only on the number of
    /// sections.
    ///
    /// # Errors
    /// As [`Bank::open`], and when the texts belong to other clips: the fingerprints differ.
    pub fn open_texts<'texts>(&self, bytes: &'texts [u8]) -> Result<TextBank<'texts>, Error> {
        let file = File::open(bytes)?;
        let mut found: Sections<'texts> = [&[]; Tag::REQUIRED.len()];
        // A whole bank serves, too.
        file.find(if file.has_texts_only() { TEXT_SECTIONS } else { ALL_SECTIONS }, &mut found)?;
        if file.header.fingerprint.get() != self.fingerprint() {
            return Err(Error::new(ErrorKind::OtherClips, 24));
        }
        Ok(TextBank { bank: self.origin(), file, table: LocaleTable::new(&found, self.texts.segment_count) })
    }
}

impl<'data> TextBank<'data> {
    /// Checks every byte and every reference against `bank`; afterwards texts cost no UTF-8 check. The locales are
    /// for segments of that bank from then on.
    ///
    /// # Errors
    /// The first damage found; before that, [`ErrorKind::BankNotVerified`] if `bank` itself was not
    /// [verified](Bank::verify).
    pub fn verify(self, bank: &Bank<'_>) -> Result<TextBank<'data>, Error> {
        self.verify_with(bank, crate::verify::core_utf8)
    }

    /// Like [`TextBank::verify`], with a UTF-8 check of the program's own: see [`Bank::verify_with`].
    ///
    /// # Errors
    /// As [`TextBank::verify`].
    pub fn verify_with(
        mut self,
        bank: &Bank<'_>,
        utf8: fn(&'data [u8]) -> Option<&'data str>,
    ) -> Result<TextBank<'data>, Error> {
        crate::verify::verify_texts(&mut self, bank, utf8)?;
        Ok(self)
    }

    /// The locale with this tag, spelled as in the file (`de-de`). Look it up once and pass it to text queries.
    pub fn locale(&self, tag: &str) -> Option<Locale<'data>> {
        self.table.locale(self.bank, tag)
    }

    /// The locales of the file, in the order of their tags.
    pub fn locales(&self) -> Locales<'data> {
        self.table.locales(self.bank)
    }

    /// Checksum of the contents, as the header has it: see [`Bank::checksum`].
    pub fn checksum(&self) -> u64 {
        self.file.header.checksum.get()
    }

    /// Length of the file.
    pub const fn length_bytes(&self) -> usize {
        self.file.bytes.len()
    }

    /// The sections of the file in the order of its directory, known or not: tag and contents.
    pub fn sections(&self) -> impl Iterator<Item = ([u8; 4], &'data [u8])> + '_ {
        self.file.sections()
    }
}

/// The locales, not the texts.
impl fmt::Debug for TextBank<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("TextBank").field(&self.locales()).finish()
    }
}
