//! Lines from their start to their end: visemes, subtitles, events, languages, voices and clocks.

use crate::game::{FRAME, GOOD_EVENING, Game, golden};
use bevy_lipz::LipzMouth;
use bevy_lipz::prelude::*;
use std::time::Duration;

const GERMAN: [&str; 8] = [
    "(mara feels neutral)",
    "Guten Abend, Otto.",
    "(mara sees otto)",
    "Du bist spät dran,",
    "(mara points fog)",
    "und der Nebel ist zu früh.",
    "",
    "finished",
];

fn mara(player: LipzPlayer) -> LipzPlayer {
    player.with_speaker("mara").with_locale("de-de")
}

#[test]
fn a_line_plays_from_start_to_end() {
    let (mut game, entity) = Game::act1(mara);
    game.frame(FRAME);
    assert!(game.player(entity).is_playing());
    assert_eq!(game.player(entity).time(), Duration::ZERO);
    assert_eq!(game.player(entity).subtitle(), "Guten Abend, Otto.");
    game.frames(200, FRAME);
    assert_eq!(game.take_log(), GERMAN);
    assert!(!game.player(entity).is_playing());
    assert_eq!(game.mouth(entity), LipzMouth::REST);
    game.frames(10, FRAME);
    assert!(game.log().is_empty());
}

/// Events happen once, in order, whatever the length of rendered frames is.
#[test]
fn events_happen_once_in_any_rendered_frame() {
    let events = |log: Vec<String>| log.into_iter().filter(|entry| entry.starts_with('(')).collect::<Vec<_>>();
    for ms in [5, 16, 33, 100, 500, 1700, 3000, 60_000] {
        let (mut game, _) = Game::act1(mara);
        game.frames(5000 / ms + 2, Duration::from_millis(ms.into()));
        let log = game.take_log();
        assert_eq!(log.iter().filter(|entry| *entry == "finished").count(), 1, "{ms} ms");
        assert_eq!(events(log), [GERMAN[0], GERMAN[2], GERMAN[4]], "{ms} ms");
    }
}

#[test]
fn the_mouth_shows_each_frame() {
    let (mut game, entity) = Game::act1(|mut player| {
        player.holds_consonants = false;
        player
    });
    let mut shown = String::new();
    for _ in 0..60 {
        game.frame(FRAME);
        shown.push(game.mouth(entity).viseme);
    }
    assert_eq!(shown, "SOOOOSEEEFEESAASS---OOOSSSOO-------SOOUUUASSEELAAAS---AASSSS");
    assert_eq!(game.mouth(entity).openness.map(|openness| (openness * 100.0).round()), Some(33.0));
}

#[test]
fn a_lead_shows_the_next_frame() {
    let (mut game, entity) = Game::act1(|mut player| {
        (player.holds_consonants, player.lead_frames) = (false, 1);
        player
    });
    game.frame(FRAME);
    assert_eq!(game.mouth(entity).viseme, 'O');
}

#[test]
fn the_next_line_follows() {
    let (mut game, entity) = Game::act1(mara);
    game.frames(20, FRAME);
    game.take_log();
    let mut player = game.player(entity);
    player.speaker = "otto".to_owned();
    player.play("act1/otto-twenty-years");
    game.frame(FRAME);
    assert_eq!(game.take_log(), ["", "(otto feels sad)", "Es ist seit zwanzig Jahren unterwegs."]);

    game.player(entity).clip = GOOD_EVENING.to_owned(); // as in an editor
    game.frame(FRAME);
    assert_eq!(game.take_log(), ["", "(otto feels neutral)", "Guten Abend, Otto."]);

    game.player(entity).play(GOOD_EVENING); // again
    game.frame(FRAME);
    assert_eq!(game.player(entity).time(), Duration::ZERO);
    assert_eq!(game.take_log(), ["", "(otto feels neutral)", "Guten Abend, Otto."]);
}

/// The events of the skipped line come first, each once, and belong to its speaker.
#[test]
fn the_next_line_follows_a_skipped_line() {
    let (mut game, entity) = Game::act1(|player| player.with_locale("de-de"));
    game.player(entity).speaker = "mara".to_owned();
    game.frames(20, FRAME);
    game.take_log();
    let mut player = game.player(entity);
    player.skip();
    player.speaker = "otto".to_owned();
    player.play("act1/otto-twenty-years");
    game.frame(FRAME);
    let next = ["(otto feels sad)", "Es ist seit zwanzig Jahren unterwegs."];
    let skipped = ["(mara sees otto)", "(mara points fog)", "", "finished"];
    assert_eq!(game.take_log(), [&skipped[..], &next].concat());

    let mut player = game.player(entity);
    player.skip();
    player.clip = GOOD_EVENING.to_owned(); // as in an editor
    game.frame(FRAME);
    let log = game.take_log();
    assert_eq!(log[log.len() - 4..], ["", "finished", "(otto feels neutral)", "Guten Abend, Otto."], "{log:?}");
    assert!(game.player(entity).is_playing());
}

/// A line that was started in the same rendered frame is skipped, too.
#[test]
fn two_lines_are_skipped_in_a_rendered_frame() {
    let (mut game, entity) = Game::act1(mara);
    game.frames(20, FRAME);
    game.take_log();
    let mut player = game.player(entity);
    player.skip();
    player.play(GOOD_EVENING);
    player.skip();
    game.frames(3, FRAME);
    let first = ["(mara sees otto)", "(mara points fog)", "", "finished"];
    let second = ["(mara feels neutral)", "(mara sees otto)", "(mara points fog)", "finished"];
    assert_eq!(game.take_log(), [first, second].concat());
    assert!(!game.player(entity).is_playing());
}

