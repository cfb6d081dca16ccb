//! Missing and damaged banks, and missing clips, reach the observers.

use crate::game::{FRAME, Game, assets};
use bevy::prelude::*;
use bevy_lipz::prelude::*;

/// Returns the log of a player that loads this file of a folder.
fn loaded(folder: &std::path::Path, file: &'static str) -> (Game, Entity) {
    let mut game = Game::new(folder);
    let bank = game.app.world().resource::<AssetServer>().load(file);
    let entity = game.app.world_mut().spawn(LipzPlayer::new(bank, "act1/otto-aye")).id();
    (game, entity)
}

#[test]
fn damaged_banks() {
    let folder = tempfile::tempdir().unwrap();
    let bank = std::fs::read(assets().join("act1.lipzbank")).unwrap();
    let cut = bank[..bank.len() - 1].to_vec();
    let mut changed = bank.clone();
    *changed.last_mut().unwrap() ^= 1;
    let texts = std::fs::read(crate::game::golden("split.de-de.lipztexts")).unwrap();
    for (file, bytes, words) in [
        ("empty.lipzbank", Vec::new(), "the file is shorter than the header of a bank (bank error 1, at byte 0)"),
        ("other.lipzbank", b"{}".repeat(50), "the file is not a lipz bank (bank error 2, at byte 0)"),
        ("cut.lipzbank", cut, "the file does not have the length in its header"),
        ("changed.lipzbank", changed, "the checksum does not match: the file was changed or damaged (bank error 12"),
        ("texts.lipzbank", texts, "the file contains only texts, for the clips of another bank (bank error 29"),
    ] {
        std::fs::write(folder.path().join(file), bytes).unwrap();
        let (mut game, _) = loaded(folder.path(), file);
        game.wait_for("the bank did not load: ");
        game.frames(5, FRAME);
        assert_eq!(game.log().len(), 1, "{:?}", game.log());
        assert!(game.log()[0].starts_with(&format!("the bank did not load: {words}")), "{:?}", game.log());
    }
}

#[test]
fn a_missing_bank() {
    let (mut game, _) = loaded(&assets(), "missing.lipzbank");
    game.wait_for("the bank did not load: Path not found: ");
    game.frames(5, FRAME);
    assert_eq!(game.log().len(), 1);

    // A player that is spawned after the bank has failed.
    let bank = game.app.world().resource::<AssetServer>().load("missing.lipzbank");
    game.app.world_mut().spawn(LipzPlayer::new(bank, "act1/otto-aye"));
    game.frames(5, FRAME);
    assert!(game.log().len() >= 2, "{:?}", game.log());
}

#[test]
fn a_missing_clip() {
    let (mut game, entity) = Game::act1(|player| LipzPlayer { clip: "act1/mara-god-evening".to_owned(), ..player });
    game.frames(5, FRAME);
    assert_eq!(game.log(), ["the bank does not contain the clip act1/mara-god-evening"]);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
}

/// Observers of one entity are called as well.
#[test]
fn an_observer_of_the_player() {
    #[derive(Resource, Default)]
    struct Errors(Vec<LipzError>);
    let (mut game, entity) = Game::act1(|player| LipzPlayer { clip: "none".to_owned(), ..player });
    game.app.init_resource::<Errors>();
    game.app
        .world_mut()
        .entity_mut(entity)
        .observe(|failed: On<LipzFailed>, mut errors: ResMut<Errors>| errors.0.push(failed.error.clone()));
    game.frame(FRAME);
    assert_eq!(game.app.world().resource::<Errors>().0, [LipzError::NoClip { key: "none".to_owned() }]);
}
