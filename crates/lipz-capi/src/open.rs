//! Opening a dialogue.

use crate::dialogue::{Bytes, Dialogue, FilePlace, LIPZ_DIALOGUE_WORDS, number, reader};
use crate::status::{LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, Status, of_damage};
use core::mem::{MaybeUninit, size_of};
use core::slice;
use lipz_bank::Dialogue as Reader;
use lipz_bank::files::{DialogueError, DialogueFile, FileKind};

/// For `lipz_dialogue_open`: verifies nothing. Queries are just as safe, but may return wrong answers for a damaged
/// file, and each text is checked to be UTF-8 on each query.
pub const LIPZ_UNVERIFIED: u32 = 1;

/// The damaged or mismatched file, and the position of the problem.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Problem {
    /// The number of the file, from 0.
    pub file: u32,
    /// Bytes from the start of the file.
    pub offset_bytes: u32,
}

/// Opens the `file_count` files whose contents are at `contents`, from the bottom to the top. The base comes first: a
/// bank, or the index of a set followed by all of its banks. Then come patches, each after those below it, and text
/// banks, each after the bank of its clips. `files` has room for as many files. Keep `files` at its address, and keep
/// the contents, while you use the dialogue. You may copy `dialogue`.
///
/// `flags` is 0 or `LIPZ_UNVERIFIED`. `problem` may be null. Unless the status is `LIPZ_OK`, the dialogue is not
/// opened.
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
    kept(dialogue, unsafe { open(files, contents, file_count, flags, problem) })
}

/// Opens a dialogue of one bank without verifying it: for firmware whose bank was verified when it was packed. The
/// library stores the opened bank in `file`. As for `lipz_dialogue_open`, keep `file` and the contents at their
/// addresses. Rejects patches, text banks and sets. Unless the status is `LIPZ_OK`, the dialogue is not opened.
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
    // SAFETY: size and alignment of the place fit; the rest is the contract of the crate, which the caller keeps.
    let (file, bytes) = unsafe { (&mut *file, contents.bytes()) };
    kept(dialogue, bytes.and_then(|bytes| Reader::open_bank(file, bytes).map_err(of_damage)))
}

/// Stores an opened dialogue, and returns the status of opening it.
fn kept(dialogue: &mut Dialogue, opened: Result<Reader<'_>, Status>) -> Status {
    match opened {
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
    // SAFETY: they were just written, and the contents have the same number; the rest is the contract.
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

/// Adds a bank of a set that was missing when the dialogue was opened, by the number of its file. Handles stay valid.
/// `files` is the argument of `lipz_dialogue_open`. Do not call other functions at the same time.
///
/// `LIPZ_NONE` if the file is already loaded, or is not a bank of the set.
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
    // SAFETY: these are the files of the dialogue, with the same number.
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

/// Returns the status of an error, and stores its position.
fn reported(error: DialogueError, problem: Option<&mut Problem>) -> Status {
    if let Some(problem) = problem {
        *problem = Problem { file: number(error.file()), offset_bytes: error.error().offset_bytes() };
    }
    of_damage(error.error())
}
