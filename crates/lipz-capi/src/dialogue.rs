//! Opening a dialogue, and access to it for every query.

use crate::pointer::{answer, bytes};
use crate::status::{LIPZ_ABSENT, LIPZ_NONE, LIPZ_NOT_OPENED, LIPZ_NULL_POINTER, Status, of_damage};
use crate::string::String;
use core::mem::{MaybeUninit, align_of, size_of};
use lipz_bank::Dialogue as Reader;
use lipz_bank::files::{DialogueFile, FileKind, SetIndex};

/// The number of words in a `lipz_dialogue`.
pub const LIPZ_DIALOGUE_WORDS: usize = 80;
/// The number of words in a `lipz_file`.
pub const LIPZ_FILE_WORDS: usize = 80;
/// Kind of a file: a missing bank of a set.
pub const LIPZ_FILE_ABSENT: u32 = 0;
/// Kind of a file: a bank with clips.
pub const LIPZ_FILE_BANK: u32 = 1;
/// Kind of a file: a bank that was packed over others.
pub const LIPZ_FILE_PATCH: u32 = 2;
/// Kind of a file: the texts of locales.
pub const LIPZ_FILE_TEXTS: u32 = 3;
/// Kind of a file: the index of a set of banks.
pub const LIPZ_FILE_SET: u32 = 4;

/// Files that return answers like one bank: a bank or a set of banks, with patches and text banks. Only the library
/// reads and writes its words. It owns nothing, and need not be closed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Dialogue {
    /// Written by the library.
    pub words: [usize; LIPZ_DIALOGUE_WORDS],
}

/// An open file of a dialogue, which the library fills in.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FilePlace {
    /// Written by the library.
    pub words: [usize; LIPZ_FILE_WORDS],
}

/// The contents of a file, at any address: a mapped file, ROM, memory.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Bytes {
    /// The first byte.
    pub data: *const u8,
    /// Length of the file in bytes; 0 for a missing bank of a set.
    pub length_bytes: usize,
}

/// A summary of a dialogue.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct DialogueInfo {
    /// Number of clips. If there are patches, they are counted, which takes time in proportion.
    pub clip_count: u64,
    /// Number of files.
    pub file_count: u32,
    /// Number of locales.
    pub locale_count: u32,
    /// Number of voices; 0 without dubs.
    pub voice_count: u32,
    /// 0.
    pub reserved: u32,
}

/// A file of a dialogue.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct FileInfo {
    /// The checksum in its header, which differs between files of different contents.
    pub checksum: u64,
    /// A hash of its clips, which a bank and its text banks share; 0 for other files.
    pub fingerprint: u64,
    /// `LIPZ_FILE_BANK` and so on.
    pub kind: u32,
    /// Number of its clips.
    pub clip_count: u32,
}

/// The entry for a bank in the index of a set.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct SetBank {
    /// The name of its file, which is in the folder of the index.
    pub file_name: String,
    /// The checksum of the bank.
    pub checksum: u64,
    /// Its length in bytes.
    pub length_bytes: u32,
    /// Number of its clips.
    pub clip_count: u32,
}

/// The first word of an open dialogue.
#[allow(clippy::cast_possible_truncation)] // truncated on purpose
const OPENED: usize = 0x4C49_505A_4449_4131_u64 as usize;

