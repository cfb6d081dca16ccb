//! The status of a call: stable numbers.

use crate::pointer::answer;
use crate::string::String;
use core::mem::MaybeUninit;
use lipz_bank::{Error, ErrorKind};

/// The result of a call: `LIPZ_OK`, one of the other numbers from 256 on, or the kind of damage in a file, from 1 to
/// 255. Numbers are never reused.
pub type Status = u32;

/// The answer was written.
pub const LIPZ_OK: Status = 0;
/// The item does not exist: no clip with this id, no text in this locale, no frame at this time. The answer is empty,
/// and a viseme is rest.
pub const LIPZ_NONE: Status = 256;
/// A required pointer is null.
pub const LIPZ_NULL_POINTER: Status = 257;
/// A key, tag or name in the arguments is not UTF-8.
pub const LIPZ_NOT_UTF8: Status = 258;
/// The dialogue was not opened.
pub const LIPZ_NOT_OPENED: Status = 259;
/// A struct has a different size in this library: the program was compiled with the header of another version, or did
/// not start the struct.
pub const LIPZ_OTHER_VERSION: Status = 260;
/// The item may be in a missing bank of the set. For a clip, `file` is the number of the bank to supply.
pub const LIPZ_ABSENT: Status = 261;

/// Returns the number of the kind of damage.
pub(crate) fn of_damage(error: Error) -> Status {
    Status::from(error.kind().number())
}

/// Writes an English sentence about the status, without a full stop; `LIPZ_NONE` for unknown numbers.
#[no_mangle]
pub extern "C" fn lipz_status_message(status: Status, message: Option<&mut MaybeUninit<String>>) -> Status {
    answer(message, || {
        let text = match status {
            LIPZ_OK => "the answer was written",
            LIPZ_NONE => "there is no such thing",
            LIPZ_NULL_POINTER => "a pointer is null",
            LIPZ_NOT_UTF8 => "the string is not UTF-8",
            LIPZ_NOT_OPENED => "the dialogue was not opened",
            LIPZ_OTHER_VERSION => "the struct is not of this version of the library",
            LIPZ_ABSENT => "a bank of the set that may have it is not there",
            damage => {
                let kind = ErrorKind::ALL.iter().find(|kind| Status::from(kind.number()) == damage);
                kind.ok_or(LIPZ_NONE)?.message()
            }
        };
        Ok(String::from_text(text))
    })
}
