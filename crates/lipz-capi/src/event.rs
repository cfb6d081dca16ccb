//! Typed events.

use crate::handle::Name;
use lipz_bank::{Command, Strength};

/// Verb: `feels emotion`, which lasts until changed.
pub const LIPZ_FEELS: u32 = 1;
/// Verb: `sees target`, a character or a prop, which is momentary.
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
/// Verb: `nods`, with the strength `strength_thousandths`.
pub const LIPZ_NODS: u32 = 8;
/// Verb: `shakes`, the head, with a strength as `LIPZ_NODS`.
pub const LIPZ_SHAKES: u32 = 9;
/// Verb: `breathes`, with a strength as `LIPZ_NODS`.
pub const LIPZ_BREATHES: u32 = 10;
/// Verb: `blinks`.
pub const LIPZ_BLINKS: u32 = 11;
/// Verb: `looks away`.
pub const LIPZ_LOOKS_AWAY: u32 = 12;
/// The `strength_thousandths` of an event without a strength.
pub const LIPZ_NO_STRENGTH: u32 = 0xFFFF_FFFF;

/// One event of Character Event Syntax: `[character] verb object`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Event {
    /// The character; no name for the speaker of the clip.
    pub character: Name,
    /// The emotion, target or action; without a name if the event has no object.
    pub object: Name,
    /// `LIPZ_FEELS` and so on. More verbs may be added; skip unknown ones.
    pub verb: u32,
    /// The strength of a gesture, from 0 to 10,000, or `LIPZ_NO_STRENGTH`.
    pub strength_thousandths: u32,
}

impl Default for Event {
    fn default() -> Event {
        let (character, object) = (Name::default(), Name::default());
        Event { character, object, verb: 0, strength_thousandths: LIPZ_NO_STRENGTH }
    }
}

impl Event {
    pub(crate) fn from_reader(event: lipz_bank::Event<'_>) -> Event {
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
            _ => 0,
        };
        Event {
            character: Name::from_reader(event.character),
            object: Name::from_reader(event.command.object()),
            verb,
            strength_thousandths: event.command.amount().map_or(LIPZ_NO_STRENGTH, Strength::thousandths),
        }
    }
}
