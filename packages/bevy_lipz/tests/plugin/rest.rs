//! The mouth rests, and the subtitle ends, whatever interrupts a line.

use crate::game::{FRAME, Game};
use bevy::ecs::entity::Entity;
use bevy_lipz::prelude::*;

/// Returns a game in the middle of a line, with an empty log.
fn speaking() -> (Game, Entity) {
    let (mut game, entity) = Game::act1(|player| player.with_speaker("mara").with_locale("de-de"));
    game.frames(4, FRAME);
    assert_ne!(game.mouth(entity), LipzMouth::REST);
    assert_eq!(game.player(entity).subtitle(), "Guten Abend, Otto.");
    game.take_log();
    (game, entity)
}

#[test]
fn after_a_stop() {
    let (mut game, entity) = speaking();
    game.player(entity).stop();
    game.frames(200, FRAME);
    assert_eq!(game.log(), [""]);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
    assert_eq!(game.player(entity).subtitle(), "");
}

#[test]
fn after_a_skip_with_the_remaining_events() {
    let (mut game, entity) = speaking();
    game.player(entity).skip();
    game.frames(200, FRAME);
    assert_eq!(game.log(), ["(mara sees otto)", "(mara points fog)", "", "finished"]);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
}

#[test]
fn while_paused() {
    let (mut game, entity) = speaking();
    let time = game.player(entity).time();
    game.player(entity).is_paused = true;
    game.frames(200, FRAME);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
    assert_eq!((game.player(entity).time(), game.log().len()), (time, 0));
    game.player(entity).is_paused = false;
    game.frames(1, FRAME);
    assert_eq!(game.player(entity).time(), time + FRAME);
    assert_ne!(game.mouth(entity), LipzMouth::REST);
}

/// A line that starts while the player is paused triggers nothing before it continues.
#[test]
fn before_a_paused_line() {
    let (mut game, entity) = speaking();
    let mut player = game.player(entity);
    player.is_paused = true;
    player.play("act1/otto-twenty-years");
    game.frames(5, FRAME);
    assert_eq!(game.take_log(), [""]);
    game.player(entity).is_paused = false;
    game.frame(FRAME);
    assert_eq!(game.log(), ["(mara feels sad)", "Es ist seit zwanzig Jahren unterwegs."]);
}

#[test]
fn after_the_player_was_removed() {
    let (mut game, entity) = speaking();
    game.app.world_mut().entity_mut(entity).remove::<LipzPlayer>();
    game.frame(FRAME);
    assert_eq!(game.log(), [""]);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
}

#[test]
fn after_the_entity_was_despawned() {
    let (mut game, entity) = speaking();
    game.app.world_mut().despawn(entity);
    game.frame(FRAME);
    assert_eq!(game.log(), [""]);
}

#[test]
fn before_a_bank_without_the_clip() {
    let (mut game, entity) = speaking();
    game.player(entity).bank = bevy::asset::Handle::default();
    game.frame(FRAME);
    assert_eq!(game.log(), [""]);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
}
