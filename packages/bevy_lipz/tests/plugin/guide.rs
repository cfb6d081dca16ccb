//! The program of `docs/guides/bevy.md`, which a test compares with the page.

use bevy::prelude::*;
use bevy_lipz::prelude::*;

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, LipzPlugin))
        .add_systems(Startup, |mut commands: Commands, assets: Res<AssetServer>| {
            let player = LipzPlayer::new(assets.load("voices.lipzbank"), "act1/otto-twenty-years");
            commands.spawn(player.with_speaker("otto").with_locale("de-de"));
        })
        .add_observer(|subtitle: On<LipzSubtitle>| println!("{}", subtitle.text))
        .add_observer(|event: On<LipzEvent>| println!("({})", *event))
        .add_observer(|failed: On<LipzFailed>| eprintln!("{}", failed.error))
        .run();
}
