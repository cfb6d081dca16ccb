//! The lasting effects of events: emotions, stares and pointing.

use crate::cursor::{Cursor, of_cursor};
use crate::dialogue::Dialogue;
use crate::handle::{LIPZ_NO_NAME, Name};
use crate::status::{LIPZ_NONE, Status};
use core::mem::MaybeUninit;
use lipz_bank::EventName;
use lipz_bank::playback::CharacterState;

/// The emotion of a character, and the targets of staring and pointing. A missing name means that no event has set the
/// field; keep the state from before the clip.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Character {
    /// The name of the character; missing for a speaker without a name in the cursor.
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

/// Writes the emotion of `name`, and the targets of staring and pointing, after the events that were due or were jumped
/// over. The speaker if `name` is null or missing. `LIPZ_NONE` for a name of another version.
///
/// Each call evaluates the events again, in a time that grows with their number.
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

/// Writes the character with this index among those in the events of the clip, including future events, with its state.
/// To set the scene after a jump, call it from 0 on until `LIPZ_NONE`. Characters are ordered by name.
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
