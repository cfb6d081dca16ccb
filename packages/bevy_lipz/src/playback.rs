//! The system that moves all players, and its triggers.

use crate::clock::ClockReading;
use crate::events::{LipzEvent, LipzFailed, LipzFinished, LipzSegment, LipzSubtitle};
use crate::line::Line;
use crate::player::Request;
use crate::{LipzBank, LipzError, LipzMouth, LipzPlayer};
use bevy::asset::{AssetId, AssetLoadFailedEvent, AssetServer, Assets, LoadState};
use bevy::ecs::change_detection::{DetectChangesMut, Res};
use bevy::ecs::entity::Entity;
use bevy::ecs::lifecycle::Remove;
use bevy::ecs::message::MessageReader;
use bevy::ecs::observer::On;
use bevy::ecs::system::{Commands, Query};
use bevy::time::Time;
use lipz_bank::Bank;
use lipz_bank::playback::DueSegments;
use std::time::Duration;

/// Moves all players to the time of this rendered frame.
pub(crate) fn play(
    mut commands: Commands,
    (time, banks, server): (Res<Time>, Res<Assets<LipzBank>>, Res<AssetServer>),
    mut failures: MessageReader<AssetLoadFailedEvent<LipzBank>>,
    mut players: Query<(Entity, &mut LipzPlayer, &mut LipzMouth)>,
) {
    let failed: Vec<_> = failures.read().collect();
    for (entity, mut player, mut mouth) in &mut players {
        let player = player.bypass_change_detection();
        let triggers = &mut Triggers { commands: &mut commands, entity };
        let bank = banks.get(&player.bank);
        if let Some(error) = new_error(player, bank.is_some(), &failed, &server) {
            triggers.fail(error);
        }
        let shown = match bank {
            Some(bank) => player.advance(bank.bank(), time.delta(), triggers),
            None => {
                player.end(triggers);
                LipzMouth::REST
            }
        };
        mouth.set_if_neq(shown);
    }
}

/// Ends the line of a player that is removed.
pub(crate) fn end_removed(
    removed: On<Remove, LipzPlayer>,
    mut commands: Commands,
    mut players: Query<(&mut LipzPlayer, &mut LipzMouth)>,
) {
    if let Ok((mut player, mut mouth)) = players.get_mut(removed.entity) {
        player.end(&mut Triggers { commands: &mut commands, entity: removed.entity });
        mouth.set_if_neq(LipzMouth::REST);
    }
}

/// Returns the error of the player's bank, if it has not been reported.
fn new_error(
    player: &mut LipzPlayer,
    is_loaded: bool,
    failed: &[&AssetLoadFailedEvent<LipzBank>],
    server: &AssetServer,
) -> Option<LipzError> {
    let id = player.bank.id();
    if let Some(failure) = failed.iter().find(|failure| failure.id == id) {
        player.state.reported = Some(id);
        return Some(LipzError::of_load(&failure.error));
    }
    // The bank may have failed before the player was spawned.
    if is_loaded || player.state.reported == Some(id) {
        return None;
    }
    match server.load_state(id) {
        LoadState::Failed(error) => {
            player.state.reported = Some::<AssetId<LipzBank>>(id);
            Some(LipzError::of_load(&error))
        }
        _ => None,
    }
}

impl LipzPlayer {
    /// Moves the line to the next rendered frame, this much later. Returns the mouth to draw.
    fn advance(&mut self, bank: &Bank<'_>, mut later: Duration, triggers: &mut Triggers) -> LipzMouth {
        if let Some(speaker) = self.state.skipped.take()
            && let Some(line) = self.state.line.as_mut().filter(|line| line.is_from(self.bank.id()))
        {
            line.skip(bank, &speaker, triggers);
        }
        let request = self.state.request.take();
        if matches!(request, Some(Request::Start { .. } | Request::Skip))
            || self.state.line.as_ref().is_none_or(|line| line.is_outdated(self, bank))
        {
            self.end(triggers);
            self.state.line = Some(Line::start(self, bank, triggers));
            #[cfg(feature = "audio")]
            self.forget_recording();
            later = Duration::ZERO;
        }
        if matches!(request, Some(Request::Seek { .. })) {
            later = Duration::ZERO;
        }
        let reading = if self.is_paused { ClockReading::Waiting } else { self.clock_reading(later) };
        let Some(line) = &mut self.state.line else { return LipzMouth::REST };
        line.speak(&self.locale, bank, triggers);
        line.advance((bank, reading), request, &self.speaker, triggers)
    }

    /// Ends the line, if one plays.
    fn end(&mut self, triggers: &mut Triggers) {
        if let Some(line) = &mut self.state.line {
            line.end(triggers);
        }
    }
}

/// Triggers the events of one player.
pub(crate) struct Triggers<'a, 'w, 's> {
    commands: &'a mut Commands<'w, 's>,
    entity: Entity,
}

impl Triggers<'_, '_, '_> {
    /// Triggers the events of these segments.
    pub(crate) fn segments(&mut self, due: DueSegments<'_>, speaker: &str) {
        let entity = self.entity;
        for segment in due {
            let Some(event) = segment.event().filter(|event| !event.is_empty()) else { continue };
            self.commands.trigger(LipzSegment { entity, segment: segment.index(), event: event.to_owned() });
            for event in segment.events() {
                self.commands.trigger(LipzEvent::new(entity, segment.index(), &event, speaker));
            }
        }
    }

    pub(crate) fn subtitle(&mut self, text: &str, is_fallback: bool) {
        self.commands.trigger(LipzSubtitle { entity: self.entity, text: text.to_owned(), is_fallback });
    }

    pub(crate) fn finish(&mut self) {
        self.commands.trigger(LipzFinished { entity: self.entity });
    }

    pub(crate) fn fail(&mut self, error: LipzError) {
        self.commands.trigger(LipzFailed { entity: self.entity, error });
    }
}
