//! Playback: each event once, whatever the ticks; jumps, loops and ends; state, lead and hold.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Bank, CharacterState, Clip, Crossed, Fps, Hold, Lead, Micros, Playback, Samples, Seconds, Time};
use lipz_testkit::golden::{DRAMA, SMALL, verified};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::time::Duration;

/// Every clip of the golden banks, those of no frames and of no segments' frames among them.
fn clips<'bank>(banks: &'bank [Bank<'static>; 2]) -> Vec<Clip<'static, 'bank>> {
    banks.iter().flat_map(|bank| bank.clips()).map(|clip| clip.or_fps(Fps::whole(24))).collect()
}

fn playback<'bank>(bank: &'bank Bank<'static>, key: &str) -> Playback<'static, 'bank> {
    bank.clip_by_key(key).and_then(Playback::new).expect("a clip with a frame rate")
}

fn indices(crossed: Crossed<'_, '_>) -> Vec<u32> {
    let length = crossed.len();
    let indices: Vec<u32> = crossed.map(|segment| segment.index()).collect();
    assert_eq!(indices.len(), length);
    indices
}

fn events(crossed: Crossed<'_, '_>) -> Vec<String> {
    crossed.events().map(|event| event.to_string()).collect()
}

#[derive(Clone, Copy, Debug)]
enum Step {
    /// The sound is at this time, as one of the engine's clocks tells it.
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

/// Ticks in any order, as after jitter, in any unit.
fn tick(playback: &mut Playback<'_, '_>, time: i64, unit: u8) -> Vec<u32> {
    let unsigned = u64::try_from(time);
    indices(match (unit, unsigned) {
        (1, Ok(us)) => playback.advance_to(Duration::from_micros(us)),
        (2, _) => playback.advance_to(Samples { position: time, rate_hz: 1_000_000 }),
        (3, _) => playback.advance_to(Seconds(time as f64 / 1e6)),
        _ => playback.advance_to(Micros(time)),
    })
}

/// The segments that begin before `time`, or also in its frame: all of them, from the first on.
fn begun(clip: &Clip<'_, '_>, time: i64, with_its_frame: bool) -> u32 {
    let Ok(us) = u64::try_from(time) else { return 0 };
    let fps = clip.fps().expect("a frame rate");
    let frame = (us as u128 * u128::from(fps.numerator()) / (u128::from(fps.denominator()) * 1_000_000)) as u32;
    let frame = frame.min(clip.frame_count());
    let has_begun = |start| if with_its_frame { start <= frame } else { start < frame };
    clip.segments().filter(|segment| has_begun(segment.start_frame())).count() as u32
}

/// What the events of `segments` leave, by name.
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
    /// The promise: however the sound moves on, the same segments in the same order as in one pass.
    #[test]
    fn any_ticks_fire_what_one_pass_fires(times in prop::collection::vec((-9_000_i64..9_000_000, 0_u8..4), 0..40)) {
        let banks = [verified(SMALL), verified(DRAMA)];
        for clip in clips(&banks) {
            let mut by_ticks = Playback::new(clip).expect("a frame rate");
            let mut fired = Vec::new();
            for &(time, unit) in &times {
                fired.extend(tick(&mut by_ticks, time, unit));
            }
            fired.extend(indices(by_ticks.advance_to(Micros(i64::MAX))));
            prop_assert!(by_ticks.is_over());
            prop_assert!(fired.into_iter().eq(0..clip.segment_count()), "{}", clip.key());
            prop_assert_eq!(by_ticks.advance_to(Micros(i64::MAX)).count(), 0);
        }
    }

