//! Compares the player with the Lipz files.
#![allow(clippy::unwrap_used, reason = "tests")]

use dialogue_player::{BANK, Player, dialogue};
use lipz_bank::files::DialogueFile;
use lipz_bank::{ClipId, Dialogue, Micros};

/// 24 frames per second, rounded up so that each frame starts a rendered frame.
const FRAME_US: i64 = 41_667;

#[test]
fn a_clip_is_played_frame_by_frame() {
    let mut files = [DialogueFile::ABSENT; 1];
    let opened = Dialogue::open(&mut files, [BANK]).unwrap();
    let mut player = Player::new(opened, dialogue::locales::DE_DE).unwrap();
    assert!(player.is_over() && player.subtitle().is_empty(), "nothing was started");
    assert!(player.start(dialogue::act1::MARA_GOOD_EVENING) && !player.is_over());
    let (mut mouths, mut subtitles, mut events) = (String::new(), Vec::new(), Vec::new());
    for frame in 0.. {
        events.extend(player.advance_to(Micros(frame * FRAME_US)).map(|event| (frame, event.to_string())));
        if player.is_over() {
            break;
        }
        mouths.push(player.viseme().to_char());
        if subtitles.last().map(String::as_str) != Some(player.subtitle()) {
            subtitles.push(player.subtitle().to_owned());
        }
    }
    let shapes = "SOOOOSEEEFEESAASS---OOOSSSOO-------SOOUUUASSEELAAAS---AASSSSSSSEEFFOSSASEEASLLS-------------";
    assert_eq!(mouths, format!("{}-", &shapes[1..]), "each is a frame ahead of the sound");
    assert_eq!(subtitles, ["Guten Abend, Otto.", "Du bist spät dran,", "und der Nebel ist zu früh."]);
    let expected = [(0, "mara feels neutral"), (35, "mara sees otto"), (54, "mara points fog")];
    assert_eq!(events, expected.map(|(frame, event)| (frame, event.to_owned())));
    assert_eq!((player.viseme().to_char(), player.subtitle()), ('-', ""), "rest when the clip is over");
}

#[test]
fn no_event_is_lost_when_a_rendered_frame_takes_long() {
    let mut files = [DialogueFile::ABSENT; 1];
    let opened = Dialogue::open_unverified(&mut files, [BANK]).unwrap();
    let mut player = Player::new(opened, "en-us").unwrap();
    assert!(player.start(dialogue::act1::MARA_GOOD_EVENING));
    let mut events_at = |time_us| player.advance_to(Micros(time_us)).map(|event| event.to_string()).collect::<Vec<_>>();
    assert_eq!(events_at(60_000_000), ["mara feels neutral", "mara sees otto", "mara points fog"]);
    assert_eq!(events_at(60_000_000), [""; 0], "each comes once");
}

#[test]
fn every_constant_is_a_clip_of_the_bank() {
    let mut files = [DialogueFile::ABSENT; 1];
    let opened = Dialogue::open_unverified(&mut files, [BANK]).unwrap();
    assert_eq!(dialogue::act1::OTTO_AYE, ClipId::from_key("act1/otto-aye"));
    let mut player = Player::new(opened, dialogue::locales::JA_JP).unwrap();
    for id in [dialogue::act1::OTTO_AYE, dialogue::act1::MARA_GOOD_EVENING] {
        assert!(player.start(id));
    }
    assert!(!player.start(ClipId::from_key("act1/otto-ay")) && player.is_over());
    assert!(Player::new(opened, "fr-fr").is_none());
}
