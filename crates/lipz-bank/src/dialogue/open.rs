//! Opens a dialogue, from bytes or from open files.

use super::file::{BankFile, Contents, FilesRef};
use super::queries::QUERIES;
use super::{Answers, Base, Dialogue, DialogueError, DialogueFile, Files};
use crate::origin::{Origin, add_checksum};
use crate::verify::Utf8;
use crate::{Bank, Error, ErrorKind};
use core::mem::MaybeUninit;
use lipz_layout::{Tag, U64};

impl<'a> Dialogue<'a> {
    /// Opens and verifies the files that fill `contents`, and stores them in `files`, which must be at least as long.
    ///
    /// The base comes first: a bank, or the index of a set followed by all of its banks, in the order of the index.
    /// Then come patches, each after those below it, and text banks, each after the bank of its clips. Empty bytes
    /// stand for a bank of a set that is not loaded yet; its clips are missing.
    ///
    /// # Errors
    /// The first file that is damaged, or that does not match those before it.
    pub fn open(
        files: &'a mut [DialogueFile<'a>],
        contents: impl IntoIterator<Item = &'a [u8]>,
    ) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::open_each(files, contents, Some(crate::verify::core_utf8))
    }

    /// Like [`Dialogue::open`], with the program's own UTF-8 check, as for [`Bank::verify_with`].
    ///
    /// # Errors
    /// As [`Dialogue::open`].
    pub fn open_with(
        files: &'a mut [DialogueFile<'a>],
        contents: impl IntoIterator<Item = &'a [u8]>,
        utf8: fn(&'a [u8]) -> Option<&'a str>,
    ) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::open_each(files, contents, Some(utf8))
    }

    /// Opens the one bank that fills `bytes`, without verifying it, and stores it in `file`. For firmware whose bank
    /// was verified when it was packed.
    ///
    /// On 32-bit processors, a program that opens only single banks does not contain the code for verifying, patches,
    /// sets and text banks, unless it lists locales.
    ///
    /// `file` need not be initialised, because an [absent](DialogueFile::ABSENT) file would be copied from ROM first.
    ///
    /// # Errors
    /// As [`Bank::open`]; [`ErrorKind::OtherBase`] for a patch.
    pub fn open_bank(file: &'a mut MaybeUninit<DialogueFile<'a>>, bytes: &'a [u8]) -> Result<Dialogue<'a>, Error> {
        let bank = Bank::open(bytes)?;
        if bank.file.entry(Tag::LAYER).is_some() {
            return Err(Error::new(ErrorKind::OtherBase, 0));
        }
        let file: &'a DialogueFile<'a> =
            file.write(DialogueFile { contents: Contents::Bank(BankFile { bank, layer: None }) });
        match &file.contents {
            Contents::Bank(base) => Ok(Dialogue::alone(FilesRef::Slice(core::slice::from_ref(file)), base)),
            // Unreachable: a bank was just stored.
            _ => Err(Error::new(ErrorKind::OtherBase, 0)),
        }
    }

    /// Like [`Dialogue::open`], without verifying anything, in a time that does not depend on the number of clips. Each
    /// text is checked to be UTF-8 on each query.
    ///
    /// # Errors
    /// As [`Dialogue::open`], as far as headers, directories and patches show them.
    pub fn open_unverified(
        files: &'a mut [DialogueFile<'a>],
        contents: impl IntoIterator<Item = &'a [u8]>,
    ) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::open_each(files, contents, None)
    }

    fn open_each(
        files: &'a mut [DialogueFile<'a>],
        contents: impl IntoIterator<Item = &'a [u8]>,
        utf8: Option<Utf8<'a>>,
    ) -> Result<Dialogue<'a>, DialogueError> {
        let mut count = 0_usize;
        for bytes in contents {
            let failed = |error| DialogueError::new(count, error);
            let (before, rest) = files.split_at_mut(count.min(files.len()));
            let place = rest.first_mut().ok_or(failed(Error::new(ErrorKind::LayerCount, 0)))?;
            // Only a bank of a set may be missing: any other empty file is cut off.
            let index = if count > 0 { before.first().and_then(DialogueFile::set_index) } else { None };
            let is_absent = bytes.is_empty() && index.map_or(false, |index| count <= index.bank_count());
            let opened = if is_absent { Ok(DialogueFile::ABSENT) } else { DialogueFile::open(bytes, count) };
            let opened = match utf8 {
                Some(utf8) => opened.and_then(|file| file.verify_in(before, count, utf8)),
                None => opened,
            };
            *place = opened.map_err(failed)?;
            count = count.saturating_add(1);
        }
        let files: &'a [DialogueFile<'a>] = files;
        Dialogue::of(FilesRef::Slice(files.get(..count).unwrap_or(files)), false)
    }

    /// Returns the dialogue of these files, which are [opened](DialogueFile::open) and optionally verified.
    ///
    /// A patch matches if the banks that it was packed over are below it, in their order. Other banks may be between
    /// them: a mod of the base also matches on top of the base's patch. Takes time in proportion to the patches'
    /// descriptions of the banks below. Banks of a set are not opened. A single patch is a dialogue of its own clips,
    /// for tools that inspect it.
    ///
    /// # Errors
    /// The first file that does not match those before it.
    pub fn new(files: &'a [DialogueFile<'a>]) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::of(FilesRef::Slice(files), true)
    }

    /// Like [`Dialogue::new`], for files that the program opens on demand. The base must not be a patch.
    ///
    /// # Errors
    /// As [`Dialogue::new`].
    pub fn with_files(files: &'a dyn Files) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::of(FilesRef::Lazy(files), false)
    }

    /// With `takes_part`, the base may be a patch.
    fn of(files: FilesRef<'a>, takes_part: bool) -> Result<Dialogue<'a>, DialogueError> {
        let failed = |number, kind| DialogueError::new(number, Error::new(kind, 0));
        let first = files.file(0).ok_or(failed(0, ErrorKind::LayerCount))?;
        let base = match &first.contents {
            Contents::Bank(BankFile { layer: Some(_), .. }) if !takes_part => {
                return Err(failed(0, ErrorKind::OtherBase));
            }
            Contents::Bank(bank) => Base::Bank(bank),
            Contents::Set(index) => Base::Set(*index),
            Contents::Texts(_) => return Err(failed(0, ErrorKind::TextsOnly)),
            Contents::Absent => return Err(failed(0, ErrorKind::LayerCount)),
        };
        if files.count() > usize::from(u16::MAX) {
            return Err(failed(files.count(), ErrorKind::LayerCount));
        }
        if let (Base::Bank(bank), 1) = (&base, files.count()) {
            return Ok(Dialogue::alone(files, bank));
        }
        let mut dialogue = Dialogue::with_base(files, Answers::Together(&QUERIES), base, Origin::NONE);
        dialogue.check_base()?;
        let mut hash = first.checksum();
        for number in dialogue.behind_base()..files.count() {
            let file = match files.file(number) {
                Some(file) => file,
                None => continue,
            };
            match &file.contents {
                Contents::Bank(bank) => dialogue.add_patch(number, bank)?,
                Contents::Texts(texts) if !dialogue.has_bank_of(number, texts) => {
                    return Err(failed(number, ErrorKind::OtherClips));
                }
                Contents::Texts(_) | Contents::Absent => {}
                Contents::Set(_) => return Err(failed(number, ErrorKind::NotALayer)),
            }
            hash = add_checksum(hash, file.checksum());
        }
        dialogue.origin = Origin::of_hash(hash);
        Ok(dialogue)
    }

    /// Returns the dialogue of one bank.
    fn alone(files: FilesRef<'a>, file: &'a BankFile<'a>) -> Dialogue<'a> {
        Dialogue::with_base(files, Answers::Alone(&file.bank), Base::Bank(file), file.bank.origin)
    }

    /// Returns a dialogue without patches.
    fn with_base(files: FilesRef<'a>, answers: Answers<'a>, base: Base<'a>, origin: Origin) -> Dialogue<'a> {
        let (patches, filters) = ([None; Dialogue::MAX_PATCHES], [&[] as &[U64]; Dialogue::MAX_PATCHES]);
        Dialogue { files, answers, base, patches, filters, patch_count: 0, origin, removes_locales: false }
    }

    /// Checks the loaded banks of a set against its index.
    fn check_base(&self) -> Result<(), DialogueError> {
        if let (Base::Set(index), 1..) = (&self.base, self.files.count()) {
            if self.files.count() < self.behind_base() {
                let error = Error::new(ErrorKind::OtherBank, 0);
                return Err(DialogueError::new(0, error));
            }
            for (number, named) in (1..).zip(index.banks()) {
                match self.files.file_if_open(number).map(|file| &file.contents) {
                    Some(Contents::Bank(file)) if named.is_of(&file.bank) => {}
                    None | Some(Contents::Absent) => {}
                    Some(_) => return Err(DialogueError::new(number, Error::new(ErrorKind::OtherBank, 0))),
                }
            }
        }
        Ok(())
    }
}
