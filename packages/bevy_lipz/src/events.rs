//! The events that players trigger. All of them are entity events: observe one player, or all.

use crate::LipzError;
use bevy::ecs::entity::Entity;
use bevy::ecs::event::EntityEvent;
use std::fmt;

/// An event of a line, in Character Event Syntax: `mara feels sad`. Triggered exactly once, in order, however long the
/// rendered frame took.
#[derive(EntityEvent, Clone, PartialEq, Debug)]
pub struct LipzEvent {
    /// The player.
    pub entity: Entity,
    /// The index of the segment in its clip, from 0.
    pub segment: u32,
    /// The character that acts: the speaker, unless the event names a different one. `None` if the player does not have
    /// a speaker.
    pub character: Option<String>,
    /// The verb as written: `feels`, `stops staring`.
    pub verb: &'static str,
    /// The emotion, target or action, if the verb has one.
    pub object: Option<String>,
    /// The number of a gesture, from 0 to 10, if it has one.
    pub amount: Option<f32>,
}

impl LipzEvent {
    pub(crate) fn new(entity: Entity, segment: u32, event: &lipz_bank::Event<'_>, speaker: &str) -> LipzEvent {
        let speaker = Some(speaker).filter(|speaker| !speaker.is_empty());
        LipzEvent {
            entity,
            segment,
            character: event.character.map(lipz_bank::EventName::as_str).or(speaker).map(str::to_owned),
            verb: event.command.verb(),
            object: event.command.object().map(|object| object.as_str().to_owned()),
            amount: event.command.amount().map(lipz_bank::Strength::to_f32),
        }
    }
}

/// Prints the event as written: `mara feels sad`.
impl fmt::Display for LipzEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(character) = &self.character {
            write!(f, "{character} ")?;
        }
        f.write_str(self.verb)?;
        if let Some(object) = &self.object {
            write!(f, " {object}")?;
        }
        self.amount.map_or(Ok(()), |amount| write!(f, " {amount}"))
    }
}

/// A segment with an event string has begun. Triggered before the [`LipzEvent`]s of the segment; use it for event
/// strings in a syntax of your own, which have no [`LipzEvent`]s.
#[derive(EntityEvent, Clone, PartialEq, Eq, Debug)]
pub struct LipzSegment {
    /// The player.
    pub entity: Entity,
    /// The index of the segment in its clip, from 0.
    pub segment: u32,
    /// The event string of the Lipz file, trimmed.
    pub event: String,
}

/// The subtitle has changed.
#[derive(EntityEvent, Clone, PartialEq, Eq, Debug)]
pub struct LipzSubtitle {
    /// The player.
    pub entity: Entity,
    /// The text; empty if no subtitle is to be shown any more.
    pub text: String,
    /// Whether the text is in a different language, because the player's language has no text for this clip.
    pub is_fallback: bool,
}

/// The line has ended, or was skipped. Not triggered if it was stopped.
#[derive(EntityEvent, Clone, Copy, PartialEq, Eq, Debug)]
pub struct LipzFinished {
    /// The player.
    pub entity: Entity,
}

/// A player cannot play its line, or a face cannot be moved. Triggered once for each problem.
#[derive(EntityEvent, Clone, PartialEq, Eq, Debug)]
pub struct LipzFailed {
    /// The player, or the entity with the morph targets.
    pub entity: Entity,
    /// The problem.
    pub error: LipzError,
}
