//! Opening a dialogue, and the way of every query into it.

use crate::pointer::{answer, bytes};
use crate::status::{LIPZ_ABSENT, LIPZ_NONE, LIPZ_NOT_OPENED, LIPZ_NULL_POINTER, LIPZ_OK, Status, of_damage};
use crate::string::String;
use core::mem::{MaybeUninit, align_of, size_of};
use core::slice;
use lipz_bank::Dialogue as Reader;
use lipz_bank::files::{DialogueError, DialogueFile, FileKind, SetIndex};

/// Words of a `lipz_dialogue`.
pub const LIPZ_DIALOGUE_WORDS: usize = 80;
/// Words of a `lipz_file`.
pub const LIPZ_FILE_WORDS: usize = 80;
/// For `lipz_dialogue_open`: verifies nothing. Queries are as safe as ever, but a damaged file may have wrong answers, and each
/// text is checked to be UTF-8 when it is asked for.
pub const LIPZ_UNVERIFIED: u32 = 1;

/// Kind of a file: a bank of a set that is not there yet.
pub const LIPZ_FILE_ABSENT: u32 = 0;
/// Kind of a file: a bank with clips.
pub const LIPZ_FILE_BANK: u32 = 1;
/// Kind of a file: a bank that was packed over others.
pub const LIPZ_FILE_PATCH: u32 = 2;
/// Kind of a file: the texts of locales.
pub const LIPZ_FILE_TEXTS: u32 = 3;
/// Kind of a file: the index of a set of banks.
pub const LIPZ_FILE_SET: u32 = 4;

/// Files that answer as one bank: a bank or a set of banks, the patches over it, and text banks. `lipz_dialogue_open` writes it,
/// and no program reads or writes its words. It owns nothing: forget it when you no longer need it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Dialogue {
    /// Written by the library.
    pub words: [usize; LIPZ_DIALOGUE_WORDS],
}

/// A place for an open file of a dialogue, which `lipz_dialogue_open` fills.
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
    /// Length of the file; 0 for a bank of a set that is not there yet.
    pub length_bytes: usize,
}

/// Which file is damaged or does not fit the others, and where.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Problem {
    /// Its number, from 0.
    pub file: u32,
    /// Bytes from its start.
    pub offset_bytes: u32,
}

/// What a dialogue has.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct DialogueInfo {
    /// Number of clips. Counted, if there are patches: that takes time in proportion.
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
    /// The checksum in its header: files of different contents have different ones.
    pub checksum: u64,
    /// Hash of what its clips are: a bank and its text banks share it; 0 for other files.
    pub fingerprint: u64,
    /// `LIPZ_FILE_BANK` and so on.
    pub kind: u32,
    /// Number of its clips.
    pub clip_count: u32,
}

/// What the index of a set says about a bank.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct SetBank {
    /// The name of its file, which is next to the index.
    pub file_name: String,
    /// The checksum of the bank.
    pub checksum: u64,
    /// Its length.
    pub length_bytes: u32,
    /// Number of its clips.
    pub clip_count: u32,
}

/// The first word of a dialogue that was opened.
#[allow(clippy::cast_possible_truncation)] // what fits
const OPENED: usize = 0x4C49_505A_4449_4131_u64 as usize;

