//! The programs of the README and of the guide with their output, and the example of the package.

#[allow(dead_code)]
#[path = "guide.rs"]
mod guide;
#[allow(dead_code, unreachable_pub)]
#[path = "../../examples/two_languages.rs"]
mod two_languages;

use crate::game::{FRAME, Game, Log, assets, logged};
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_lipz::prelude::*;

/// Returns the program of a page, and its output.
fn blocks(page: &str) -> (&str, &str) {
    let block = |kind: &str| page.split(kind).nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    (block("```rust\n"), block("```text\n"))
}

/// Plays the line of a program, and compares the log with the output that the page shows.
fn compare(page: &str) {
    let (program, output) = blocks(page);
    let literals: Vec<_> = program.split('"').skip(1).step_by(2).collect();
    assert!(literals[0].ends_with(".lipzbank"), "{literals:?}");
    let mut game = Game::new(&assets());
    let bank = game.app.world().resource::<AssetServer>().load("act1.lipzbank");
    game.app.world_mut().spawn(LipzPlayer::new(bank, literals[1]).with_speaker(literals[2]).with_locale(literals[3]));
    game.wait_for("(");
    game.frames(200, FRAME);
    let shown: Vec<_> = game.log().iter().filter(|entry| *entry != "finished").map(String::as_str).collect();
    assert_eq!(shown.join("\n") + "\n", output);
}

/// The program of the README is a doctest.
#[test]
fn the_readme_shows_the_output_of_its_program() {
    compare(include_str!("../../README.md"));
}

#[test]
fn the_guide_shows_the_output_of_its_program() {
    let guide = include_str!("../../../../docs/guides/bevy.md");
    compare(guide);
    let (_, compiled) = include_str!("guide.rs").split_once("\n\n").unwrap();
    assert_eq!(compiled, blocks(guide).0);
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
