//! What outlasts an event: what characters feel, stare and point at.

use crate::bank::Bank;
use crate::cursor::{Cursor, of_cursor};
use crate::event::{EventName, LIPZ_NO_NAME, name_of};
use crate::status::{LIPZ_NONE, Status};
use core::mem::MaybeUninit;
use lipz_bank::{CharacterState, EventName as Name};

/// What a character feels, stares and points at. No name where no event has said anything: it is as it was before the
/// clip.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Character {
    /// Who; no name for a speaker that the cursor does not know.
    pub name: EventName,
    /// The emotion, until changed.
    pub feels: EventName,
    /// The target, until `stops staring`.
    pub stares_at: EventName,
    /// The target, until `stops pointing`.
    pub points_at: EventName,
}

impl Character {
    fn from_reader(bank: &lipz_bank::Bank<'_>, name: Option<Name<'_>>, state: CharacterState<'_>) -> Character {
        let name_of = |name| EventName::from_reader(bank, name);
        Character {
            name: name_of(name),
            feels: name_of(state.emotion),
            stares_at: name_of(state.stares_at),
            points_at: name_of(state.points_at),
        }
    }
}

/// What `name` feels, stares and points at after the events that were due or were jumped over; the speaker if it is null
/// or no name. `LIPZ_NONE` for a name of another bank.
///
/// Read from the events anew with each call, in a time that grows with their number.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_character(
    bank: Option<&Bank>,
    cursor: Option<&Cursor>,
    name: Option<&EventName>,
    character: Option<&mut MaybeUninit<Character>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(bank, cursor, character, |bank, clip, inner| {
            let name = match name.filter(|name| name.id != LIPZ_NO_NAME) {
                Some(name) => Some(name_of(bank, name.id, name.bank).ok_or(LIPZ_NONE)?),
                None => None,
            };
            let speaker = cursor.and_then(|cursor| name_of(bank, cursor.speaker_id, cursor.speaker_bank));
            Ok(Character::from_reader(bank, name.or(speaker), inner.state(clip, name)))
        })
    }
}

/// A character that an event of the clip is about, also one to come, with its state: ask from 0 on until `LIPZ_NONE`
/// after a jump, to set the scene. They are in the order of their names.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_character_at(
    bank: Option<&Bank>,
    cursor: Option<&Cursor>,
    index: u32,
    character: Option<&mut MaybeUninit<Character>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(bank, cursor, character, |bank, clip, inner| {
            let (name, state) = inner.characters(clip).nth(index as usize).ok_or(LIPZ_NONE)?;
            Ok(Character::from_reader(bank, name, state))
        })
    }
}