const _: () = assert!(size_of::<Reader<'_>>() <= (LIPZ_DIALOGUE_WORDS - 1) * size_of::<usize>());
const _: () = assert!(size_of::<DialogueFile<'_>>() <= LIPZ_FILE_WORDS * size_of::<usize>());
const _: () = assert!(align_of::<Reader<'_>>() <= align_of::<usize>());
const _: () = assert!(align_of::<DialogueFile<'_>>() <= align_of::<usize>());

/// Opens the files whose contents are the `file_count` ones at `contents`, from the bottom to the top: the base first, a bank or
/// the index of a set with all of its banks behind it; then patches, each over those before it, and text banks, each behind
/// the bank of its clips. `files` has room for as many. Keep `files`, where they are, and the contents as long as you ask the
/// dialogue; copy `dialogue` as you like.
///
/// `flags` is 0 or `LIPZ_UNVERIFIED`. `problem` may be null. Unless the status is `LIPZ_OK`, the dialogue is not opened.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_open(
    dialogue: Option<&mut MaybeUninit<Dialogue>>,
    files: *mut FilePlace,
    contents: *const Bytes,
    file_count: usize,
    flags: u32,
    problem: Option<&mut MaybeUninit<Problem>>,
) -> Status {
    let problem = problem.map(|problem| problem.write(Problem::default()));
    let dialogue = match dialogue {
        Some(dialogue) => dialogue.write(Dialogue { words: [0; LIPZ_DIALOGUE_WORDS] }),
        None => return LIPZ_NULL_POINTER,
    };
    // SAFETY: the contract of the crate, which the caller keeps.
    let result = unsafe { open(files, contents, file_count, flags, problem) };
    match result {
        Ok(opened) => {
            dialogue.keep(opened);
            LIPZ_OK
        }
        Err(status) => status,
    }
}

/// Opens a dialogue of the one bank whose contents these are, without verifying it: for firmware, whose bank was verified when it
/// was packed. A program that opens dialogues only in this way has no code for patches, sets, text banks and checks. `file` is
/// room for the bank, which stays where it is, as in `lipz_dialogue_open`.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_open_bank(
    dialogue: Option<&mut MaybeUninit<Dialogue>>,
    file: Option<&mut MaybeUninit<FilePlace>>,
    contents: Option<&Bytes>,
) -> Status {
    let dialogue = match dialogue {
        Some(dialogue) => dialogue.write(Dialogue { words: [0; LIPZ_DIALOGUE_WORDS] }),
        None => return LIPZ_NULL_POINTER,
    };
    let (file, contents) = match (file, contents) {
        (Some(file), Some(contents)) => (file.as_mut_ptr().cast::<MaybeUninit<DialogueFile<'_>>>(), contents),
        _ => return LIPZ_NULL_POINTER,
    };
    // SAFETY: the place has the room and the alignment; the rest is the contract of the crate, which the caller keeps.
    let (file, bytes) = unsafe { (&mut *file, contents.bytes()) };
    match bytes.and_then(|bytes| Reader::open_bank(file, bytes).map_err(of_damage)) {
        Ok(opened) => {
            dialogue.keep(opened);
            LIPZ_OK
        }
        Err(status) => status,
    }
}

unsafe fn open<'a>(
    files: *mut FilePlace,
    contents: *const Bytes,
    file_count: usize,
    flags: u32,
    problem: Option<&mut Problem>,
) -> Result<Reader<'a>, Status> {
    const MOST: usize = isize::MAX as usize / size_of::<FilePlace>();
    if files.is_null() || contents.is_null() || file_count > MOST {
        return Err(LIPZ_NULL_POINTER);
    }
    for number in 0..file_count {
        // SAFETY: there is room for as many of the larger places.
        unsafe { files.cast::<DialogueFile<'a>>().add(number).write(DialogueFile::ABSENT) };
    }
    // SAFETY: they were just written, and there are as many contents; the rest is the contract.
    let (files, contents) = unsafe {
        (
            slice::from_raw_parts_mut(files.cast::<DialogueFile<'a>>(), file_count),
            slice::from_raw_parts(contents, file_count),
        )
    };
    if contents.iter().any(|contents| contents.length_bytes > 0 && contents.data.is_null()) {
        return Err(LIPZ_NULL_POINTER);
    }
    // SAFETY: the same contract.
    let contents = contents.iter().map(|contents| unsafe { contents.bytes() }.unwrap_or(&[]));
    let opened = match flags & LIPZ_UNVERIFIED {
        0 => Reader::open(files, contents),
        _ => Reader::open_unverified(files, contents),
    };
    opened.map_err(|error| reported(error, problem))
}

/// Puts a bank of a set into its place, with the number of its file, that was not there when the dialogue was opened. Handles
/// count as before. `files` are those of `lipz_dialogue_open`; no other function is called meanwhile.
///
/// `LIPZ_NONE` if the file is there already, or is not a bank of the set.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_supply(
    dialogue: Option<&mut Dialogue>,
    files: *mut FilePlace,
    number: u32,
    contents: Option<&Bytes>,
    flags: u32,
    problem: Option<&mut MaybeUninit<Problem>>,
) -> Status {
    let problem = problem.map(|problem| problem.write(Problem::default()));
    let (dialogue, contents) = match (dialogue, contents) {
        (Some(dialogue), Some(contents)) if !files.is_null() => (dialogue, contents),
        _ => return LIPZ_NULL_POINTER,
    };
    // SAFETY: the contract of the crate, which the caller keeps.
    match unsafe { supply(dialogue, files.cast(), number as usize, contents, flags, problem) } {
        Ok(()) => LIPZ_OK,
        Err(status) => status,
    }
}

unsafe fn supply<'a>(
    dialogue: &mut Dialogue,
    files: *mut DialogueFile<'a>,
    number: usize,
    contents: &Bytes,
    flags: u32,
    mut problem: Option<&mut Problem>,
) -> Result<(), Status> {
    // SAFETY: the contract of the crate.
    let (count, index) = unsafe {
        let reader: &Reader<'_> = reader(Some(dialogue))?;
        (reader.file_count(), reader.set_index().ok_or(LIPZ_NONE)?.bank_count())
    };
    if number == 0 || number > index || number >= count {
        return Err(LIPZ_NONE);
    }
    // SAFETY: they are those of the dialogue, which has as many.
    let (all, bytes) = unsafe { (slice::from_raw_parts(files, count), contents.bytes()?) };
    if all.get(number).map_or(true, |file| file.kind() != FileKind::Absent) {
        return Err(LIPZ_NONE);
    }
    let verified = DialogueFile::open(bytes, number).and_then(|file| match flags & LIPZ_UNVERIFIED {
        0 => file.verify_in(all, number, |bytes| core::str::from_utf8(bytes).ok()),
        _ => Ok(file),
    });
    let file = verified.map_err(|error| reported(DialogueError::new(number, error), problem.as_deref_mut()))?;
    // SAFETY: no reference to the files is in use.
    let all: &'a [DialogueFile<'a>] = unsafe {
        files.add(number).write(file);
        slice::from_raw_parts(files, count)
    };
    match Reader::new(all) {
        Ok(opened) => dialogue.keep(opened),
        Err(error) => {
            // SAFETY: as before.
            unsafe { files.add(number).write(DialogueFile::ABSENT) };
            return Err(reported(error, problem));
        }
    }
    Ok(())
}

