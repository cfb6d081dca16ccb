//! Playback: each event fires once, for any ticks; jumps, loops and ends; state, lead and hold.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::playback::{CharacterState, ConsonantHold, DueSegments, Lead};
use lipz_bank::{Bank, Clip, Cursor, Fps, Micros, Samples, Seconds, Time, VisemeType};
use lipz_testkit::golden::{DRAMA, SMALL, changed, put, verified};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::time::Duration;

/// Returns every clip of the golden banks, including clips without frames and clips with empty segments.
fn clips<'bank>(banks: &'bank [Bank<'static>; 2]) -> Vec<Clip<'bank>> {
    banks.iter().flat_map(Bank::clips).map(|clip| clip.or_fps(Fps::whole(24))).collect()
}

fn start(clip: &Clip<'_>) -> Cursor {
    Cursor::new(clip).expect("a frame rate")
}

/// Returns a clip, and a cursor at its start.
fn started<'bank>(bank: &'bank Bank<'static>, key: &str) -> (Clip<'bank>, Cursor) {
    let clip = bank.clip_by_key(key).expect("a clip");
    (clip, start(&clip))
}

fn indices(due: DueSegments<'_>) -> Vec<u32> {
    let length = due.len();
    let indices: Vec<u32> = due.map(|segment| segment.index()).collect();
    assert_eq!(indices.len(), length);
    indices
}

fn events(due: DueSegments<'_>) -> Vec<String> {
    due.events().map(|event| event.to_string()).collect()
}

#[derive(Clone, Copy, Debug)]
enum Step {
    /// The audio is at this time, in the unit of one of the engine's clocks.
    Tick(i64, u8),
    Seek(i64),
    Loop(i64),
    Finish,
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let time = || prop_oneof![-50_000_i64..500_000, -50_000_i64..15_000_000];
    let step = prop_oneof![
        8 => (time(), 0_u8..4).prop_map(|(time, unit)| Step::Tick(time, unit)),
        1 => time().prop_map(Step::Seek),
        1 => time().prop_map(Step::Loop),
        1 => Just(Step::Finish),
    ];
    prop::collection::vec(step, 1..30)
}

/// Applies a tick in any order, as with jitter, and in any unit.
fn tick(cursor: &mut Cursor, clip: &Clip<'_>, time: i64, unit: u8) -> Vec<u32> {
    let unsigned = u64::try_from(time);
    indices(match (unit, unsigned) {
        (1, Ok(us)) => cursor.advance_to(clip, Duration::from_micros(us)),
        (2, _) => cursor.advance_to(clip, Samples { position: time, rate_hz: 1_000_000 }),
        (3, _) => cursor.advance_to(clip, Seconds(time as f64 / 1e6)),
        _ => cursor.advance_to(clip, Micros(time)),
    })
}

/// Returns the number of segments that begin before `time`, optionally including those in its frame.
fn begun(clip: &Clip<'_>, time: i64, with_its_frame: bool) -> u32 {
    let Ok(us) = u64::try_from(time) else { return 0 };
    let fps = clip.fps().expect("a frame rate");
    let frame = (us as u128 * u128::from(fps.numerator()) / (u128::from(fps.denominator()) * 1_000_000)) as u32;
    let frame = frame.min(clip.frame_count());
    let has_begun = |start| if with_its_frame { start <= frame } else { start < frame };
    clip.segments().filter(|segment| has_begun(segment.start_frame())).count() as u32
}

/// Returns the state of each character after the events of `segments`, by name.
fn states(segments: impl Iterator<Item = String>) -> BTreeMap<String, [Option<String>; 3]> {
    let mut all: BTreeMap<String, [Option<String>; 3]> = BTreeMap::new();
    for event in segments {
        let words: Vec<&str> = event.split(' ').collect();
        let verb = words.iter().position(|word| ["feels", "stares", "points", "stops"].contains(word));
        let Some(verb) = verb else { continue };
        let state = all.entry(words[..verb].concat()).or_default();
        match words[verb..] {
            ["feels", object] => state[0] = Some(object.into()),
            ["stares", object] => state[1] = Some(object.into()),
            ["points", object] => state[2] = Some(object.into()),
            ["stops", "staring"] => state[1] = None,
            ["stops", "pointing"] => state[2] = None,
            _ => panic!("{event}"),
        }
    }
    all
}

