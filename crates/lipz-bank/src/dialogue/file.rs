//! The files of a dialogue, each opened by its kind.

use super::Layer;
use crate::bank::text_table;
use crate::file::File;
use crate::locale::LocaleTable;
use crate::set_index::SetIndex;
use crate::{Bank, Error, ErrorKind};
use core::fmt;

/// Access to the files of a [`Dialogue`](crate::Dialogue): a slice, or a type of the program that opens the banks of a
/// set on demand.
pub trait Files: Sync {
    /// Returns the number of files. The banks of a set are separate files, after its index.
    fn count(&self) -> usize;

    /// Returns the file with this number, and opens it first if necessary; `None` if it is missing.
    fn file(&self, number: usize) -> Option<&DialogueFile<'_>>;

    /// Returns the file with this number, if it is open.
    fn file_if_open(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.file(number)
    }
}

/// The files of a dialogue.
#[derive(Clone, Copy)]
pub(super) enum FilesRef<'a> {
    /// Files that the program has opened.
    Slice(&'a [DialogueFile<'a>]),
    /// Files that are opened on demand.
    Lazy(&'a dyn Files),
}

impl<'a> FilesRef<'a> {
    #[inline]
    pub(super) fn count(self) -> usize {
        match self {
            FilesRef::Slice(files) => files.len(),
            FilesRef::Lazy(files) => files.count(),
        }
    }

    #[inline]
    pub(super) fn file(self, number: usize) -> Option<&'a DialogueFile<'a>> {
        match self {
            FilesRef::Slice(files) => files.get(number),
            FilesRef::Lazy(files) => files.file(number),
        }
    }

    pub(super) fn file_if_open(self, number: usize) -> Option<&'a DialogueFile<'a>> {
        match self {
            FilesRef::Slice(files) => files.get(number),
            FilesRef::Lazy(files) => files.file_if_open(number),
        }
    }
}

impl Files for [DialogueFile<'_>] {
    #[inline]
    fn count(&self) -> usize {
        self.len()
    }

    #[inline]
    fn file(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.get(number)
    }
}

/// An opened file of a dialogue. Its header and directory determine its kind.
#[derive(Clone, Copy)]
pub struct DialogueFile<'data> {
    pub(super) contents: Contents<'data>,
}

/// The kind of a file.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum FileKind {
    /// An empty place for a file.
    Absent,
    /// A bank with clips, which needs no other file.
    Bank,
    /// A bank that was packed over others: a patch, a download, a mod, or the dubs of a voice.
    Patch,
    /// The texts of locales, for the clips of a bank.
    Texts,
    /// The index of a set of banks.
    Set,
}

/// The contents of a file by its kind.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant)] // there is no allocator, and most files are banks
pub(super) enum Contents<'data> {
    Absent,
    Bank(BankFile<'data>),
    Texts(TextFile<'data>),
    Set(SetIndex<'data>),
}

/// A bank with the data that a dialogue needs about it.
#[derive(Clone, Copy)]
pub(super) struct BankFile<'data> {
    pub(super) bank: Bank<'data>,
    /// The description of the banks below, if it is a patch.
    pub(super) layer: Option<Layer<'data>>,
}

/// A text bank.
#[derive(Clone, Copy)]
pub(super) struct TextFile<'data> {
    file: File<'data>,
    pub(super) table: LocaleTable<'data>,
    /// The hash of the list of its locales.
    pub(super) locale_list: u32,
}

impl TextFile<'_> {
    /// Whether the texts belong to this bank.
    pub(super) fn is_beside(&self, bank: &Bank<'_>) -> bool {
        self.fingerprint() == bank.fingerprint() && self.table.segment_count == bank.texts.segment_count
    }

    /// Returns the fingerprint of the clips that the texts belong to.
    pub(super) fn fingerprint(&self) -> u64 {
        self.file.header.fingerprint.get()
    }
}

impl<'data> DialogueFile<'data> {
    /// An empty place for a file.
    pub const ABSENT: DialogueFile<'static> = DialogueFile { contents: Contents::Absent };

