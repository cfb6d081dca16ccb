//! A dialogue: any number of files that return answers like one bank.
//!
//! It has a *base*, which is a bank or the [set](crate::files::SetIndex) of the banks of all shards. *Patches* are
//! stacked on the base, and the topmost one with a clip returns it. Text banks contain the texts of locales.

mod clips;
mod error;
mod file;
mod layer;
mod locales;
mod open;
mod profiles;
mod queries;
mod stack;
mod voices;

pub use error::DialogueError;
pub use file::{DialogueFile, FileKind, Files};
pub use layer::Layer;
pub(crate) use queries::Queries;

use crate::event::NameKey;
use crate::origin::Origin;
use crate::set_index::SetIndex;
use crate::{Bank, Clip, ClipId, EventName};
use core::fmt;
use file::{BankFile, Contents, FilesRef};
use lipz_layout::U64;

/// Files that return answers like one bank: a bank or a set of banks, with patches and text banks.
///
/// A game opens a dialogue and queries it, independently of the number and kinds of its files. A patch, a download or a
/// mod is a bank that was packed with `--over`; `--config split-voices=true` makes such banks of dubs. The dialogue
/// returns the same answers as one bank that was packed from all sources at once.
///
/// The file structures and their contents are in the program's memory: nothing is allocated.
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
    /// The patches, from the base upwards.
    patches: [Option<&'a BankFile<'a>>; Dialogue::MAX_PATCHES],
    /// For each patch, the bits of the ids that it describes; empty for the rest.
    filters: [&'a [U64]; Dialogue::MAX_PATCHES],
    patch_count: usize,
    /// The origin of the dialogue's handles.
    origin: Origin,
    /// Whether a patch removes locales. If so, each locale of a bank has to be checked against all patches.
    removes_locales: bool,
}

impl Dialogue<'_> {
    /// The maximal number of patches in a dialogue.
    pub const MAX_PATCHES: usize = 15;
}

/// The source of a dialogue's answers.
#[derive(Clone, Copy)]
enum Answers<'a> {
    /// The only file, which is a bank.
    Alone(&'a Bank<'a>),
    /// All files. The queries are in a table, so that a program for a 32-bit processor that only opens single banks
    /// does not contain their code.
    Together(&'static Queries),
}

/// The lowest level of the stack.
#[derive(Clone, Copy)]
enum Base<'a> {
    /// The bank that is the first file.
    Bank(&'a BankFile<'a>),
    /// The banks after the index, which is the first file.
    Set(SetIndex<'a>),
}

/// The location of a clip.
#[derive(Clone, Copy)]
struct FoundClip<'a> {
    bank: &'a Bank<'a>,
    /// The lower half is the slot, and the upper half states whether the bank also has the texts. Together, the struct
    /// fits two registers.
    place: u64,
}