fn names(state: CharacterState<'_>) -> [Option<String>; 3] {
    [state.emotion, state.stares_at, state.points_at].map(|name| name.map(|name| name.to_string()))
}

proptest! {
    /// The guarantee: any sequence of audio times fires the same segments in the same order as one pass.
    #[test]
    fn any_ticks_fire_what_one_pass_fires(times in prop::collection::vec((-9_000_i64..9_000_000, 0_u8..4), 0..40)) {
        let banks = [verified(SMALL), verified(DRAMA)];
        for clip in clips(&banks) {
            let mut by_ticks = start(&clip);
            let mut fired = Vec::new();
            for &(time, unit) in &times {
                fired.extend(tick(&mut by_ticks, &clip, time, unit));
            }
            fired.extend(indices(by_ticks.advance_to(&clip, Micros(i64::MAX))));
            prop_assert!(by_ticks.is_over());
            prop_assert!(fired.into_iter().eq(0..clip.segment_count()), "{}", clip.key());
            prop_assert_eq!(by_ticks.advance_to(&clip, Micros(i64::MAX)).count(), 0);
        }
    }

    /// Compares ticks, jumps, loops and ends with a simple implementation of the table in docs/guides/playback.md.
    #[test]
    fn jumps_do_what_the_page_says(steps in steps()) {
        let banks = [verified(SMALL), verified(DRAMA)];
        for clip in clips(&banks) {
            let mut cursor = start(&clip);
            let count = clip.segment_count();
            let (mut next, mut has_looped) = (0, false);
            for &step in &steps {
                let (fired, expected): (Vec<u32>, Vec<u32>) = match step {
                    Step::Tick(time, unit) => {
                        let before = next;
                        next = next.max(begun(&clip, time, true));
                        (tick(&mut cursor, &clip, time, unit), (before..next).collect())
                    }
                    Step::Seek(time) => {
                        cursor.seek(&clip, Micros(time));
                        (next, has_looped) = (begun(&clip, time, false), false);
                        (Vec::new(), Vec::new())
                    }
                    Step::Loop(time) => {
                        let before = next;
                        (next, has_looped) = (begun(&clip, time, true), true);
                        (indices(cursor.loop_to(&clip, Micros(time))), (before..count).chain(0..next).collect())
                    }
                    Step::Finish => {
                        let before = next;
                        next = count;
                        (indices(cursor.finish(&clip)), (before..count).collect())
                    }
                };
                prop_assert_eq!(fired, expected, "{} {:?}", clip.key(), step);
                prop_assert_eq!(start(&clip).with_words(cursor.to_words()), cursor);
                let all = clip.segments().map(|segment| segment.events());
                let round = all.clone().take(if has_looped { count as usize } else { 0 });
                let past = round.chain(all.take(next as usize)).flatten().map(|event| event.to_string());
                let expected = states(past);
                for (character, state) in cursor.characters(&clip) {
                    let name = character.map_or(String::new(), |name| name.to_string());
                    prop_assert_eq!(names(state), expected.get(&name).cloned().unwrap_or_default(), "{}", name);
                }
            }
        }
    }
}

#[test]
fn segments_of_no_frames_fire_in_their_place() {
    let bank = verified(SMALL);
    let (clip, mut cursor) = started(&bank, "act2/empty-segments");
    assert_eq!(indices(cursor.advance_to(&clip, Micros(-1))), [0_u32; 0]);
    assert_eq!(indices(cursor.advance_to(&clip, Micros(0))), [0, 1]);
    assert_eq!(cursor.segment(&clip).map(|segment| segment.index()), Some(1));
    assert_eq!(indices(cursor.advance_to(&clip, Micros(33_333))), [0_u32; 0]);
    let strings: Vec<_> = cursor.advance_to(&clip, Micros(33_334)).map(|segment| segment.event()).collect();
    assert_eq!(strings, [Some("middle"), Some("")]);
    assert!(!cursor.is_over());
    let strings: Vec<_> = cursor.advance_to(&clip, Micros(66_667)).map(|segment| segment.event()).collect();
    assert_eq!(strings, [Some("end")]);
    assert!(cursor.is_over() && cursor.segment(&clip).is_none() && cursor.viseme(&clip).is_rest());
}

