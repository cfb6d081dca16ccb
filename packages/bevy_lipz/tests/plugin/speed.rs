//! The time of a rendered frame: `cargo test --release --test plugin -- --ignored --nocapture speed`.

use crate::face::model;
use crate::game::{Game, assets};
use bevy_lipz::prelude::*;
use std::time::{Duration, Instant};

/// The weights of the rig for ARKit.
const SHAPES: [&str; 35] = [
    "jawOpen",
    "mouthClose",
    "mouthFunnel",
    "mouthPucker",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthPressLeft",
    "mouthPressRight",
    "mouthStretchLeft",
    "mouthStretchRight",
    "mouthSmileLeft",
    "mouthSmileRight",
    "mouthFrownLeft",
    "mouthFrownRight",
    "mouthUpperUpLeft",
    "mouthUpperUpRight",
    "mouthLowerDownLeft",
    "mouthLowerDownRight",
    "tongueOut",
    "cheekSquintLeft",
    "cheekSquintRight",
    "noseSneerLeft",
    "noseSneerRight",
    "browDownLeft",
    "browDownRight",
    "browInnerUp",
    "browOuterUpLeft",
    "browOuterUpRight",
    "eyeWideLeft",
    "eyeWideRight",
    "eyeSquintLeft",
    "eyeSquintRight",
    "eyeBlinkLeft",
    "eyeBlinkRight",
];

const FRAMES: u32 = 200;
const STEP: Duration = Duration::from_millis(16);

/// Returns the time of a rendered frame with this many players.
fn frame(players: u32, has_face: bool) -> Duration {
    let mut game = Game::new(&assets());
    let bank = LipzBank::open(std::fs::read(assets().join("act1.lipzbank")).unwrap()).unwrap();
    let bank = game.app.world_mut().resource_mut::<bevy::asset::Assets<LipzBank>>().add(bank);
    for _ in 0..players {
        let player = LipzPlayer::new(bank.clone(), "act1/mara-good-evening").with_speaker("mara");
        let entity = game.app.world_mut().spawn(player).id();
        if has_face {
            game.app.world_mut().entity_mut(entity).insert(LipzFace::default());
            model(&mut game, entity, &SHAPES);
        }
    }
    game.frames(3, STEP);
    let began = Instant::now();
    game.frames(FRAMES, STEP);
    began.elapsed() / FRAMES
}

#[test]
#[ignore = "measures"]
fn speed() {
    let empty = frame(0, false);
    for (name, has_face) in [("tick", false), ("weights", true)] {
        let each = frame(1000, has_face).saturating_sub(empty) / 1000;
        println!("bench {name}_ns {} Bevy player", each.as_nanos());
    }
    println!("app without players: {} ns per rendered frame", empty.as_nanos());
}
