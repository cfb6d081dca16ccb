//! New versions of a bank while a line plays.

use crate::game::{FRAME, GOOD_EVENING, Game, assets, golden};
use bevy::prelude::*;
use bevy_lipz::prelude::*;
use std::path::Path;
use std::time::Duration;

const FILE: &str = "lines.lipzbank";

/// Returns a game half a second after the start of a line, with an empty log.
fn speaking(folder: &Path) -> (Game, Entity) {
    std::fs::copy(assets().join("act1.lipzbank"), folder.join(FILE)).unwrap();
    let mut game = Game::new(folder);
    let bank = game.app.world().resource::<AssetServer>().load(FILE);
    let player = LipzPlayer::new(bank, GOOD_EVENING).with_speaker("mara").with_locale("de-de");
    let entity = game.app.world_mut().spawn(player).id();
    game.wait_for("Guten Abend");
    game.frames(12, FRAME);
    game.take_log();
    (game, entity)
}

/// Replaces the bank, and loads it as the file watcher of Bevy does.
fn replace(game: &mut Game, folder: &Path, bytes: &[u8]) {
    std::fs::write(folder.join(FILE), bytes).unwrap();
    game.app.world().resource::<AssetServer>().reload(FILE);
}

/// Whether the version with this checksum is loaded.
fn is_loaded(game: &Game, checksum: u64) -> bool {
    let mut banks = game.app.world().resource::<Assets<LipzBank>>().iter();
    banks.any(|(_, bank)| bank.bank().checksum() == checksum)
}

#[test]
fn a_new_version_continues_at_the_same_time() {
    let folder = tempfile::tempdir().unwrap();
    let (mut game, entity) = speaking(folder.path());
    let time = game.player(entity).time();
    assert_eq!(time, FRAME * 12);

    // The same clip in a bank with more languages.
    let drama = LipzBank::open(std::fs::read(golden("drama.lipzbank")).unwrap()).unwrap();
    replace(&mut game, folder.path(), &std::fs::read(golden("drama.lipzbank")).unwrap());
    game.wait_until(|game| is_loaded(game, drama.bank().checksum()));
    assert!(game.log().is_empty(), "{:?}", game.log());
    game.player(entity).locale = "fr-fr".to_owned();
    game.frame(Duration::ZERO);
    assert_eq!(game.player(entity).time(), time);
    assert_eq!(game.mouth(entity).viseme, 'S');
    game.frames(200, FRAME);
    let log = game.take_log();
    let expected = [
        "Bonsoir, Otto.",
        "(mara sees otto)",
        "Tu es en retard,",
        "(mara points fog)",
        "et le brouillard est en avance.",
        "",
        "finished",
    ];
    assert_eq!(log, expected);
}

/// Languages are numbers of one version. The player looks its own up again.
#[test]
fn a_new_version_keeps_the_language() {
    let folder = tempfile::tempdir().unwrap();
    let (mut game, _) = speaking(folder.path());
    let drama = std::fs::read(golden("drama.lipzbank")).unwrap();
    replace(&mut game, folder.path(), &drama);
    let drama = LipzBank::open(drama).unwrap();
    game.wait_until(|game| is_loaded(game, drama.bank().checksum()));
    game.frames(30, FRAME);
    assert_eq!(game.take_log(), ["(mara sees otto)", "Du bist spät dran,"]);
}

#[test]
fn a_damaged_version_is_reported_and_the_old_one_plays_on() {
    let folder = tempfile::tempdir().unwrap();
    let (mut game, entity) = speaking(folder.path());
    for _ in 0..2 {
        replace(&mut game, folder.path(), b"LPZB");
        game.wait_for("the bank did not load: the file is not a lipz bank");
        assert_eq!(game.take_log().len(), 1);
    }
    assert_eq!(game.player(entity).time(), FRAME * 12);
    game.frames(30, FRAME);
    assert_eq!(game.take_log(), ["(mara sees otto)", "Du bist spät dran,"]);
}

#[test]
fn a_version_without_the_clip_ends_the_line() {
    let folder = tempfile::tempdir().unwrap();
    let (mut game, entity) = speaking(folder.path());
    replace(&mut game, folder.path(), &std::fs::read(golden("small.lipzbank")).unwrap());
    game.wait_for("the bank does not contain the clip");
    game.frames(3, FRAME);
    assert_eq!(game.take_log(), ["the bank does not contain the clip act1/mara-good-evening", ""]);
    assert_eq!(game.mouth(entity), LipzMouth::REST);
}

/// A clip that was missing plays as soon as a version contains it.
#[test]
fn a_version_with_the_missing_clip_starts_the_line() {
    let folder = tempfile::tempdir().unwrap();
    let (mut game, entity) = speaking(folder.path());
    let drama = std::fs::read(golden("drama.lipzbank")).unwrap();
    let opened = LipzBank::open(drama.clone()).unwrap();
    let key = opened.bank().clips_under("act2/").next().unwrap().key().to_owned();
    game.player(entity).play(key.clone());
    game.frame(FRAME);
    assert_eq!(game.take_log(), [String::new(), format!("the bank does not contain the clip {key}")]);
    replace(&mut game, folder.path(), &drama);
    game.wait_until(|game| game.app.world().get::<LipzPlayer>(entity).unwrap().is_playing());
}