impl<'a> FoundClip<'a> {
    #[inline(always)]
    fn new(bank: &'a Bank<'a>, slot: u32, has_texts: bool) -> FoundClip<'a> {
        FoundClip { bank, place: u64::from(has_texts) << 32 | u64::from(slot) }
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
    /// Returns the queries of clips, if the dialogue is more than one bank.
    #[inline]
    pub(crate) fn queries(&self) -> Option<&'static Queries> {
        match self.answers {
            Answers::Alone(_) => None,
            Answers::Together(queries) => Some(queries),
        }
    }

    /// Returns the number of the first file after the base.
    fn behind_base(&self) -> usize {
        match &self.base {
            Base::Bank(_) => 1,
            Base::Set(index) => index.bank_count().saturating_add(1),
        }
    }

    /// Returns a number that differs between dialogues of different contents. Compare it to validate handles or other
    /// data that the program has stored for a version.
    pub const fn version(&self) -> u32 {
        self.origin.to_u32()
    }

    /// Returns the number of files, including the index of a set and each of its banks.
    pub fn file_count(&self) -> usize {
        self.files.count()
    }

    /// Returns the file with this number, or `None` if it is missing. Opens a bank of a set if necessary.
    pub fn file(&self, number: usize) -> Option<&'a DialogueFile<'a>> {
        self.files.file(number)
    }

    /// Returns the index, if the base is a set.
    pub fn set_index(&self) -> Option<SetIndex<'a>> {
        match &self.base {
            Base::Bank(_) => None,
            Base::Set(index) => Some(*index),
        }
    }

    /// Returns the bank that is the file with this number.
    pub fn bank(&self, number: usize) -> Option<&'a Bank<'a>> {
        Some(&self.bank_file(number)?.bank)
    }

    fn bank_file(&self, number: usize) -> Option<&'a BankFile<'a>> {
        match &self.files.file(number)?.contents {
            Contents::Bank(bank) => Some(bank),
            _ => None,
        }
    }

    /// Returns the clip with this id, from the topmost file that has it; `None` if no file has it, or if a patch
    /// removes it.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        self.found_clip(self.find(id)?)
    }

    /// Returns the clip with this key, which is compared in full.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        let found = self.find(ClipId::from_key(key))?;
        let record = found.bank.keys.get(found.slot() as usize)?;
        if found.bank.key_bytes(record)? == key.as_bytes() { self.found_clip(found) } else { None }
    }

    /// Returns the clip at this location.
    #[cfg_attr(target_pointer_width = "64", inline(always))]
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))] // short code where memory is scarce
    fn found_clip(&self, found: FoundClip<'a>) -> Option<Clip<'_>> {
        Clip::new(found.bank, found.slot(), Some(self), found.has_texts())
    }

    /// Where the clip with this id is.
    #[inline(always)] // a place in registers
    fn find(&self, id: ClipId) -> Option<FoundClip<'a>> {
        match self.answers {
            // On 64-bit processors, search the files directly: that saves a branch and an indirect call, and code is
            // cheap.
            _ if cfg!(target_pointer_width = "64") => self.find_in_files(id),
            Answers::Alone(bank) => Some(FoundClip::new(bank, bank.find(id)?.0, true)),
            Answers::Together(queries) => (queries.find)(self, id),
        }
    }

    /// Where the clip with this id is, of the topmost file that has it.
    #[inline(always)] // a place in registers
    fn find_in_files(&self, id: ClipId) -> Option<FoundClip<'a>> {
        if self.patch_count != 0 && self.may_be_patched(id) {
            return self.find_patched(id);
        }
        match &self.base {
            Base::Bank(base) => {
                let (slot, _) = base.bank.find(id)?;
                Some(FoundClip::new(&base.bank, slot, true))
            }
            Base::Set(index) => self.find_in_set(index, id),
        }
    }

    /// Whether a patch may describe the clip with this id. The filters accept few ids that their patches do not
    /// contain.
    #[inline(never)] // it is unrolled
    fn may_be_patched(&self, id: ClipId) -> bool {
        self.filters.iter().take_while(|filter| !filter.is_empty()).any(|filter| layer::may_have(filter, id))
    }

    /// Returns the clip with this [slot](Clip::slot) in the file with this [number](Clip::file), without a search. For
    /// programs that store numbers, not clips.
    #[inline]
    pub fn clip_at(&self, file: u32, slot: u32) -> Option<Clip<'_>> {
        match self.answers {
            Answers::Alone(bank) if file == 0 => self.found_clip(FoundClip::new(bank, slot, true)),
            Answers::Alone(_) => None,
            Answers::Together(queries) => self.found_clip((queries.find_at)(self, file, slot)?),
        }
    }

    /// Returns the name as spelled in events (`amy`); `None` if no event of any file contains it.
    pub fn event_name(&self, name: &str) -> Option<EventName<'_>> {
        match self.answers {
            Answers::Alone(bank) => bank.event_name(name),
            Answers::Together(queries) => (queries.event_name)(self, name),
        }
    }

    /// Returns the name of [`EventName::to_words`]; `None` if it is from another dialogue.
    pub fn event_name_of_words(&self, words: [u32; 2]) -> Option<EventName<'_>> {
        let key = NameKey::from_words(words);
        match self.answers {
            Answers::Alone(bank) if bank.origin == key.bank => EventName::numbered(bank, key.id),
            Answers::Alone(_) => None,
            Answers::Together(queries) => (queries.name)(self, key),
        }
    }

    /// Whether the base, or at least one bank of a set, is loaded.
    pub fn has_bank(&self) -> bool {
        match self.answers {
            Answers::Alone(_) => true,
            Answers::Together(queries) => (queries.has_bank)(self),
        }
    }

    /// Returns the number of the missing bank of a set that would contain the clip with this id. `None` if that bank is
    /// loaded, if a patch removes the clip, or if the base is not a set.
    pub fn missing_bank(&self, id: ClipId) -> Option<usize> {
        match self.answers {
            Answers::Alone(_) => None,
            Answers::Together(queries) => (queries.missing_bank)(self, id),
        }
    }
}

/// Prints the files, not their bytes.
impl fmt::Debug for Dialogue<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let files = (0..self.files.count()).map(|number| self.files.file_if_open(number));
        f.debug_list().entries(files).finish()
    }
}
