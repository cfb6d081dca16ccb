//! Where the sections of a bank are, as numbers: what a program keeps that cannot keep a [`Bank`].

use crate::file::{ALL_SECTIONS, File, Sections};
use crate::{Bank, Error, ErrorKind};
use lipz_layout::Tag;

/// How many words [`Places`] have: two for the checksum, and for each section where it starts and where it ends.
const WORDS: usize = 2 + 2 * Tag::REQUIRED.len();

/// Where the sections of a bank are: what [`Bank::open`] looks up, as plain numbers.
///
/// A [`Bank`] borrows its bytes, so a struct of C or a region of shared memory cannot keep one. It can keep these
/// numbers, and [`Bank::open_at`] makes a bank of them in a fifth of the time.
///
/// ```
/// use lipz_bank::{Bank, Error, Places};
///
/// # let bytes: &[u8] = include_bytes!("../examples/act1.lipzbank");
/// let kept = Places::find(bytes)?.to_words();
/// let bank = Bank::open_at(bytes, &Places::from_words(kept));
/// assert!(bank.map_or(false, |bank| bank.clip_count() > 0));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Places {
    words: [u32; WORDS],
}

impl Places {
    /// How many words places have.
    pub const WORDS: usize = WORDS;

    /// Looks for the sections of the bank that fills `bytes`, as [`Bank::open`] does.
    ///
    /// # Errors
    /// As [`Bank::open`].
    #[inline(always)] // places are many words, and the caller knows where they go
    pub fn find(bytes: &[u8]) -> Result<Places, Error> {
        let file = Bank::open_file(bytes)?;
        let mut found: Sections<'_> = [&[]; Tag::REQUIRED.len()];
        file.find(ALL_SECTIONS, &mut found)?;
        let checksum = file.header.checksum.get();
        let mut words = [0; WORDS];
        let [low, high, sections @ ..] = &mut words;
        *low = checksum as u32;
        *high = (checksum >> 32) as u32;
        for (place, section) in sections.chunks_exact_mut(2).zip(found) {
            if let [start, end] = place {
                let offset = (section.as_ptr() as usize).wrapping_sub(bytes.as_ptr() as usize);
                *start = offset as u32;
                *end = offset.wrapping_add(section.len()) as u32;
            }
        }
        Ok(Places { words })
    }

    /// The places of these words. Any words are taken: what does not lie in the bytes of a bank is empty there.
    pub const fn from_words(words: [u32; WORDS]) -> Places {
        Places { words }
    }

    /// The numbers to keep.
    pub const fn to_words(self) -> [u32; WORDS] {
        self.words
    }
}

impl<'data> Bank<'data> {
    /// The bank that fills `bytes`, whose sections are at `places`; `None` if those were found in other bytes: the
    /// checksum in the header, or the length of the file, is another one.
    ///
    /// As after [`Bank::open`], no query panics, reads out of bounds or loops without bound. Places that were not
    /// found in these bytes, but forged, lead to wrong answers.
    pub fn open_at(bytes: &'data [u8], places: &Places) -> Option<Bank<'data>> {
        let file = File::read(bytes)?;
        let [low, high, sections @ ..] = &places.words;
        let checksum = u64::from(*low) | u64::from(*high) << 32;
        if file.header.checksum.get() != checksum || file.header.file_length_bytes.get() as usize != bytes.len() {
            return None;
        }
        let mut found: Sections<'data> = [&[]; Tag::REQUIRED.len()];
        for (section, place) in found.iter_mut().zip(sections.chunks_exact(2)) {
            if let [start, end] = place {
                *section = bytes.get(*start as usize..*end as usize).unwrap_or(&[]);
            }
        }
        Some(Bank::from_sections(file, &found))
    }

    /// Checks header and directory, and that the file is one with clips.
    #[inline(always)]
    pub(crate) fn open_file(bytes: &'data [u8]) -> Result<File<'data>, Error> {
        let file = File::open(bytes)?;
        if file.has_texts_only() {
            return Err(Error::new(ErrorKind::TextsOnly, 0));
        }
        Ok(file)
    }
}
