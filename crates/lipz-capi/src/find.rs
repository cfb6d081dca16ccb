//! Finding clips: by key or id, and one after the other.

use crate::clip::Clip;
use crate::dialogue::{Dialogue, number, reader};
use crate::pointer::{answer, text};
use crate::status::{LIPZ_ABSENT, LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_OK, Status};
use crate::string::c_char;
use core::mem::MaybeUninit;
use lipz_bank::ClipId;

/// Writes the id of the clip with this key. It never changes: `lipz ids --lang c` writes the ids of all clips as
/// constants.
#[no_mangle]
pub unsafe extern "C" fn lipz_clip_id_of_key(
    key: *const c_char,
    key_length_bytes: usize,
    id: Option<&mut MaybeUninit<u64>>,
) -> Status {
    answer(id, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        Ok(ClipId::from_key(unsafe { text(key, key_length_bytes) }?).get())
    })
}

/// Writes the clip with this id, from the topmost file that has it. `LIPZ_ABSENT` if the clip would be in a missing
/// bank of a set: `file` of the clip is then the number of the file to supply.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_clip(
    dialogue: Option<&Dialogue>,
    id: u64,
    clip: Option<&mut MaybeUninit<Clip>>,
) -> Status {
    let id = ClipId::from_u64(id);
    // SAFETY: the contract of the crate, which the caller keeps.
    found(unsafe { reader(dialogue) }, Ok(id), |dialogue| dialogue.clip(id), clip)
}

/// Writes the clip with this key, which is compared in full; otherwise like `lipz_dialogue_clip`.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_clip_by_key(
    dialogue: Option<&Dialogue>,
    key: *const c_char,
    key_length_bytes: usize,
    clip: Option<&mut MaybeUninit<Clip>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    let (dialogue, key) = unsafe { (reader(dialogue), text(key, key_length_bytes)) };
    found(dialogue, key.map(ClipId::from_key), |dialogue| dialogue.clip_by_key(key.ok()?), clip)
}

/// Writes the clip that was found, or the number of the missing file.
fn found<'a>(
    dialogue: Result<&'a lipz_bank::Dialogue<'a>, Status>,
    id: Result<ClipId, Status>,
    find: impl FnOnce(&'a lipz_bank::Dialogue<'a>) -> Option<lipz_bank::Clip<'a>>,
    out: Option<&mut MaybeUninit<Clip>>,
) -> Status {
    let out = match out {
        Some(out) => out.write(Clip::default()),
        None => return LIPZ_NULL_POINTER,
    };
    let (dialogue, id) = match (dialogue, id) {
        (Ok(dialogue), Ok(id)) => (dialogue, id),
        (Err(status), _) | (_, Err(status)) => return status,
    };
    if let Some(clip) = find(dialogue) {
        *out = Clip::from_reader(dialogue.version(), &clip);
        return LIPZ_OK;
    }
    match dialogue.missing_bank(id) {
        Some(file) => {
            out.file = number(file);
            LIPZ_ABSENT
        }
        None => LIPZ_NONE,
    }
}

/// Writes the next clip whose key starts with `prefix`, file by file, ordered by key in each. An empty prefix matches
/// all clips. `position` stores the progress, and is 0 at the start. `LIPZ_NONE` after the last clip.
#[no_mangle]
pub unsafe extern "C" fn lipz_dialogue_next_clip(
    dialogue: Option<&Dialogue>,
    prefix: *const c_char,
    prefix_length_bytes: usize,
    position: Option<&mut u64>,
    clip: Option<&mut MaybeUninit<Clip>>,
) -> Status {
    answer(clip, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let dialogue = unsafe { reader(dialogue) }?;
        // SAFETY: the same contract.
        let prefix = if prefix_length_bytes == 0 { "" } else { unsafe { text(prefix, prefix_length_bytes) }? };
        let position = position.ok_or(LIPZ_NULL_POINTER)?;
        let (clip, behind) = dialogue.clip_behind(*position, prefix).ok_or(LIPZ_NONE)?;
        *position = behind;
        Ok(Clip::from_reader(dialogue.version(), &clip))
    })
}
