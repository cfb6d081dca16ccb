//! A dialogue: any number of files that answer as one bank.
//!
//! A *base*, which is a bank or the [set](crate::files::SetIndex) of the banks of all shards, has *patches* over it, the topmost
//! of which answers, and the texts of locales next to it in files of their own.

mod clips;
mod error;
mod file;
mod layer;
mod locales;
mod profiles;
mod queries;
mod stack;
mod voices;

pub use error::DialogueError;
pub use file::{DialogueFile, FileKind, Files};
pub use layer::Layer;

use crate::event::NameKey;
use crate::origin::{Origin, add_checksum};
use crate::set_index::SetIndex;
use crate::verify::Utf8;
use crate::{Bank, Clip, ClipId, Error, ErrorKind, EventName};
use core::fmt;
use core::mem::MaybeUninit;
use file::{BankFile, Contents, FilesRef};
use lipz_layout::{Tag, U64};
use queries::QUERIES;
pub(crate) use queries::Queries;

/// Patches that a dialogue has room for.
pub(crate) const MAX_PATCHES: usize = 15;

/// Files that answer as one bank: a bank or a set of banks, the patches over it, and text banks.
///
/// A game opens a dialogue and asks it; which files it is made of, and how many, changes nothing else. A patch, a download or a
/// mod is a bank that was packed with `--over`, and `--split-voices` makes such banks of dubs. The dialogue answers as the bank
/// would that was packed with all of it in one go.
///
/// The files are in memory of the program, and their contents in bytes of the program: nothing is allocated.
///
/// ```
/// use lipz_bank::files::DialogueFile;
/// use lipz_bank::{ClipId, Dialogue, Micros};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let base: &[u8] = include_bytes!("../../examples/act1.lipzbank");
/// let mut files = [DialogueFile::ABSENT; 8];
/// let dialogue = Dialogue::open(&mut files, [base])?; // [base, patch, german_texts]
/// let german = dialogue.locale("de-de").ok_or("no German")?;
/// let clip = dialogue.clip(ClipId::from_key("act1/mara-good-evening")).ok_or("no such clip")?;
/// let segment = clip.segment_at(Micros(500_000)).ok_or("silence")?;
/// assert_eq!(segment.text(german).map(|text| text.as_str()), Some("Guten Abend, Otto."));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy)]
pub struct Dialogue<'a> {
    files: FilesRef<'a>,
    answers: Answers<'a>,
    base: Base<'a>,
    /// The patch that is the nearest to the base, and so on.
    patches: [Option<&'a BankFile<'a>>; MAX_PATCHES],
    /// For each patch the bits of the ids that it says something about; nothing behind them.
    filters: [&'a [U64]; MAX_PATCHES],
    patch_count: usize,
    /// What the handles of this dialogue have.
    origin: Origin,
    /// Whether a patch removes locales: then none counts in the table of a bank without a look at all patches.
    removes_locales: bool,
}

/// What answers queries.
#[derive(Clone, Copy)]
pub(crate) enum Answers<'a> {
    /// The bank that is the only file, by itself.
    Alone(&'a Bank<'a>),
    /// All files together. Their queries are in a table: a program that opens one bank has none of their code.
    Together(&'static Queries),
}

/// What patches are over.
#[derive(Clone, Copy)]
enum Base<'a> {
    /// The bank that is the first file.
    Bank(&'a BankFile<'a>),
    /// The banks behind the index, which is the first file.
    Set(SetIndex<'a>),
}

/// Where a clip is.
#[derive(Clone, Copy)]
struct Found<'a> {
    bank: &'a Bank<'a>,
    /// The slot in the lower half, and in the upper one whether its texts are there, too: two registers for all.
    place: u64,
}

impl<'a> Found<'a> {
    #[inline(always)]
    fn new(bank: &'a Bank<'a>, slot: u32, has_texts: bool) -> Found<'a> {
        Found { bank, place: u64::from(has_texts) << 32 | u64::from(slot) }
    }

    #[inline(always)]
    fn slot(&self) -> u32 {
        self.place as u32
    }

    #[inline(always)]
    fn has_texts(&self) -> bool {
        self.place >> 32 != 0
    }
}

