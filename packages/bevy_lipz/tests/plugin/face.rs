//! Morph targets.

use crate::game::{FRAME, GOOD_EVENING, Game, assets, golden};
use bevy::asset::RenderAssetUsages;
use bevy::mesh::PrimitiveTopology;
use bevy::mesh::morph::MorphWeights;
use bevy::prelude::*;
use bevy_lipz::lipz_bank::articulation::Articulation;
use bevy_lipz::lipz_bank::curve::CurveValue;
use bevy_lipz::lipz_bank::face::{LookAt, Who};
use bevy_lipz::prelude::*;
use std::time::Duration;

/// Spawns a model with morph targets of these names below an entity.
pub(crate) fn model(game: &mut Game, parent: Entity, names: &[&str]) -> Entity {
    let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    mesh.set_morph_target_names(names.iter().map(|name| (*name).to_owned()).collect());
    let mesh = game.app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh);
    let weights = MorphWeights::new(vec![0.0; names.len()], Some(mesh)).unwrap();
    let node = game.app.world_mut().spawn(ChildOf(parent)).id();
    game.app.world_mut().spawn((ChildOf(node), weights)).id()
}

fn weights(game: &Game, model: Entity) -> Vec<f32> {
    game.app.world().get::<MorphWeights>(model).unwrap().weights().to_vec()
}

/// The weights of the reader for some names of ARKit.
fn expected(key: &str, time: Duration, who: Who<'_>, speaks: bool, names: &[&str]) -> Vec<f32> {
    let bank = LipzBank::open(std::fs::read(assets().join("act1.lipzbank")).unwrap()).unwrap();
    let bank = bank.bank();
    let clip = bank.clip_by_key(key).unwrap();
    let (profile, rig) = (bank.default_articulation(), bank.rig("arkit").unwrap());
    let mouth = if speaks { clip.articulation_at(time, &profile) } else { Articulation::default() };
    let face = clip.face_at(time, who, &bank.default_face_profile(), LookAt::AHEAD);
    let mut weights = [CurveValue::default(); 64];
    rig.weights(&mouth, &clip.emotions_at(time, who), &face, &mut weights);
    let place = |name: &&str| rig.weight_names().position(|weight| weight == *name);
    names.iter().map(|name| place(name).map_or(0.0, |place| weights[place].to_f32())).collect()
}

#[test]
fn morph_targets_follow_the_rig() {
    let (mut game, entity) = Game::act1(|player| player.with_speaker("mara"));
    game.app.world_mut().entity_mut(entity).insert(LipzFace::default());
    let head = model(&mut game, entity, &["ear", "face.jawOpen", "mouthSmile_L", "mouthFunnel", "eyeBlink_R"]);
    let teeth = model(&mut game, entity, &["jaw_open"]);
    let names = ["", "jawOpen", "mouthSmileLeft", "mouthFunnel", "eyeBlinkRight"];
    let mut widest = 0.0_f32;
    for frame in 0..90 {
        game.frame(FRAME);
        let shown = weights(&game, head);
        assert_eq!(
            shown,
            expected(GOOD_EVENING, FRAME * frame, Who::SpeakerNamed("mara"), true, &names),
            "frame {frame}"
        );
        assert_eq!(weights(&game, teeth), shown[1..2]);
        widest = widest.max(shown[1]);
    }
    assert!(widest > 0.3, "{widest}");
    let shapes = game.app.world().get::<LipzShapes>(head).unwrap();
    assert_eq!((shapes.kind(), shapes.missing().len()), (Some("arkit"), 31));

    game.player(entity).is_paused = true;
    game.frame(FRAME);
    assert_eq!(weights(&game, head), [0.0; 5]);
    game.player(entity).is_paused = false;
    game.frame(FRAME);
    assert_ne!(weights(&game, head), [0.0; 5]);
    game.app.world_mut().entity_mut(entity).remove::<LipzPlayer>();
    game.frame(FRAME);
    assert_eq!(weights(&game, head), [0.0; 5]);
}

/// A line whose clock has not started is not shown.
#[test]
fn a_face_rests_before_its_clock_starts() {
    let (mut game, entity) = Game::act1(|player| player.with_clock(LipzClock::Manual));
    game.app.world_mut().entity_mut(entity).insert(LipzFace::default());
    let head = model(&mut game, entity, &["jawOpen", "mouthFunnel"]);
    game.frames(3, FRAME);
    assert_eq!(weights(&game, head), [0.0; 2]);
    game.player(entity).set_time(Duration::ZERO);
    game.frame(FRAME);
    assert_ne!(weights(&game, head), [0.0; 2]);
}

