//! The output in the README, and the example of the package.

#[allow(dead_code, unreachable_pub)]
#[path = "../../examples/two_languages.rs"]
mod two_languages;

use crate::game::{FRAME, Game, Log, assets, logged};
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_lipz::prelude::*;

/// The README's program is a doctest. Its output is that of the log.
#[test]
fn the_readme_shows_the_output_of_its_program() {
    let readme = include_str!("../../README.md");
    let block = |kind: &str| readme.split(kind).nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let (program, output) = (block("```rust\n"), block("```text\n"));
    let literals: Vec<_> = program.split('"').skip(1).step_by(2).collect();
    assert_eq!(literals[..4], ["act1.lipzbank", "act1/mara-good-evening", "mara", "de-de"]);

    let mut game = Game::new(&assets());
    let bank = game.app.world().resource::<AssetServer>().load(literals[0]);
    game.app.world_mut().spawn(LipzPlayer::new(bank, literals[1]).with_speaker(literals[2]).with_locale(literals[3]));
    game.wait_for("(");
    game.frames(200, FRAME);
    let shown: Vec<_> = game.log().iter().filter(|entry| *entry != "finished").map(String::as_str).collect();
    assert_eq!(shown.join("\n") + "\n", output);
}

#[test]
fn the_example_speaks_two_lines_in_two_languages() {
    let mut app = two_languages::app();
    logged(&mut app);
    app.finish();
    app.cleanup();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(FRAME));
    let mut frames = 0;
    while app.should_exit().is_none() {
        app.update();
        frames += 1;
        assert!(frames < 100_000, "{:?}", app.world().resource::<Log>().0);
    }
    let expected = [
        "(mara feels neutral)",
        "Good evening, Otto.",
        "(mara sees otto)",
        "You are late,",
        "(mara points fog)",
        "and the fog is early.",
        "",
        "finished",
        "(otto feels sad)",
        "Es ist seit zwanzig Jahren unterwegs.",
        "(otto stares parcel)",
        "Es ist hinter den Briefmarkenschrank gefallen.",
        "(otto stops staring)",
        "Keiner hat nachgesehen.",
        "(mara feels thinking)",
        "Nicht mal ich.",
        "",
        "finished",
    ];
    assert_eq!(app.world().resource::<Log>().0, expected);
}