impl<'a> Dialogue<'a> {
    /// Opens and verifies the files that fill `contents`, and puts them into `files`, which has room for at least as many.
    ///
    /// The base comes first: a bank, or the index of a set with all of its banks behind it, in the order of the index. Then
    /// come patches, each over those before it, and text banks, each behind the bank of its clips. Empty bytes stand for a
    /// bank of a set that is not there yet; its clips are missing.
    ///
    /// # Errors
    /// The first file that is damaged, or that does not fit those before it.
    pub fn open(
        files: &'a mut [DialogueFile<'a>],
        contents: impl IntoIterator<Item = &'a [u8]>,
    ) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::open_each(files, contents, Some(crate::verify::core_utf8))
    }

    /// Like [`Dialogue::open`], with a UTF-8 check of the program's own, as for [`Bank::verify_with`].
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

    /// Opens the one bank that fills `bytes`, without verifying it, and puts it into `file`: for firmware, whose bank was verified
    /// when it was packed. A program that opens dialogues only in this way has no code for patches, sets, text banks and checks.
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
            _ => Err(Error::new(ErrorKind::OtherBase, 0)),
        }
    }

    /// Like [`Dialogue::open`], without verifying anything, in a time that does not depend on the number of clips. Each text is
    /// checked to be UTF-8 when it is asked for.
    ///
    /// # Errors
    /// As [`Dialogue::open`], for what headers, directories and patches show.
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
}