#[test]
fn without_frames_everything_happens_at_the_start() {
    let bank = verified(SMALL);
    let clip = bank.clip_by_key("act2/silent").expect("a clip");
    assert!(Cursor::new(&clip).is_none(), "no frame rate");
    let mut cursor = start(&clip.or_fps(Fps::whole(24)));
    assert_eq!(indices(cursor.advance_to(&clip, Seconds(f32::NAN))), [0_u32; 0], "not a time");
    assert!(!cursor.is_over());
    assert_eq!(indices(cursor.advance_to(&clip, Micros(0))), [0, 1]);
    assert!(cursor.is_over());
}

#[test]
fn a_pause_fires_nothing_and_a_seek_to_the_same_place_fires_again() {
    let bank = verified(SMALL);
    let (clip, mut cursor) = started(&bank, "act1/blair");
    let now = Micros(416_667); // segment 1 begins
    assert_eq!(indices(cursor.advance_to(&clip, now)), [0, 1]);
    let shown = cursor.viseme(&clip);
    assert_eq!((indices(cursor.advance_to(&clip, now)), cursor.viseme(&clip)), (vec![], shown));
    cursor.seek(&clip, now);
    assert_eq!(indices(cursor.advance_to(&clip, now)), [1]);
    cursor.seek(&clip, Micros(458_334)); // the frame after
    assert_eq!(indices(cursor.advance_to(&clip, Micros(460_000))), [0_u32; 0]);
}

#[test]
fn events_without_a_character_are_the_speakers() {
    let bank = verified(DRAMA);
    let (mara, otto) = (bank.event_name("mara").expect("a name"), bank.event_name("otto").expect("a name"));
    let (clip, mut plain) = started(&bank, "act1/otto-twenty-years");
    let mut cursor = plain.with_speaker(Some(otto));
    let end = Micros(i64::MAX);
    assert_eq!(
        events(plain.advance_to(&clip, end)),
        ["feels sad", "stares parcel", "stops staring", "mara feels thinking"]
    );
    let named = ["otto feels sad", "otto stares parcel", "otto stops staring", "mara feels thinking"];
    assert_eq!(events(cursor.advance_to(&clip, end)), named);
    assert_eq!(cursor.state(&clip, None), cursor.state(&clip, Some(otto)));
    assert_eq!(names(cursor.state(&clip, None)), [Some("sad".into()), None, None]);
    let all: Vec<_> = cursor.characters(&clip).map(|(name, _)| name).collect();
    assert_eq!(all, [Some(mara), Some(otto)]);
    let all: Vec<_> = plain.characters(&clip).map(|(name, _)| name).collect();
    assert_eq!(all, [None, Some(mara)]);
}

#[test]
fn state_is_rebuilt_by_a_jump_and_outlasts_a_round() {
    let bank = verified(DRAMA);
    let (clip, mut cursor) = started(&bank, "act1/otto-twenty-years");
    let stares = |cursor: &Cursor| names(cursor.state(&clip, None))[1].clone();
    let start_us = |index| clip.segment(index).and_then(|segment| segment.start_us()).expect("a time") as i64;
    let (stares_us, stops_us) = (start_us(1), start_us(2));
    cursor.seek(&clip, Micros(stops_us - 1));
    assert_eq!(stares(&cursor), Some("parcel".into()));
    cursor.seek(&clip, Micros(stops_us));
    assert_eq!(stares(&cursor), Some("parcel".into()), "what begins here has still to fire");
    assert_eq!(events(cursor.advance_to(&clip, Micros(stops_us))), ["stops staring"]);
    assert_eq!(stares(&cursor), None);
    cursor.seek(&clip, Micros(stares_us - 1));
    assert_eq!(stares(&cursor), None);
    let _ = cursor.finish(&clip);
    let _ = cursor.loop_to(&clip, Micros(-1));
    assert_eq!(names(cursor.state(&clip, None))[0], Some("sad".into()), "what ended a round begins the next");
    cursor.seek(&clip, Micros(-1));
    assert_eq!(names(cursor.state(&clip, None))[0], None, "a jump forgets rounds");
}

