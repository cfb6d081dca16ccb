//! An app whose time the test sets, and which logs all events of players.

use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_lipz::prelude::*;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The key of the clip of most tests, and the length of its frames.
pub(crate) const GOOD_EVENING: &str = "act1/mara-good-evening";
pub(crate) const FRAME: Duration = Duration::from_nanos(41_666_667);

/// The events, in order.
#[derive(Resource, Default)]
pub(crate) struct Log(pub(crate) Vec<String>);

/// Adds the observers that write the log.
pub(crate) fn logged(app: &mut App) {
    app.init_resource::<Log>()
        .add_observer(|subtitle: On<LipzSubtitle>, mut log: ResMut<Log>| {
            log.0.push(format!("{}{}", subtitle.text, if subtitle.is_fallback { " (fallback)" } else { "" }));
        })
        .add_observer(|event: On<LipzEvent>, mut log: ResMut<Log>| log.0.push(format!("({})", *event)))
        .add_observer(|_: On<LipzFinished>, mut log: ResMut<Log>| log.0.push("finished".to_owned()))
        .add_observer(|failed: On<LipzFailed>, mut log: ResMut<Log>| log.0.push(failed.error.to_string()));
}

/// An app with the plugin.
pub(crate) struct Game {
    pub(crate) app: App,
}

impl Game {
    /// Returns a game that loads assets from a folder.
    pub(crate) fn new(assets: &Path) -> Game {
        let mut app = App::new();
        let file_path = assets.to_str().unwrap().to_owned();
        app.add_plugins((MinimalPlugins, AssetPlugin { file_path, ..Default::default() }, LipzPlugin));
        app.init_asset::<Mesh>();
        logged(&mut app);
        // Bevy shortens rendered frames of more than a quarter of a second.
        app.world_mut().resource_mut::<Time<Virtual>>().set_max_delta(Duration::MAX);
        app.finish();
        app.cleanup();
        Game { app }
    }

    /// Returns a game with a player of the bank of act 1, which is loaded.
    pub(crate) fn act1(player: impl FnOnce(LipzPlayer) -> LipzPlayer) -> (Game, Entity) {
        Game::with_bank(&assets().join("act1.lipzbank"), player)
    }

    /// Returns a game with a player of this bank, which is loaded.
    pub(crate) fn with_bank(file: &Path, player: impl FnOnce(LipzPlayer) -> LipzPlayer) -> (Game, Entity) {
        let mut game = Game::new(&assets());
        let bank = LipzBank::open(std::fs::read(file).unwrap()).unwrap();
        let bank = game.app.world_mut().resource_mut::<Assets<LipzBank>>().add(bank);
        let entity = game.app.world_mut().spawn(player(LipzPlayer::new(bank, GOOD_EVENING))).id();
        (game, entity)
    }

    /// Renders a frame, this much later.
    pub(crate) fn frame(&mut self, later: Duration) {
        self.app.insert_resource(TimeUpdateStrategy::ManualDuration(later));
        self.app.update();
    }

    /// Renders frames for a time.
    pub(crate) fn frames(&mut self, count: u32, later: Duration) {
        for _ in 0..count {
            self.frame(later);
        }
    }

    /// Renders frames without a time between them until the log has an entry that starts with `start`.
    pub(crate) fn wait_for(&mut self, start: &str) {
        self.wait_until(|game| game.log().iter().any(|entry| entry.starts_with(start)));
    }

    /// Renders frames without a time between them until a condition holds.
    pub(crate) fn wait_until(&mut self, holds: impl Fn(&Game) -> bool) {
        let began = Instant::now();
        while !holds(self) {
            assert!(began.elapsed().as_secs() < 20, "waited in vain: {:?}", self.log());
            self.frame(Duration::ZERO);
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    pub(crate) fn log(&self) -> &[String] {
        &self.app.world().resource::<Log>().0
    }

    /// Returns the log, and empties it.
    pub(crate) fn take_log(&mut self) -> Vec<String> {
        std::mem::take(&mut self.app.world_mut().resource_mut::<Log>().0)
    }

    pub(crate) fn player(&mut self, entity: Entity) -> Mut<'_, LipzPlayer> {
        self.app.world_mut().get_mut::<LipzPlayer>(entity).unwrap()
    }

    pub(crate) fn mouth(&self, entity: Entity) -> LipzMouth {
        *self.app.world().get::<LipzMouth>(entity).unwrap()
    }
}

/// The folder of the package's assets.
pub(crate) fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets")
}

/// A golden bank of the repository.
pub(crate) fn golden(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/banks/v1").join(name)
}
