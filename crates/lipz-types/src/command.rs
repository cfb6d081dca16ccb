//! The verbs of Character Event Syntax (Lipz specification, "Character Event Syntax").

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
        }
    }

    /// The emotion, target or action; `None` for the verbs that stop something.
    pub fn object(self) -> Option<Name> {
        match self {
            Command::Feels(object)
            | Command::Sees(object)
            | Command::Stares(object)
            | Command::Points(object)
            | Command::Does(object) => Some(object),
            Command::StopsStaring | Command::StopsPointing => None,
        }
    }
}