/// Returns the viseme, the frame of the audio and the number of segments that fire at `time`.
fn shown(clip: Clip<'_>, lead: Lead, time: impl Time) -> (char, Option<u32>, usize) {
    let mut cursor = start(&clip).with_lead(lead);
    let fired = cursor.advance_to(&clip, time).count();
    (cursor.viseme(&clip).to_char(), cursor.frame(), fired)
}

#[test]
fn the_mouth_leads_and_the_rest_follows_the_sound() {
    let bank = verified(SMALL);
    let clip = bank.clip_by_key("act1/blair").expect("a clip"); // -AMOSWEFLUMAEO---, 24 fps
    let fps = clip.fps().expect("a frame rate");
    assert_eq!(shown(clip, Lead::NONE, Micros(41_667)), ('A', Some(1), 1));
    assert_eq!(shown(clip, Lead::one_frame(fps), Micros(41_667)), ('M', Some(1), 1));
    assert_eq!(shown(clip, Lead::two_frames(fps), Micros(41_667)), ('O', Some(1), 1));
    assert_eq!(shown(clip, Lead::micros(41_667), Micros(-1)), ('-', None, 0), "a hair too early");
    assert_eq!(shown(clip, Lead::two_frames(fps), Micros(-41_666)), ('A', None, 0), "shapes begin before the sound");
    for rate_hz in [8_000, 44_100, 48_000] {
        for frame in 0..17_i64 {
            let position = (frame * i64::from(rate_hz) + 23) / 24; // the first sample of the frame
            let expected = clip.viseme(frame as u32 + 1).to_char();
            assert_eq!(
                shown(clip, Lead::one_frame(fps), Samples { position, rate_hz }).0,
                expected,
                "{frame} {rate_hz}"
            );
            assert_eq!(shown(clip, Lead::one_frame(fps), Seconds(frame as f64 / 24.0)).0, expected, "{frame}");
            assert_eq!(shown(clip, Lead::one_frame(fps), Seconds(frame as f32 / 24.0)).0, expected, "{frame}");
        }
    }
}

#[test]
fn a_held_consonant_reaches_slow_displays() {
    let bank = verified(SMALL);
    let clip = bank.clip_by_key("act1/blair").expect("a clip"); // -AMOSWEFLUMAEO---
    let fps = clip.fps().expect("a frame rate");
    let shown = |hold: ConsonantHold| -> String {
        let cursor = start(&clip).with_hold(hold);
        let frame = |at: i64| Micros((at * 1_000_000 + 23) / 24);
        let at = |at| {
            let mut cursor = cursor;
            let _ = cursor.advance_to(&clip, frame(at));
            cursor.viseme(&clip).to_char()
        };
        (0..18).map(at).collect()
    };
    assert_eq!(shown(ConsonantHold::NONE), "-AMOSWEFLUMAEO----");
    assert_eq!(shown(ConsonantHold::readable(fps)), "-MMOSWEFLUMMEO----");
    let (clip, rms) = started(&bank, "act1/rms");
    let mut rms = rms.with_hold(ConsonantHold::frames(u8::MAX));
    let _ = rms.advance_to(&clip, Micros(160_000));
    assert_eq!(rms.viseme(&clip).to_char(), '1');
}