const _: () = assert!(size_of::<Reader<'_>>() <= (LIPZ_DIALOGUE_WORDS - 1) * size_of::<usize>());
const _: () = assert!(size_of::<DialogueFile<'_>>() <= LIPZ_FILE_WORDS * size_of::<usize>());
const _: () = assert!(align_of::<Reader<'_>>() <= align_of::<usize>());
const _: () = assert!(align_of::<DialogueFile<'_>>() <= align_of::<usize>());

/// Writes a summary of the dialogue.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_info(
    dialogue: Option<&Dialogue>,
    info: Option<&mut MaybeUninit<DialogueInfo>>,
) -> Status {
    answer(info, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let reader = unsafe { reader(dialogue) }?;
        Ok(DialogueInfo {
            clip_count: reader.clip_count() as u64,
            file_count: number(reader.file_count()),
            locale_count: number(reader.locales().count()),
            voice_count: number(reader.voices().count()),
            reserved: 0,
        })
    })
}

/// Writes the file with this index. Call it from 0 on until `LIPZ_NONE`.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_file_by_index(
    dialogue: Option<&Dialogue>,
    index: u32,
    file: Option<&mut MaybeUninit<FileInfo>>,
) -> Status {
    answer(file, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let found = unsafe { reader(dialogue) }?.file(index as usize).ok_or(LIPZ_NONE)?;
        let bank = found.bank();
        Ok(FileInfo {
            checksum: found.checksum(),
            fingerprint: bank.map_or(0, lipz_bank::Bank::fingerprint),
            kind: match found.kind() {
                FileKind::Bank => LIPZ_FILE_BANK,
                FileKind::Patch => LIPZ_FILE_PATCH,
                FileKind::Texts => LIPZ_FILE_TEXTS,
                FileKind::Set => LIPZ_FILE_SET,
                _ => LIPZ_FILE_ABSENT,
            },
            clip_count: bank.map_or(0, |bank| number(bank.clip_count())),
        })
    })
}

/// Writes the entry with this index of a set's index, before the set is opened. Call it from 0 on until `LIPZ_NONE`.
/// The first call verifies the index, later ones only open it. In `lipz_dialogue_open`, the contents of all banks
/// follow the index, in this order.
#[no_mangle]
pub unsafe extern "C" fn lipz_set_bank_by_index(
    contents: Option<&Bytes>,
    index: u32,
    bank: Option<&mut MaybeUninit<SetBank>>,
) -> Status {
    answer(bank, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let bytes = unsafe { contents.ok_or(LIPZ_NULL_POINTER)?.bytes() }?;
        let set = SetIndex::open(bytes).and_then(|set| if index == 0 { set.verify() } else { Ok(set) });
        let set = set.map_err(of_damage)?;
        let found = set.bank_at(index as usize).ok_or(LIPZ_NONE)?;
        Ok(SetBank {
            file_name: String::from_text(found.file_name),
            checksum: found.checksum,
            length_bytes: found.length_bytes,
            clip_count: found.clip_count,
        })
    })
}

impl Dialogue {
    /// Stores the reader's dialogue in the words.
    pub(crate) fn keep(&mut self, reader: Reader<'_>) {
        let [first, words @ ..] = &mut self.words;
        *first = OPENED;
        // SAFETY: size and alignment of the words fit a dialogue, which has nothing to drop.
        unsafe { words.as_mut_ptr().cast::<Reader<'_>>().write(reader) };
    }
}

impl Bytes {
    /// # Safety
    /// The contract of the crate.
    pub(crate) unsafe fn bytes<'data>(&self) -> Result<&'data [u8], Status> {
        // SAFETY: the same contract.
        unsafe { bytes(self.data, self.length_bytes) }
    }
}

/// Returns the dialogue in the words of a struct.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn reader<'a>(dialogue: Option<&'a Dialogue>) -> Result<&'a Reader<'a>, Status> {
    let [first, words @ ..] = &dialogue.ok_or(LIPZ_NULL_POINTER)?.words;
    if *first != OPENED {
        return Err(LIPZ_NOT_OPENED);
    }
    // SAFETY: the library has written it, and by the contract the files and their contents are still there.
    Ok(unsafe { &*words.as_ptr().cast::<Reader<'a>>() })
}

/// Returns the status of a failed search, because a missing bank of a set may contain the item.
pub(crate) fn not_found(reader: &Reader<'_>) -> Status {
    let mut banks = (0..reader.file_count()).filter_map(|number| reader.file(number));
    if banks.any(|file| file.kind() == FileKind::Absent) { LIPZ_ABSENT } else { LIPZ_NONE }
}

/// Returns a locale or a profile, which each bank of a set contains: `LIPZ_ABSENT` if no bank is loaded.
pub(crate) fn of_project<T>(reader: &Reader<'_>, found: Option<T>) -> Result<T, Status> {
    if reader.has_bank() { found.ok_or(LIPZ_NONE) } else { Err(LIPZ_ABSENT) }
}

/// Returns a count of items in a file, which is below 2³² because of its length.
pub(crate) fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
