//! What outlasts an event: what characters feel, stare and point at.

use crate::cursor::{Cursor, of_cursor};
use crate::dialogue::Dialogue;
use crate::handle::{LIPZ_NO_NAME, Name};
use crate::status::{LIPZ_NONE, Status};
use core::mem::MaybeUninit;
use lipz_bank::EventName;
use lipz_bank::playback::CharacterState;

/// What a character feels, stares and points at. No name where no event has said anything: it is as it was before the
/// clip.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Character {
    /// Who; no name for a speaker that the cursor does not have.
    pub name: Name,
    /// The emotion, until changed.
    pub feels: Name,
    /// The target, until `stops staring`.
    pub stares_at: Name,
    /// The target, until `stops pointing`.
    pub points_at: Name,
}

impl Character {
    fn from_reader(name: Option<EventName<'_>>, state: CharacterState<'_>) -> Character {
        Character {
            name: Name::from_reader(name),
            feels: Name::from_reader(state.emotion),
            stares_at: Name::from_reader(state.stares_at),
            points_at: Name::from_reader(state.points_at),
        }
    }
}

/// What `name` feels, stares and points at after the events that were due or were jumped over; the speaker if it is null
/// or no name. `LIPZ_NONE` for a name of another version.
///
/// Each call reads the events again, in a time that grows with their number.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_character(
    dialogue: Option<&Dialogue>,
    cursor: Option<&Cursor>,
    name: Option<&Name>,
    character: Option<&mut MaybeUninit<Character>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(dialogue, cursor, character, |dialogue, clip, inner| {
            let name = match name.filter(|name| name.bank != LIPZ_NO_NAME) {
                Some(name) => Some(dialogue.event_name_of_words([name.bank, name.id]).ok_or(LIPZ_NONE)?),
                None => None,
            };
            let speaker = cursor.and_then(|cursor| cursor.speaker(dialogue));
            Ok(Character::from_reader(name.or(speaker), inner.state(clip, name)))
        })
    }
}

/// A character that an event of the clip is about, also one to come, with its state: ask from 0 on until `LIPZ_NONE`
/// after a jump, to set the scene. They are in the order of their names.
#[no_mangle]
pub unsafe extern "C" fn lipz_cursor_character_by_index(
    dialogue: Option<&Dialogue>,
    cursor: Option<&Cursor>,
    index: u32,
    character: Option<&mut MaybeUninit<Character>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_cursor(dialogue, cursor, character, |_, clip, inner| {
            let (name, state) = inner.characters(clip).nth(index as usize).ok_or(LIPZ_NONE)?;
            Ok(Character::from_reader(name, state))
        })
    }
}