/// A jump or a stop after a skip does not change that the line has ended with its events.
#[test]
fn a_skipped_line_has_ended() {
    for order in [LipzPlayer::stop, |player: &mut LipzPlayer| player.seek(Duration::from_secs(1)), LipzPlayer::skip] {
        let (mut game, entity) = Game::act1(mara);
        game.frames(20, FRAME);
        game.take_log();
        game.player(entity).skip();
        order(&mut game.player(entity));
        game.frames(3, FRAME);
        assert_eq!(game.take_log(), ["(mara sees otto)", "(mara points fog)", "", "finished"]);
    }
}

#[test]
fn a_line_can_be_skipped_before_it_starts() {
    let (mut game, entity) = Game::act1(mara);
    game.player(entity).skip();
    game.frames(3, FRAME);
    assert_eq!(game.take_log(), ["(mara feels neutral)", "(mara sees otto)", "(mara points fog)", "finished"]);
}

#[test]
fn the_language_changes_while_a_line_plays() {
    let (mut game, entity) = Game::act1(mara);
    game.frames(2, FRAME);
    game.player(entity).locale = "en-us".to_owned();
    game.frames(2, FRAME);
    assert_eq!(game.take_log(), ["(mara feels neutral)", "Guten Abend, Otto.", "Good evening, Otto."]);
}

#[test]
fn an_empty_language_is_that_of_the_bank() {
    let (mut game, _) = Game::act1(|player| player);
    game.frame(FRAME);
    assert_eq!(game.log(), ["(feels neutral)", "Good evening, Otto."]);
}

#[test]
fn an_unknown_language_is_reported_once() {
    let (mut game, _) = Game::act1(|player| player.with_locale("fr-fr"));
    game.frames(3, FRAME);
    let report = "the bank does not contain texts in fr-fr, only in de-de, en-us";
    assert_eq!(game.log(), [report, "(feels neutral)", "Good evening, Otto."]);
}

#[test]
fn a_voice_selects_the_dub() {
    let bank = LipzBank::open(std::fs::read(golden("dubbed.lipzbank")).unwrap()).unwrap();
    let bank = bank.bank();
    let original = bank.clips().find(|clip| clip.in_voice(bank.voice("de-de").unwrap()).clip != *clip).unwrap();
    let dub = original.in_voice(bank.voice("de-de").unwrap()).clip;
    for (voice, clip) in [("", original), ("en-us", original), ("de-de", dub)] {
        let (mut game, entity) = Game::with_bank(&golden("dubbed.lipzbank"), |mut player| {
            player.holds_consonants = false;
            player.clip = original.key().to_owned();
            player.with_voice(voice)
        });
        let frame = Duration::from_micros(clip.duration_us().unwrap() / u64::from(clip.frame_count()) + 1);
        let mut shown = Vec::new();
        for _ in 0..clip.frame_count() {
            game.frame(frame);
            shown.push(u8::try_from(game.mouth(entity).viseme).unwrap());
        }
        assert_eq!(shown, clip.frames(), "{voice}");
    }
}

#[test]
fn a_manual_clock_is_followed() {
    let (mut game, entity) = Game::act1(|player| mara(player).with_clock(LipzClock::Manual));
    game.frames(3, FRAME);
    assert!(game.log().is_empty(), "waits for the first time");
    assert_eq!(game.mouth(entity), LipzMouth::REST);
    for ms in [0, 40, 39, 40, 1500] {
        game.player(entity).set_time(Duration::from_millis(ms));
        game.frame(Duration::from_secs(60));
    }
    assert_eq!(game.take_log(), &GERMAN[..4], "a clock that jitters repeats nothing");
    game.player(entity).set_time(Duration::from_secs(9));
    game.frame(FRAME);
    assert_eq!(game.log(), ["(mara points fog)", "", "finished"]);
}

#[test]
fn a_jump_triggers_the_segment_at_its_end() {
    let (mut game, entity) = Game::act1(mara);
    game.frame(FRAME);
    game.take_log();
    game.player(entity).seek(Duration::from_millis(2500));
    game.frame(Duration::from_secs(1));
    assert_eq!(game.player(entity).time(), Duration::from_millis(2500), "lands exactly");
    game.player(entity).seek(Duration::ZERO);
    game.frame(FRAME);
    let back = ["(mara feels neutral)", "Guten Abend, Otto."];
    assert_eq!(game.take_log(), [&["und der Nebel ist zu früh."][..], &back].concat());

    game.player(entity).play(GOOD_EVENING);
    game.player(entity).seek(Duration::from_millis(2500));
    game.frame(FRAME);
    assert_eq!(game.log(), ["", "und der Nebel ist zu früh."]);
}

#[test]
fn segments_have_event_strings() {
    use crate::game::Log;
    use bevy::prelude::*;
    let (mut game, _) = Game::act1(mara);
    game.app.add_observer(|segment: On<LipzSegment>, mut log: ResMut<Log>| {
        log.0.push(format!("{} {}", segment.segment, segment.event));
    });
    game.frames(2, Duration::from_secs(60));
    let log = game.take_log();
    let order: Vec<_> = log.iter().filter(|entry| entry.starts_with(['0', '1', '2', '('])).collect();
    let expected = ["0 feels neutral", GERMAN[0], "1 sees otto", GERMAN[2], "2 points fog", GERMAN[4]];
    assert_eq!(order, expected);
}