impl<'a> Dialogue<'a> {
    /// The dialogue of these files, which are [opened](DialogueFile::open) and, if the program wants it, verified.
    ///
    /// A patch fits if the banks that it was made over are below it, in their order. Others may lie between: a mod of the base
    /// goes over its patch, too. Takes time in proportion to what patches say about the banks below them. Banks of a set are
    /// not asked for. A patch alone is a dialogue of its own clips, for tools that look into it.
    ///
    /// # Errors
    /// The first file that does not fit those before it.
    pub fn new(files: &'a [DialogueFile<'a>]) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::of(FilesRef::Slice(files), true)
    }

    /// Like [`Dialogue::new`], for files that the program opens when they are asked for. The base must not be a patch.
    ///
    /// # Errors
    /// As [`Dialogue::new`].
    pub fn with_files(files: &'a dyn Files) -> Result<Dialogue<'a>, DialogueError> {
        Dialogue::of(FilesRef::Lazy(files), false)
    }

    /// `takes_part`: whether a patch may be the base.
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

    /// The dialogue of one bank.
    fn alone(files: FilesRef<'a>, file: &'a BankFile<'a>) -> Dialogue<'a> {
        Dialogue::with_base(files, Answers::Alone(&file.bank), Base::Bank(file), file.bank.origin)
    }

    /// A dialogue without patches.
    fn with_base(files: FilesRef<'a>, answers: Answers<'a>, base: Base<'a>, origin: Origin) -> Dialogue<'a> {
        let (patches, filters) = ([None; MAX_PATCHES], [&[] as &[U64]; MAX_PATCHES]);
        Dialogue { files, answers, base, patches, filters, patch_count: 0, origin, removes_locales: false }
    }

    /// The queries of clips, if the dialogue is more than one bank.
    #[inline]
    pub(crate) fn queries(&self) -> Option<&'static Queries> {
        match self.answers {
            Answers::Alone(_) => None,
            Answers::Together(queries) => Some(queries),
        }
    }

    /// Checks that the banks of a set that are there are those that its index names.
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

    /// The number of the first file behind the base.
    fn behind_base(&self) -> usize {
        match &self.base {
            Base::Bank(_) => 1,
            Base::Set(index) => index.bank_count().saturating_add(1),
        }
    }

    /// A number that differs between dialogues of different contents: handles that are kept as numbers, and a program that keeps
    /// more of a version, compare it.
    pub const fn version(&self) -> u32 {
        self.origin.to_u32()
    }

    /// The number of files, the index of a set and each of its banks among them.
    pub fn file_count(&self) -> usize {
        self.files.count()
    }

    /// The file with this number; `None` if it is not there. A bank of a set is opened now, if it is not open yet.
    pub fn file(&self, number: usize) -> Option<&'a DialogueFile<'a>> {
        self.files.file(number)
    }

    /// The index, if the base is a set.
    pub fn set_index(&self) -> Option<SetIndex<'a>> {
        match &self.base {
            Base::Bank(_) => None,
            Base::Set(index) => Some(*index),
        }
    }

    /// The bank that is the file with this number.
    pub fn bank(&self, number: usize) -> Option<&'a Bank<'a>> {
        Some(&self.bank_file(number)?.bank)
    }

    fn bank_file(&self, number: usize) -> Option<&'a BankFile<'a>> {
        match &self.files.file(number)?.contents {
            Contents::Bank(bank) => Some(bank),
            _ => None,
        }
    }

    /// The clip with this id, of the topmost file that has it; `None` if none does, or one above removes it.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        self.found_clip(self.find(id)?)
    }

    /// The clip with this key, compared whole.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        let found = self.find(ClipId::from_key(key))?;
        let record = found.bank.keys.get(found.slot() as usize)?;
        if found.bank.key_bytes(record)? == key.as_bytes() { self.found_clip(found) } else { None }
    }

    /// The clip that was found.
    #[cfg_attr(target_pointer_width = "64", inline(always))]
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // short code where memory is scarce
    fn found_clip(&self, found: Found<'a>) -> Option<Clip<'_>> {
        Clip::new(found.bank, found.slot(), Some(self), found.has_texts())
    }

    /// Where the clip with this id is.
    #[inline(always)] // a place in registers
    fn find(&self, id: ClipId) -> Option<Found<'a>> {
        match self.answers {
            // Where code is cheap, without a question and a call.
            _ if cfg!(target_pointer_width = "64") => self.find_in_files(id),
            Answers::Alone(bank) => Some(Found::new(bank, bank.find(id)?.0, true)),
            Answers::Together(queries) => (queries.find)(self, id),
        }
    }

    /// Where the clip with this id is, of the topmost file that has it.
    #[inline(always)] // a place in registers
    fn find_in_files(&self, id: ClipId) -> Option<Found<'a>> {
        if self.patch_count != 0 && self.may_be_patched(id) {
            return self.find_patched(id);
        }
        match &self.base {
            Base::Bank(base) => {
                let (slot, _) = base.bank.find(id)?;
                Some(Found::new(&base.bank, slot, true))
            }
            Base::Set(index) => self.find_in_set(index, id),
        }
    }

    /// Whether a patch may say something about the clip with this id: the filters let few ids through that are not those of
    /// their patches.
    #[inline(never)] // it is unrolled
    fn may_be_patched(&self, id: ClipId) -> bool {
        self.filters.iter().take_while(|filter| !filter.is_empty()).any(|filter| layer::may_have(filter, id))
    }

    /// The clip with this [slot](Clip::slot) in the file of this [number](Clip::file), without a search, for programs that
    /// keep numbers and not clips.
    #[inline]
    pub fn clip_at(&self, file: u32, slot: u32) -> Option<Clip<'_>> {
        match self.answers {
            Answers::Alone(bank) if file == 0 => self.found_clip(Found::new(bank, slot, true)),
            Answers::Alone(_) => None,
            Answers::Together(queries) => self.found_clip((queries.find_at)(self, file, slot)?),
        }
    }

    /// The name that events mention, spelled as there (`amy`); `None` if no event of any file does.
    pub fn event_name(&self, name: &str) -> Option<EventName<'_>> {
        match self.answers {
            Answers::Alone(bank) => bank.event_name(name),
            Answers::Together(queries) => (queries.event_name)(self, name),
        }
    }

    /// The name of [`EventName::to_words`]; `None` if it is from another dialogue.
    pub fn event_name_of_words(&self, words: [u32; 2]) -> Option<EventName<'_>> {
        let key = NameKey::from_words(words);
        match self.answers {
            Answers::Alone(bank) if bank.origin == key.bank => EventName::numbered(bank, key.id),
            Answers::Alone(_) => None,
            Answers::Together(queries) => (queries.name)(self, key),
        }
    }

    /// Whether the base is there: a set may be opened before any of its banks.
    pub fn has_bank(&self) -> bool {
        match self.answers {
            Answers::Alone(_) => true,
            Answers::Together(queries) => (queries.has_bank)(self),
        }
    }

    /// The number of the file that is not there and would have the clip with this id: of a bank of a set. `None` if no file could
    /// have it.
    pub fn missing_bank(&self, id: ClipId) -> Option<usize> {
        match self.answers {
            Answers::Alone(_) => None,
            Answers::Together(queries) => (queries.missing_bank)(self, id),
        }
    }
}

/// The files, not their bytes.
impl fmt::Debug for Dialogue<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let files = (0..self.files.count()).map(|number| self.files.file_if_open(number));
        f.debug_list().entries(files).finish()
    }
}
