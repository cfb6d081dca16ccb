//! The verbs of Character Event Syntax (Lipz specification, "Character Event Syntax"), and those that lipz adds.

/// What a character does, with the `Name` of an emotion, target or action.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Command<Name> {
    /// `feels emotion`: lasts until changed.
    Feels(Name),
    /// `sees target`, a character or a prop: for a moment.
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
    /// `nods`, `nods 4`: once, so far as the number says, 0 to 10.
    Nods(Option<Name>),
    /// `shakes`, `shakes 4`: the head, so far as the number says, 0 to 10.
    Shakes(Option<Name>),
    /// `breathes`, `breathes 6`: once, as deep as the number says, 0 to 10.
    Breathes(Option<Name>),
    /// `blinks`: once.
    Blinks,
    /// `looks away`: for a moment.
    LooksAway,
}

impl<Name> Command<Name> {
    /// The verb as it is written: `feels`, `stops staring`.
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

    /// The emotion, target or action, or the number of a gesture, as it is written; `None` where there is none.
    pub fn object(self) -> Option<Name> {
        match self {
            Command::Feels(object)
            | Command::Sees(object)
            | Command::Stares(object)
            | Command::Points(object)
            | Command::Does(object) => Some(object),
            Command::Nods(number) | Command::Shakes(number) | Command::Breathes(number) => number,
            Command::StopsStaring | Command::StopsPointing | Command::Blinks | Command::LooksAway => None,
        }
    }
}
