//! Events of a segment: as written, and typed.

use crate::bank::{Bank, opened, origin};
use crate::pointer::{answer, text};
use crate::segment::{Segment, of_segment};
use crate::status::{LIPZ_NONE, Status};
use crate::string::String;
use crate::string::c_char;
use core::mem::MaybeUninit;
use lipz_bank::{Command, EventName as Name};

/// Verb: `feels emotion`, lasts until changed.
pub const LIPZ_FEELS: u32 = 1;
/// Verb: `sees target`, a character or a prop, for a moment.
pub const LIPZ_SEES: u32 = 2;
/// Verb: `stares target`, until `stops staring`.
pub const LIPZ_STARES: u32 = 3;
/// Verb: `stops staring`.
pub const LIPZ_STOPS_STARING: u32 = 4;
/// Verb: `points target`, until `stops pointing`.
pub const LIPZ_POINTS: u32 = 5;
/// Verb: `stops pointing`.
pub const LIPZ_STOPS_POINTING: u32 = 6;
/// Verb: `does action`, an action of the game.
pub const LIPZ_DOES: u32 = 7;
/// Verb: `nods`, as far as the number says that is the object, 0 to 10; no name if there is none.
pub const LIPZ_NODS: u32 = 8;
/// Verb: `shakes`, the head, with a number as `LIPZ_NODS`.
pub const LIPZ_SHAKES: u32 = 9;
/// Verb: `breathes`, with a number as `LIPZ_NODS`.
pub const LIPZ_BREATHES: u32 = 10;
/// Verb: `blinks`.
pub const LIPZ_BLINKS: u32 = 11;
/// Verb: `looks away`.
pub const LIPZ_LOOKS_AWAY: u32 = 12;

/// The `id` where there is no name.
pub const LIPZ_NO_NAME: u32 = 0xFFFF_FFFF;

/// A name that events mention: a character, an emotion, a target or an action.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct EventName {
    /// The name as it is spelled in the Lipz file.
    pub name: String,
    /// Its number in this bank: equal names have equal numbers. `LIPZ_NO_NAME` if there is none. In another bank,
    /// and in another version of this one, the number is another name's.
    pub id: u32,
    /// Tells the bank that the name is of apart from others; 0 if there is no name.
    pub bank: u32,
}

impl EventName {
    pub(crate) fn from_reader(bank: &lipz_bank::Bank<'_>, name: Option<Name<'_>>) -> EventName {
        let named =
            |name: Name<'_>| EventName { name: String::from_text(name.as_str()), id: name.id(), bank: origin(bank) };
        name.map_or_else(EventName::default, named)
    }
}

/// The name of `bank` with this number, unless both are of another bank.
pub(crate) fn name_of<'data>(bank: &lipz_bank::Bank<'data>, id: u32, of: u32) -> Option<Name<'data>> {
    if of == origin(bank) { bank.event_name_at(id) } else { None }
}

impl Default for EventName {
    fn default() -> EventName {
        EventName { name: String::default(), id: LIPZ_NO_NAME, bank: 0 }
    }
}

/// One event of Character Event Syntax: `[character] verb object`.
#[repr(C)]
#[derive(Clone, Copy, Default, Debug)]
pub struct Event {
    /// Who; no name for the speaker of the clip.
    pub character: EventName,
    /// The emotion, target or action, or the number of a gesture, as it is written; no name where there is none.
    pub object: EventName,
    /// `LIPZ_FEELS` and so on.
    pub verb: u32,
}

impl Event {
    pub(crate) fn from_reader(bank: &lipz_bank::Bank<'_>, event: lipz_bank::Event<'_>) -> Event {
        let verb = match event.command {
            Command::Feels(_) => LIPZ_FEELS,
            Command::Sees(_) => LIPZ_SEES,
            Command::Stares(_) => LIPZ_STARES,
            Command::StopsStaring => LIPZ_STOPS_STARING,
            Command::Points(_) => LIPZ_POINTS,
            Command::StopsPointing => LIPZ_STOPS_POINTING,
            Command::Does(_) => LIPZ_DOES,
            Command::Nods(_) => LIPZ_NODS,
            Command::Shakes(_) => LIPZ_SHAKES,
            Command::Breathes(_) => LIPZ_BREATHES,
            Command::Blinks => LIPZ_BLINKS,
            Command::LooksAway => LIPZ_LOOKS_AWAY,
        };
        let name = |name| EventName::from_reader(bank, name);
        Event { character: name(event.character), object: name(event.command.object()), verb }
    }
}

/// The event string of a segment, trimmed and otherwise as in the Lipz file. Empty if nothing happens;
/// `LIPZ_NONE` if the file has no events.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_event_string(
    bank: Option<&Bank>,
    segment: Option<&Segment>,
    string: Option<&mut MaybeUninit<String>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe { of_segment(bank, segment, string, |_, segment| Ok(String::from_text(segment.event().ok_or(LIPZ_NONE)?))) }
}

/// The typed event of a segment with this index: ask from 0 on until `LIPZ_NONE`. There are none where the
/// event string is some other syntax, such as a script.
#[no_mangle]
pub unsafe extern "C" fn lipz_segment_event(
    bank: Option<&Bank>,
    segment: Option<&Segment>,
    index: u32,
    event: Option<&mut MaybeUninit<Event>>,
) -> Status {
    // SAFETY: the contract of the crate, which the caller keeps.
    unsafe {
        of_segment(bank, segment, event, |bank, segment| {
            Ok(Event::from_reader(bank, segment.events().nth(index as usize).ok_or(LIPZ_NONE)?))
        })
    }
}

/// The name that events mention, spelled as there. Look names up once and compare numbers per event.
#[no_mangle]
pub unsafe extern "C" fn lipz_event_name(
    bank: Option<&Bank>,
    name: *const c_char,
    name_length_bytes: usize,
    found: Option<&mut MaybeUninit<EventName>>,
) -> Status {
    answer(found, || {
        // SAFETY: the contract of the crate, which the caller keeps.
        let (bank, name) = unsafe { (opened(bank)?, text(name, name_length_bytes)?) };
        Ok(EventName::from_reader(&bank, Some(bank.event_name(name).ok_or(LIPZ_NONE)?)))
    })
}