/// What a dialogue has.
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

/// The file with this index: ask from 0 on until `LIPZ_NONE`.
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

/// The bank with this index that the index of a set names, before the set is opened: ask from 0 on until `LIPZ_NONE`. The
/// first call verifies the index, the others only open it. The contents of all banks go behind the index in `lipz_dialogue_open`, in this order.
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
    /// Keeps the reader's dialogue in the words.
    fn keep(&mut self, reader: Reader<'_>) {
        let [first, words @ ..] = &mut self.words;
        *first = OPENED;
        // SAFETY: the words have the room and the alignment, and a dialogue has nothing to drop.
        unsafe { words.as_mut_ptr().cast::<Reader<'_>>().write(reader) };
    }
}

impl Bytes {
    /// # Safety
    /// The contract of the crate.
    unsafe fn bytes<'data>(&self) -> Result<&'data [u8], Status> {
        // SAFETY: the same contract.
        unsafe { bytes(self.data, self.length_bytes) }
    }
}

/// The dialogue in the words of a struct.
///
/// # Safety
/// The contract of the crate.
pub(crate) unsafe fn reader<'a>(dialogue: Option<&'a Dialogue>) -> Result<&'a Reader<'a>, Status> {
    let [first, words @ ..] = &dialogue.ok_or(LIPZ_NULL_POINTER)?.words;
    if *first != OPENED {
        return Err(LIPZ_NOT_OPENED);
    }
    // SAFETY: `lipz_dialogue_open` has written it, and the files and their contents are still there: the contract.
    Ok(unsafe { &*words.as_ptr().cast::<Reader<'a>>() })
}

/// The status of what is not found: a bank of a set that is not there may have it.
pub(crate) fn not_found(reader: &Reader<'_>) -> Status {
    let mut banks = (0..reader.file_count()).filter_map(|number| reader.file(number));
    if banks.any(|file| file.kind() == FileKind::Absent) { LIPZ_ABSENT } else { LIPZ_NONE }
}

/// A locale or a profile, which each bank of a set has: `LIPZ_ABSENT` if none of them is there.
pub(crate) fn of_project<T>(reader: &Reader<'_>, found: Option<T>) -> Result<T, Status> {
    if reader.has_bank() { found.ok_or(LIPZ_NONE) } else { Err(LIPZ_ABSENT) }
}

/// A number of things that stand in a file, whose length has 32 bits.
pub(crate) fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// The status of an error; writes down where it is.
fn reported(error: DialogueError, problem: Option<&mut Problem>) -> Status {
    if let Some(problem) = problem {
        *problem = Problem { file: number(error.file()), offset_bytes: error.error().offset_bytes() };
    }
    of_damage(error.error())
}