#[test]
fn a_different_character_listens() {
    let key = "act1/otto-twenty-years";
    let (mut game, player) =
        Game::act1(|player| LipzPlayer { clip: key.to_owned(), speaker: "otto".to_owned(), ..player });
    let face = LipzFace { player: Some(player), character: "mara".to_owned(), ..Default::default() };
    let mara = game.app.world_mut().spawn(face).id();
    let names = ["jawOpen", "eyeBlinkLeft", "browInnerUp"];
    let head = model(&mut game, mara, &names);
    let mut blinks = 0.0_f32;
    for frame in 0..160 {
        game.frame(FRAME);
        let shown = weights(&game, head);
        assert_eq!(shown, expected(key, FRAME * frame, Who::Other("mara"), false, &names), "frame {frame}");
        blinks = blinks.max(shown[1]);
    }
    assert!(blinks > 0.5, "{blinks}");
}

#[test]
fn a_model_with_a_shape_for_each_viseme_needs_no_rig() {
    let (mut game, entity) = Game::act1(|player| LipzPlayer { holds_consonants: false, ..player });
    game.app.world_mut().entity_mut(entity).insert(LipzFace::default());
    let codes = "AEFLMOSUW-";
    let names: Vec<_> = codes.chars().map(|code| format!("Mouth_{code}").replace("_-", "_rest")).collect();
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    let head = model(&mut game, entity, &names);
    let mut shown = String::new();
    for _ in 0..18 {
        game.frame(FRAME);
        let weights = weights(&game, head);
        let place = weights.iter().position(|weight| *weight == 1.0);
        shown.push(place.map_or('?', |place| codes.chars().nth(place).unwrap()));
    }
    assert_eq!(shown.replace('?', "-"), "SOOOOSEEEFEESAASS-");
    assert_eq!(game.app.world().get::<LipzShapes>(head).unwrap().kind(), Some("blair"));
}

#[test]
fn unknown_names_are_reported_once() {
    let (mut game, entity) = Game::act1(|player| player);
    game.app.world_mut().entity_mut(entity).insert(LipzFace::default());
    let head = model(&mut game, entity, &["smirk", "wink"]);
    game.frames(5, FRAME);
    let reports: Vec<_> = game.log().iter().filter(|entry| entry.contains("morph targets")).collect();
    let report =
        "the names of the morph targets (smirk, wink) are not in a rig of the bank: add one to [rig] in lipz.toml";
    assert_eq!(reports, [report]);
    assert_eq!(weights(&game, head), [0.0; 2]);
    assert_eq!(game.app.world().get::<LipzShapes>(head).unwrap().kind(), None);

    let mut face = game.app.world_mut().get_mut::<LipzFace>(entity).unwrap();
    face.rig = "vrm".to_owned();
    game.frames(5, FRAME);
    let last = "the bank does not contain the rig vrm: add it to [rig] in lipz.toml";
    assert_eq!(game.log().iter().filter(|entry| *entry == last).count(), 1, "{:?}", game.log());
}

/// A bank with all rigs: the names of the model select one of them.
#[test]
fn the_names_select_the_rig() {
    for (names, kind) in [
        (&["viseme_aa", "viseme_E", "viseme_I", "viseme_O", "viseme_U", "viseme_PP", "viseme_FF"][..], "ovr"),
        (&["M_Fcl_MTH_A", "M_Fcl_MTH_I", "M_Fcl_MTH_U", "M_Fcl_MTH_E", "M_Fcl_MTH_O", "M_Fcl_ALL_Joy"], "vrm"),
        (&["あ", "い", "う", "え", "お"], "mmd"),
        (&["jawOpen", "mouthFunnel", "mouthPucker", "mouthClose"], "arkit"),
    ] {
        let (mut game, entity) =
            Game::with_bank(&golden("rigs.lipzbank"), |player| LipzPlayer { clip: "english".to_owned(), ..player });
        game.app.world_mut().entity_mut(entity).insert(LipzFace::default());
        let head = model(&mut game, entity, names);
        let mut moved = 0;
        for _ in 0..40 {
            game.frame(FRAME);
            moved += usize::from(weights(&game, head).iter().any(|weight| *weight > 0.1));
        }
        assert_eq!(game.app.world().get::<LipzShapes>(head).and_then(LipzShapes::kind), Some(kind));
        assert!(moved > 10, "{kind} {moved}");
    }
}
