//! Sprite sheets.

use crate::game::{FRAME, Game};
use bevy::prelude::*;
use bevy_lipz::prelude::*;

fn sheet() -> Sprite {
    Sprite { texture_atlas: Some(TextureAtlas::default()), ..Default::default() }
}

fn index(game: &Game, entity: Entity) -> usize {
    game.app.world().get::<Sprite>(entity).unwrap().texture_atlas.as_ref().unwrap().index
}

#[test]
fn a_sheet_shows_the_visemes_of_its_player() {
    let (mut game, entity) = Game::act1(|player| LipzPlayer { holds_consonants: false, ..player });
    let body = game.app.world_mut().spawn(ChildOf(entity)).id();
    let world = game.app.world_mut();
    let own = world.spawn((ChildOf(body), LipzSprite::default(), sheet())).id();
    let elsewhere = LipzSprite { player: Some(entity), ..LipzSprite::new("x-O") };
    let elsewhere = world.spawn((elsewhere, sheet())).id();
    let of_none = world.spawn((LipzSprite::default(), sheet())).id();
    let (mut shown, mut other) = (String::new(), Vec::new());
    for _ in 0..30 {
        game.frame(FRAME);
        shown.push("-AEFLMOSUW".chars().nth(index(&game, own)).unwrap());
        other.push(index(&game, elsewhere));
        assert_eq!(index(&game, of_none), 0);
    }
    assert_eq!(shown, "SOOOOSEEEFEESAASS---OOOSSSOO--");
    assert_eq!(other[..7], [1, 2, 2, 2, 2, 1, 1], "S and E are not in the sheet");
    game.app.world_mut().entity_mut(entity).remove::<LipzPlayer>();
    game.frame(FRAME);
    assert_eq!((index(&game, own), index(&game, elsewhere)), (0, 1));
}

/// An unchanged picture does not count as changed.
#[test]
fn an_equal_picture_is_not_a_change() {
    #[derive(Resource, Default)]
    struct Changes(u32);
    let (mut game, entity) = Game::act1(|player| player);
    game.app.init_resource::<Changes>().add_systems(
        Last,
        |sprites: Query<(), Changed<Sprite>>, mut changes: ResMut<Changes>| {
            changes.0 += u32::try_from(sprites.iter().count()).unwrap();
        },
    );
    game.app.world_mut().spawn((ChildOf(entity), LipzSprite::default(), sheet()));
    game.frame(FRAME);
    let before = game.app.world().resource::<Changes>().0;
    game.player(entity).is_paused = true;
    game.frames(2, FRAME);
    let resting = game.app.world().resource::<Changes>().0;
    game.frames(20, FRAME);
    assert_eq!((before, resting, game.app.world().resource::<Changes>().0), (1, 2, 2));
}
