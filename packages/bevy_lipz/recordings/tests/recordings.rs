//! Players that follow a recording. Its samples are read by the test, so no sound card is needed.
#![allow(clippy::unwrap_used, reason = "tests")]

use bevy::audio::{AudioSink, AudioSinkPlayback};
use bevy::prelude::*;
use bevy_lipz::prelude::*;
use rodio::buffer::SamplesBuffer;
use rodio::queue::SourcesQueueOutput;
use rodio::{Player, nz};
use std::time::Duration;

const RATE_HZ: usize = 8000;

#[derive(Resource, Default)]
struct Log(Vec<String>);

struct Game {
    app: App,
    player: Entity,
}

/// Returns a game whose player waits for a recording.
fn game() -> Game {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, AssetPlugin::default(), LipzPlugin)).init_resource::<Log>();
    app.add_observer(|subtitle: On<LipzSubtitle>, mut log: ResMut<Log>| log.0.push(subtitle.text.clone()));
    app.add_observer(|event: On<LipzEvent>, mut log: ResMut<Log>| log.0.push(format!("({})", *event)));
    app.add_observer(|_: On<LipzFinished>, mut log: ResMut<Log>| log.0.push("finished".to_owned()));
    let bank = LipzBank::open(&include_bytes!("../../assets/act1.lipzbank")[..]).unwrap();
    let bank = app.world_mut().resource_mut::<Assets<LipzBank>>().add(bank);
    let player = LipzPlayer::new(bank, "act1/mara-good-evening").with_locale("de-de");
    let player = app.world_mut().spawn(player.with_clock(LipzClock::Recording)).id();
    Game { app, player }
}

/// Returns a recording of this length, and its samples.
fn recording(seconds: usize) -> (AudioSink, SourcesQueueOutput) {
    let (player, output) = Player::new();
    player.append(SamplesBuffer::new(nz!(1), nz!(8000), vec![0.0; seconds * RATE_HZ]));
    (AudioSink::new(player), output)
}

/// Plays the samples of this many milliseconds of the recording.
fn hear(output: &mut SourcesQueueOutput, ms: usize) {
    assert_eq!(output.take(ms * RATE_HZ / 1000).count(), ms * RATE_HZ / 1000);
}

impl Game {
    fn frame(&mut self) -> Vec<String> {
        self.app.update();
        std::mem::take(&mut self.app.world_mut().resource_mut::<Log>().0)
    }

    fn time(&self) -> Duration {
        self.app.world().get::<LipzPlayer>(self.player).unwrap().time()
    }

    fn viseme(&self) -> char {
        self.app.world().get::<LipzMouth>(self.player).unwrap().viseme
    }

    fn insert(&mut self, sink: AudioSink) {
        self.app.world_mut().entity_mut(self.player).insert(sink);
    }

    fn sink(&mut self) -> Mut<'_, AudioSink> {
        self.app.world_mut().get_mut::<AudioSink>(self.player).unwrap()
    }
}

#[test]
fn the_line_follows_the_recording() {
    let mut game = game();
    assert!(game.frame().is_empty(), "waits for the recording");
    let (sink, mut output) = recording(4);
    game.insert(sink);
    assert_eq!(game.frame(), ["(feels neutral)", "Guten Abend, Otto."]);
    hear(&mut output, 1600);
    assert_eq!(game.frame(), ["(sees otto)", "Du bist spät dran,"]);
    let late = Duration::from_millis(1600).abs_diff(game.time());
    assert!(late < Duration::from_millis(20), "{late:?}");
    assert_ne!(game.viseme(), '-');

    game.sink().pause();
    assert!(game.frame().is_empty());
    assert_eq!(game.viseme(), '-');
    game.sink().play();
    game.frame();
    assert_ne!(game.viseme(), '-');
}

/// A recording that ends before its clip ends the line, with all events.
#[test]
fn the_line_ends_with_the_recording() {
    let mut game = game();
    let (sink, mut output) = recording(1);
    game.insert(sink);
    game.frame();
    hear(&mut output, 1500);
    assert_eq!(game.frame(), ["(sees otto)", "(points fog)", "", "finished"]);
    assert_eq!(game.viseme(), '-');
}

/// Bevy removes the sink at the end with `PlaybackSettings::REMOVE`.
#[test]
fn the_line_ends_with_the_sink() {
    let mut game = game();
    let (sink, mut output) = recording(4);
    game.insert(sink);
    game.frame();
    hear(&mut output, 100);
    game.frame();
    game.app.world_mut().entity_mut(game.player).remove::<AudioSink>();
    assert_eq!(game.frame(), ["(sees otto)", "(points fog)", "", "finished"]);

    let next = (game.player, "act1/otto-twenty-years");
    game.app.world_mut().get_mut::<LipzPlayer>(next.0).unwrap().play(next.1);
    assert!(game.frame().is_empty(), "the next line waits for its recording");
    assert!(game.frame().is_empty());
    let (sink, _output) = recording(4);
    game.insert(sink);
    assert_eq!(game.frame(), ["(feels sad)", "Es ist seit zwanzig Jahren unterwegs."]);
}

/// The position in the recording counts, which Bevy's position of the sink is not.
#[test]
fn a_fast_recording_is_followed() {
    let mut game = game();
    let (sink, mut output) = recording(4);
    game.insert(sink);
    game.sink().set_speed(2.0);
    game.frame();
    hear(&mut output, 500);
    game.frame();
    let late = Duration::from_millis(500).abs_diff(game.time());
    assert!(late < Duration::from_millis(20), "{:?}", game.time());
}