    /// Ticks, jumps, loops and ends against the table of docs/PLAYBACK.md, in plain words.
    #[test]
    fn jumps_do_what_the_page_says(steps in steps()) {
        let banks = [verified(SMALL), verified(DRAMA)];
        for clip in clips(&banks) {
            let mut playback = Playback::new(clip).expect("a frame rate");
            let count = clip.segment_count();
            let (mut next, mut has_looped) = (0, false);
            for &step in &steps {
                let (fired, expected): (Vec<u32>, Vec<u32>) = match step {
                    Step::Tick(time, unit) => {
                        let before = next;
                        next = next.max(begun(&clip, time, true));
                        (tick(&mut playback, time, unit), (before..next).collect())
                    }
                    Step::Seek(time) => {
                        playback.seek(Micros(time));
                        (next, has_looped) = (begun(&clip, time, false), false);
                        (Vec::new(), Vec::new())
                    }
                    Step::Loop(time) => {
                        let before = next;
                        (next, has_looped) = (begun(&clip, time, true), true);
                        (indices(playback.loop_to(Micros(time))), (before..count).chain(0..next).collect())
                    }
                    Step::Finish => {
                        let before = next;
                        next = count;
                        (indices(playback.finish()), (before..count).collect())
                    }
                };
                prop_assert_eq!(fired, expected, "{} {:?}", clip.key(), step);
                let all = clip.segments().map(|segment| segment.events());
                let round = all.clone().take(if has_looped { count as usize } else { 0 });
                let past = round.chain(all.take(next as usize)).flatten().map(|event| event.to_string());
                let expected = states(past);
                for (character, state) in playback.characters() {
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
    let mut playback = playback(&bank, "act2/empty-segments");
    assert_eq!(indices(playback.advance_to(Micros(-1))), [0_u32; 0]);
    assert_eq!(indices(playback.advance_to(Micros(0))), [0, 1]);
    assert_eq!(playback.segment().map(|segment| segment.index()), Some(1));
    assert_eq!(indices(playback.advance_to(Micros(33_333))), [0_u32; 0]);
    let strings: Vec<_> = playback.advance_to(Micros(33_334)).map(|segment| segment.event()).collect();
    assert_eq!(strings, [Some("middle"), Some("")]);
    assert!(!playback.is_over());
    let strings: Vec<_> = playback.advance_to(Micros(66_667)).map(|segment| segment.event()).collect();
    assert_eq!(strings, [Some("end")]);
    assert!(playback.is_over() && playback.segment().is_none() && playback.viseme().is_rest());
}

#[test]
fn without_frames_everything_happens_at_the_start() {
    let bank = verified(SMALL);
    let silent = bank.clip_by_key("act2/silent").expect("a clip");
    assert!(Playback::new(silent).is_none(), "no frame rate");
    let mut playback = Playback::new(silent.or_fps(Fps::whole(24))).expect("a frame rate");
    assert_eq!(indices(playback.advance_to(Seconds(f32::NAN))), [0_u32; 0], "not a time");
    assert!(!playback.is_over());
    assert_eq!(indices(playback.advance_to(Micros(0))), [0, 1]);
    assert!(playback.is_over());
}

#[test]
fn a_pause_fires_nothing_and_a_seek_to_the_same_place_fires_again() {
    let bank = verified(SMALL);
    let mut playback = playback(&bank, "act1/blair");
    let now = Micros(416_667); // segment 1 begins
    assert_eq!(indices(playback.advance_to(now)), [0, 1]);
    let shown = playback.viseme();
    assert_eq!((indices(playback.advance_to(now)), playback.viseme()), (vec![], shown));
    playback.seek(now);
    assert_eq!(indices(playback.advance_to(now)), [1]);
    playback.seek(Micros(458_334)); // the frame after
    assert_eq!(indices(playback.advance_to(Micros(460_000))), [0_u32; 0]);
}

#[test]
fn events_without_a_character_are_the_speakers() {
    let bank = verified(DRAMA);
    let (mara, otto) = (bank.event_name("mara").expect("a name"), bank.event_name("otto").expect("a name"));
    let mut plain = playback(&bank, "act1/otto-twenty-years");
    let mut playback = plain.with_speaker(Some(otto));
    let end = Micros(i64::MAX);
    assert_eq!(events(plain.advance_to(end)), ["feels sad", "stares parcel", "stops staring", "mara feels thinking"]);
    let named = ["otto feels sad", "otto stares parcel", "otto stops staring", "mara feels thinking"];
    assert_eq!(events(playback.advance_to(end)), named);
    assert_eq!(playback.state(None), playback.state(Some(otto)));
    assert_eq!(names(playback.state(None)), [Some("sad".into()), None, None]);
    let all: Vec<_> = playback.characters().map(|(name, _)| name).collect();
    assert_eq!(all, [Some(mara), Some(otto)]);
    let all: Vec<_> = plain.characters().map(|(name, _)| name).collect();
    assert_eq!(all, [None, Some(mara)]);
}

#[test]
fn state_is_rebuilt_by_a_jump_and_outlasts_a_round() {
    let bank = verified(DRAMA);
    let mut playback = playback(&bank, "act1/otto-twenty-years");
    let stares = |playback: &Playback<'_, '_>| names(playback.state(None))[1].clone();
    let start_us =
        |index| playback.clip().segment(index).and_then(|segment| segment.start_us()).expect("a time") as i64;
    let (stares_us, stops_us) = (start_us(1), start_us(2));
    playback.seek(Micros(stops_us - 1));
    assert_eq!(stares(&playback), Some("parcel".into()));
    playback.seek(Micros(stops_us));
    assert_eq!(stares(&playback), Some("parcel".into()), "what begins here has still to fire");
    assert_eq!(events(playback.advance_to(Micros(stops_us))), ["stops staring"]);
    assert_eq!(stares(&playback), None);
    playback.seek(Micros(stares_us - 1));
    assert_eq!(stares(&playback), None);
    let _ = playback.finish();
    let _ = playback.loop_to(Micros(-1));
    assert_eq!(names(playback.state(None))[0], Some("sad".into()), "what ended a round begins the next");
    playback.seek(Micros(-1));
    assert_eq!(names(playback.state(None))[0], None, "a jump forgets rounds");
}

/// Mouth, frame of the sound and number of segments that fire at `time`.
fn shown(clip: Clip<'_, '_>, lead: Lead, time: impl Time) -> (char, Option<u32>, usize) {
    let mut playback = Playback::new(clip).expect("a frame rate").with_lead(lead);
    let fired = playback.advance_to(time).count();
    (playback.viseme().to_char(), playback.frame(), fired)
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
    let shown = |hold: Hold| -> String {
        let playback = Playback::new(clip).expect("a frame rate").with_hold(hold);
        let frame = |at: i64| Micros((at * 1_000_000 + 23) / 24);
        let at = |at| {
            let mut playback = playback;
            let _ = playback.advance_to(frame(at));
            playback.viseme().to_char()
        };
        (0..18).map(at).collect()
    };
    assert_eq!(shown(Hold::NONE), "-AMOSWEFLUMAEO----");
    assert_eq!(shown(Hold::readable(fps)), "-MMOSWEFLUMMEO----");
    let rms = bank.clip_by_key("act1/rms").and_then(Playback::new).expect("a clip with a frame rate");
    let mut rms = rms.with_hold(Hold::frames(u8::MAX));
    let _ = rms.advance_to(Micros(160_000));
    assert_eq!(rms.viseme().to_char(), '1');
}
