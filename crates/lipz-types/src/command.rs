//! The verbs of Character Event Syntax (Lipz specification, "Character Event Syntax"), and lipz's additions.

use crate::Strength;

/// The action of a character: a verb with the `Name` of an emotion, target or action, or with the `Amount` of a
/// gesture.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum Command<Name, Amount = Strength> {
    /// `feels emotion`: lasts until changed.
    Feels(Name),
    /// `sees target`, a character or a prop: momentary.
    Sees(Name),
    /// `stares target`: until `stops staring`.
    Stares(Name),
    /// `stops staring`.
    StopsStaring,
    /// `points target`: until `stops pointing`.
    Points(Name),
    /// `stops pointing`.
    StopsPointing,
    /// `does action`: an action of the game.
    Does(Name),
    /// `nods`, `nods 4`: once, with a strength from 0 to 10.
    Nods(Option<Amount>),
    /// `shakes`, `shakes 4`: the head, with a strength from 0 to 10.
    Shakes(Option<Amount>),
    /// `breathes`, `breathes 6`: once, with a depth from 0 to 10.
    Breathes(Option<Amount>),
    /// `blinks`: once.
    Blinks,
    /// `looks away`: momentary.
    LooksAway,
}

impl<Name, Amount> Command<Name, Amount> {
    /// Returns the verb as written: `feels`, `stops staring`.
    pub const fn verb(&self) -> &'static str {
        match self {
            Command::Feels(_) => "feels",
            Command::Sees(_) => "sees",
            Command::Stares(_) => "stares",
            Command::StopsStaring => "stops staring",
            Command::Points(_) => "points",
            Command::StopsPointing => "stops pointing",
            Command::Does(_) => "does",
            Command::Nods(_) => "nods",
            Command::Shakes(_) => "shakes",
            Command::Breathes(_) => "breathes",
            Command::Blinks => "blinks",
            Command::LooksAway => "looks away",
        }
    }

    /// Returns the emotion, target or action; `None` for verbs without one.
    pub fn object(self) -> Option<Name> {
        match self {
            Command::Feels(object)
            | Command::Sees(object)
            | Command::Stares(object)
            | Command::Points(object)
            | Command::Does(object) => Some(object),
            _ => None,
        }
    }

    /// Returns the number of a gesture; `None` for other verbs, and for a gesture without a number.
    pub fn amount(self) -> Option<Amount> {
        match self {
            Command::Nods(amount) | Command::Shakes(amount) | Command::Breathes(amount) => amount,
            _ => None,
        }
    }
}