/// A clip that is looked up again has lost the frame rate and the viseme type that were set on it.
#[test]
fn a_cursor_remembers_what_its_clip_was_given() {
    let bank = verified(SMALL);
    let clip = bank.clip_by_key("act2/unspecified").expect("a clip"); // -A-M
    let given = clip.or_fps(Fps::whole(10)).or_viseme_type(VisemeType::Blair);
    let mut cursor = start(&given).with_hold(ConsonantHold::frames(2));
    let shown = |cursor: &mut Cursor, clip: &Clip<'_>| -> String {
        cursor.seek(clip, Micros(0));
        let at = |at| {
            let _ = cursor.advance_to(clip, Micros(i64::from(at) * 100_000));
            cursor.viseme(clip).to_char()
        };
        (0..5).map(at).collect()
    };
    let expected = shown(&mut cursor, &given);
    assert_eq!(shown(&mut cursor, &clip), expected);
    assert!(cursor.is_over());
    // The clip's own values take precedence.
    let faster = clip.or_fps(Fps::whole(20));
    cursor.seek(&faster, Micros(50_000));
    assert_eq!(cursor.frame(), Some(1));
}

/// Returns a bank with different ids of events, as a new version may have.
fn other_version() -> Vec<u8> {
    changed(DRAMA, |bank| put(bank, 22, [9, 0])) // a newer minor version, and so a bank with different bytes
}

/// A game keeps its cursor when the bank is replaced.
#[test]
fn a_cursor_goes_on_with_a_new_version_of_its_clip() {
    let (bank, newer) = (verified(DRAMA), other_version());
    let newer = Bank::open(&newer).and_then(Bank::verify).expect("a bank");
    let (clip, cursor) = started(&bank, "act1/otto-twenty-years");
    let mut cursor = cursor.with_speaker(bank.event_name("otto"));
    let start_us = clip.segment(1).and_then(|segment| segment.start_us()).expect("a time") as i64;
    assert_eq!(events(cursor.advance_to(&clip, Micros(start_us - 1))), ["otto feels sad"]);
    let clip = newer.clip(clip.id()).expect("the clip");
    assert_eq!(
        events(cursor.advance_to(&clip, Micros(start_us))),
        ["stares parcel"],
        "a name of a different bank is not valid"
    );
    cursor = cursor.with_speaker(newer.event_name("otto"));
    let rest = events(cursor.finish(&clip));
    assert_eq!(rest, ["otto stops staring", "mara feels thinking"]);
}

proptest! {
    /// Using the cursor of any clip with any other never panics, and at most the clip's segments are due.
    #[test]
    fn a_cursor_of_another_clip_is_harmless(steps in steps(), first in 0_usize..40, each in 1_usize..40) {
        let newer = other_version();
        let banks = [verified(SMALL), verified(DRAMA)];
        let third = Bank::open(&newer).and_then(Bank::verify).expect("a bank");
        let clips: Vec<Clip<'_>> = clips(&banks).into_iter().chain(third.clips()).collect();
        let fast = ConsonantHold::frames(9);
        let start = start(&clips[first % clips.len()]).with_speaker(banks[1].event_name("otto")).with_hold(fast);
        let mut cursor = start;
        for (at, &step) in steps.iter().enumerate() {
            let clip = clips[(first + at * each) % clips.len()];
            let due = match step {
                Step::Tick(time, _) => cursor.advance_to(&clip, Micros(time)),
                Step::Seek(time) => {
                    cursor.seek(&clip, Micros(time));
                    cursor.advance_to(&clip, Micros(time))
                }
                Step::Loop(time) => cursor.loop_to(&clip, Micros(time)),
                Step::Finish => cursor.finish(&clip),
            };
            prop_assert!(indices(due).len() <= 2 * clip.segment_count() as usize);
            // Query the next clip before the cursor moves in it.
            let next = clips[(first + (at + 1) * each) % clips.len()];
            prop_assert!(cursor.segment(&next).map_or(true, |segment| segment.index() < next.segment_count()));
            prop_assert!(cursor.characters(&next).count() <= 10);
            let _ = (cursor.viseme(&next), cursor.frame(), cursor.state(&next, None));
        }
    }
}