    /// Opens the file that fills `bytes`, with this number in its dialogue. Checks header and directory, and in a patch
    /// the description of the banks below it.
    ///
    /// # Errors
    /// If the bytes are not a bank, a text bank or the index of a set, or if these parts are cut off or damaged.
    pub fn open(bytes: &'data [u8], number: usize) -> Result<DialogueFile<'data>, Error> {
        if bytes.starts_with(&lipz_layout::SET_MAGIC) {
            return Ok(DialogueFile { contents: Contents::Set(SetIndex::open(bytes)?) });
        }
        let file = File::open(bytes)?;
        let contents = if file.has_texts_only() {
            let table = text_table(&file, 0)?;
            let starts = table.starts.len().saturating_sub(1);
            let segment_count = starts.checked_div(table.records.len()).unwrap_or(0);
            let table = LocaleTable { segment_count, ..table };
            Contents::Texts(TextFile { file, table, locale_list: table.list_hash() })
        } else {
            let bank = Bank::of_file(file)?;
            let bank = Bank { number: number as u32, locale_list: bank.texts.list_hash(), ..bank };
            Contents::Bank(BankFile { bank, layer: bank.verified_layer()? })
        };
        Ok(DialogueFile { contents })
    }

    /// Checks every byte and every reference, and returns the file with its strings marked as checked.
    ///
    /// The file is the one with this number among `files`; those before it must be verified. Texts are checked against
    /// each of these banks that they belong to, and the bank of a set against the index.
    ///
    /// `utf8` is the program's own UTF-8 check, as for [`Bank::verify_with`].
    ///
    /// # Errors
    /// The first damage found. For texts: [`ErrorKind::TextsOnly`] without a file before them,
    /// [`ErrorKind::OtherClips`] if they belong to none of the banks, and [`ErrorKind::BankNotVerified`] if their bank
    /// was not verified. For the bank of a set: [`ErrorKind::OtherBank`] if the index names a different one.
    pub fn verify_in<F: Files + ?Sized>(
        self,
        files: &F,
        number: usize,
        utf8: fn(&'data [u8]) -> Option<&'data str>,
    ) -> Result<DialogueFile<'data>, Error> {
        let contents = match self.contents {
            Contents::Absent => Contents::Absent,
            Contents::Bank(file) => {
                let bank = file.bank.verify_with(utf8)?;
                let index = if number > 0 { files.file(0).and_then(DialogueFile::set_index) } else { None };
                if let Some(index) = index.filter(|index| number <= index.bank_count()) {
                    index.verify_bank(number.wrapping_sub(1), &bank)?;
                }
                Contents::Bank(BankFile { bank, ..file })
            }
            Contents::Set(index) => Contents::Set(index.verify()?),
            Contents::Texts(texts) => {
                let mut verified = match number {
                    0 => Err(Error::new(ErrorKind::TextsOnly, 0)),
                    _ => Err(Error::new(ErrorKind::OtherClips, 24)),
                };
                for bank in (0..number).filter_map(|number| files.file(number)?.bank()) {
                    if texts.is_beside(bank) {
                        let mut table = texts.table;
                        crate::verify::text_file(&texts.file, &mut table, bank, utf8)?;
                        verified = Ok(table);
                    }
                }
                Contents::Texts(TextFile { table: verified?, ..texts })
            }
        };
        Ok(DialogueFile { contents })
    }

    /// Returns the kind of the file.
    pub const fn kind(&self) -> FileKind {
        match &self.contents {
            Contents::Absent => FileKind::Absent,
            Contents::Bank(BankFile { layer: None, .. }) => FileKind::Bank,
            Contents::Bank(_) => FileKind::Patch,
            Contents::Texts(_) => FileKind::Texts,
            Contents::Set(_) => FileKind::Set,
        }
    }

    /// Returns the bank, if the file is one.
    pub const fn bank(&self) -> Option<&Bank<'data>> {
        match &self.contents {
            Contents::Bank(file) => Some(&file.bank),
            _ => None,
        }
    }

    /// Returns the index, if the file is the index of a set.
    pub const fn set_index(&self) -> Option<&SetIndex<'data>> {
        match &self.contents {
            Contents::Set(index) => Some(index),
            _ => None,
        }
    }

    /// Returns the length of the file in bytes; 0 for an absent file.
    pub const fn length_bytes(&self) -> usize {
        match &self.contents {
            Contents::Absent => 0,
            Contents::Bank(file) => file.bank.length_bytes(),
            Contents::Texts(texts) => texts.file.bytes.len(),
            Contents::Set(index) => index.length_bytes(),
        }
    }

    /// Returns the checksum in the header, which differs between files of different contents; 0 for an absent file.
    pub fn checksum(&self) -> u64 {
        match &self.contents {
            Contents::Absent => 0,
            Contents::Bank(file) => file.bank.checksum(),
            Contents::Texts(texts) => texts.file.header.checksum.get(),
            Contents::Set(index) => index.checksum(),
        }
    }
}

impl fmt::Debug for DialogueFile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DialogueFile").field("kind", &self.kind()).finish_non_exhaustive()
    }
}
