//! Spontaneous movements of faces: blinks and gaze in a thousand clips, and profiles of a project.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotion, Face, FaceProfile, LookAt, Who};
use lipz_bank::{Bank, Clip, ErrorKind, Micros, Seconds, Time};
use lipz_compiler::face::{SETTINGS, numbers};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input};
use lipz_layout::{FaceRecord, Tag};
use lipz_testkit::golden::{changed, section};
use std::ops::Range;

/// The length of the clips, and their number.
const SECONDS: u32 = 12;
const COUNT: u32 = 1000;

fn compile(settings: &str, inputs: &[Input]) -> Vec<u8> {
    let settings = Settings::parse(settings, "lipz.toml", "").unwrap();
    Compiler::new(settings.options).compile(inputs).into_bank().unwrap()
}

/// Returns clips at one frame per second, with these emotions in their only segment.
fn clips(emotions: &str) -> Vec<u8> {
    let frames = "A".repeat(SECONDS as usize);
    let file =
        format!(r#"{{ "fps": 1, "visemes": "{frames}", "text_en-us": "{emotions} Well.", "viseme_type": "blair" }}"#);
    let inputs: Vec<Input> = (0..COUNT).map(|number| Input::from_bytes(format!("c{number}"), &*file)).collect();
    compile("default-locale = \"en-us\"\nemotions.over = 0\n", &inputs)
}

fn face(clip: &Clip<'_>, time: impl Time) -> Face {
    clip.face_at(time, Who::Speaker, &FaceProfile::DEFAULT, LookAt::AHEAD)
}

/// Counts the blinks in all clips. Returns seconds per blink, and the share of double ones.
fn blinks(bank: &Bank<'_>) -> (f64, f64) {
    let (mut count, mut double) = (0_u32, 0_u32);
    let length_ms = i64::from(FaceProfile::DEFAULT.blink_length_ms());
    for clip in bank.clips() {
        let mut last = None;
        let mut is_closed = false;
        for ms in (0..i64::from(SECONDS) * 1000).step_by(40) {
            let closes = face(&clip, Micros(ms * 1000)).blink.thousandths() == 1000;
            if closes && !is_closed {
                // The second of two blinks.
                if last.is_some_and(|last| ms - last < 2 * length_ms) {
                    double += 1;
                } else {
                    count += 1;
                }
                last = Some(ms);
            }
            is_closed = closes;
        }
    }
    (f64::from(SECONDS * COUNT) / f64::from(count), f64::from(double) / f64::from(count))
}

fn is_near(value: f64, stated: f64) -> bool {
    (value / stated - 1.0).abs() < 0.05
}

#[test]
fn blinks_come_in_the_stated_intervals() {
    for (emotions, stated) in
        [("", 4.0), ("{anger 4, joy 2}", 6.0), ("{fear 3, anger 1}", 2.0), ("{suspicious 3}", 2.0)]
    {
        let bytes = clips(emotions);
        let (seconds, double) = blinks(&Bank::open(&bytes).unwrap().verify().unwrap());
        assert!(is_near(seconds, stated), "{emotions}: a blink in {seconds} seconds, not in {stated}");
        // 2,000 to 6,000 blinks, so that the standard deviation is at most 0.7 % of all.
        assert!((0.085..0.115).contains(&double), "{emotions}: {double} of them are double");
    }
}

#[test]
fn eyes_are_on_eyes_and_mouth_for_four_fifths_of_the_time() {
    let bytes = clips("");
    let bank = Bank::open(&bytes).unwrap();
    let (mut on_face, mut all) = (0_u32, 0_u32);
    for clip in bank.clips() {
        for ms in (0..i64::from(SECONDS) * 1000).step_by(90) {
            all += 1;
            on_face += u32::from(face(&clip, Micros(ms * 1000)).eye_pitch.thousandths() >= -4000);
        }
    }
    let share = f64::from(on_face) / f64::from(all);
    assert!(is_near(share, 0.8), "{share}");
}

/// The head moves during mouth movement, but not far, and rests a quarter of a second away from it.
#[test]
fn a_head_moves_while_its_mouth_does() {
    let file = r#"{ "fps": 20, "visemes": "--------------------AAAAAAAAAAAAAAAAAAAA--------------------", "viseme_type": "blair" }"#;
    let bytes = compile("", &[Input::from_bytes("talk", file)]);
    let bank = Bank::open(&bytes).unwrap();
    let clip = bank.clip_by_key("talk").unwrap();
    let turned = |ms: Range<i64>| -> i32 {
        let face = |ms: i64| face(&clip, Micros(ms * 1000));
        let most = |face: Face| [face.head_pitch, face.head_yaw, face.head_roll].map(CurveValue::thousandths);
        ms.flat_map(|ms| most(face(ms))).map(i32::abs).max().unwrap()
    };
    assert_eq!((turned(0..750), turned(2250..3500)), (0, 0));
    assert!((1..=3000).contains(&turned(750..1000)) && (500..=3000).contains(&turned(1000..2000)));
    // No jumps: less than half a degree in ten milliseconds.
    for ms in 0..3000 {
        let [now, next] = [ms, ms + 10].map(|ms| face(&clip, Micros(ms * 1000)).head_yaw.thousandths());
        assert!(now.abs_diff(next) < 500, "{ms}: {now} {next}");
    }
}

/// A head turns to a different pose at the start of a segment or a pause, the only word boundaries in a bank.
#[test]
fn a_head_turns_with_segments_and_pauses() {
    let [first, second, third, rest] = [13, 13, 18, 35].map(|count| "A".repeat(count));
    let file = format!(r#"{{ "fps": 20, "visemes": "{first}|{second}|{third}-{rest}", "viseme_type": "blair" }}"#);
    let bytes = compile("face.pose = 0.9\n", &[Input::from_bytes("talk", file)]);
    let bank = Bank::open(&bytes).unwrap();
    let (clip, profile) = (bank.clip_by_key("talk").unwrap(), bank.default_face_profile());
    let yaw = |ms: i64| clip.face_at(Micros(ms * 1000), Who::Speaker, &profile, LookAt::AHEAD).head_yaw.thousandths();
    // Slots of 0.9 seconds: segments start at 0.65 and 1.3 seconds, a pause at 2.2. A step takes 0.45.
    for still in [0..650, 1100..1300, 1750..2200] {
        let poses: Vec<i32> = still.clone().map(yaw).collect();
        assert!(poses.iter().all(|pose| *pose == poses[0]), "{still:?}: {poses:?}");
        assert_ne!(yaw(still.end + 60), poses[0], "{still:?}");
    }
}

/// With the curve `pose`, a head turns at its keys, to the pose it would have held, by the amount of the key.
#[test]
fn a_head_turns_at_the_keys_of_poses() {
    let mouth = "A".repeat(80);
    let file = format!(
        r#"{{ "fps": 20, "visemes": "{mouth}", "viseme_type": "blair", "curves": {{ "pose": "10:1 30:1 32:0 60:0.5" }} }}"#
    );
    let bytes = compile("", &[Input::from_bytes("talk", file)]);
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("talk").unwrap();
    let poses = |ms: i64| {
        let face = face(&clip, Micros(ms * 1000));
        [face.head_pitch, face.head_yaw, face.head_roll].map(CurveValue::thousandths)
    };
    // Before the first key, the pose is that at the key. A turn takes 0.2 seconds, or the time until the next key.
    for still in [0..1500, 1800..3000, 3200..3900] {
        assert!(still.clone().all(|ms| poses(ms) == poses(still.start)), "{still:?}");
    }
    assert_ne!(poses(1499), poses(1550));
    assert_eq!(poses(2000), [0, 0, 0], "straight ahead");
    let half = FaceProfile::DEFAULT.head_motion_thousandths() / 2;
    assert!(poses(3500) != [0; 3] && poses(3500).iter().all(|angle| angle.unsigned_abs() <= u32::from(half)));
    for ms in 0..3900 {
        let far = poses(ms).iter().zip(poses(ms + 5)).map(|(now, then)| now.abs_diff(then)).max().unwrap();
        assert!(far < 1000, "{ms}: a jump of {far}");
    }
    assert_eq!(face(&clip, Micros(2_000_000)), face(&clip, Seconds(2.0)));
}

#[test]
fn curves_win_and_gestures_are_added() {
    let file = r#"{ "fps": 10, "visemes": "AAAAAAAAAA", "viseme_type": "blair", "curves": {
        "blink": "0:0.25", "lids": "0:0 5:0.5", "headYaw": "0:-8", "shake": "0:5 5:6.5", "eyeYaw": "0:10", "lookYaw": "0:0 5:15",
        "eyePitch": "0:0", "headPitch": "0:1", "nod": "0:4", "headRoll": "0:-2", "brows": "0:0.3", "shrug": "0:0.1", "breath": "0:6" } }"#;
    let bytes = compile("", &[Input::from_bytes("made", file)]);
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("made").unwrap();
    let shown = |time: f64| {
        let face = face(&clip, Seconds(time));
        let angles = [face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw];
        (face.blink.to_string(), angles.map(|angle| angle.to_string()).join(" "))
    };
    assert_eq!(shown(0.0), ("0.25".to_owned(), "-1 -8 -2 0 10".to_owned()));
    // The eyes turn by 20 of 25 degrees, the head by 5; a shake of 1.5 is 3 degrees more.
    assert_eq!(shown(0.5), ("0.5".to_owned(), "-1 0 -2 0 20".to_owned()));
    let face = face(&clip, Micros(0));
    assert_eq!([face.brows, face.shrug, face.breath].map(CurveValue::thousandths), [300, 100, 6000]);
}

/// The same time produces the same face, in any unit and in any order of calls.
#[test]
fn a_face_depends_on_nothing_but_its_time() {
    let bytes = clips("{anger 4}");
    let bank = Bank::open(&bytes).unwrap();
    let clip = bank.clip_by_key("c7").unwrap();
    let forwards: Vec<Face> = (0..1200).map(|cs| face(&clip, Micros(cs * 10_000))).collect();
    let backwards: Vec<Face> = (0..1200).rev().map(|cs| face(&clip, Seconds(cs as f64 / 100.0))).collect();
    assert!(forwards.iter().eq(backwards.iter().rev()));
    assert_ne!(forwards[0], forwards[1000]);
    let other = bank.clip_by_key("c8").unwrap();
    assert!((0..1200).zip(&forwards).any(|(cs, own)| face(&other, Micros(cs * 10_000)).blink != own.blink));
    let idle = |seed| FaceProfile::DEFAULT.idle_at(Seconds(3.0_f32), seed, LookAt::AHEAD);
    assert_eq!(idle(7), idle(7));
    assert!((0..100).any(|seed| idle(seed) != idle(7)));
    // Before the start, the face is that at the start.
    assert_eq!(face(&clip, Micros(-1)), face(&clip, Micros(0)));
}

#[test]
fn a_named_profile_takes_from_the_projects_own_and_that_from_the_usual() {
    let hello = || [Input::from_bytes("hello", r#"{ "text_en-us": "Hello." }"#)];
    let bytes =
        compile("[face]\nblink = 5\nhead = 1.5\n[face.robot]\nblink = 0\nblink-anger = 2.5\nglances = 0\n", &hello());
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    assert!(bank.face_profiles().map(|profile| profile.name()).eq(["default", "robot"]));
    let (own, robot) = (bank.default_face_profile(), bank.face_profile("robot").unwrap());
    let intervals =
        |profile: FaceProfile<'_>| [None, Some(Emotion::Anger)].map(|leads| profile.blink_interval_ms(leads));
    assert_eq!((intervals(own), intervals(robot)), ([5000, 7500], [0, 2500]));
    assert_eq!(robot.blink_interval_ms(Some(Emotion::Fear)), 0, "fear does not add blinks to a face without any");
    assert_eq!((own.head_motion_thousandths(), robot.head_motion_thousandths()), (1500, 1500));
    assert_eq!((own.glance_percent(), robot.glance_percent()), (20, 0));
    assert_eq!(bank.face_profile("rob"), None);
    let plain = compile("", &hello());
    assert_eq!(compile("[face]\n", &hello()), plain, "without settings, a bank is unchanged");
    assert_eq!(Bank::open(&plain).unwrap().default_face_profile(), FaceProfile::DEFAULT);
    assert_eq!(
        Bank::open(&compile("[face]\nblink = 4\n", &hello())).unwrap().default_face_profile(),
        FaceProfile::DEFAULT
    );
}

#[test]
fn what_settings_refuse_verify_refuses_and_nothing_else() {
    let hello = [Input::from_bytes("hello", r#"{ "text_en-us": "Hello." }"#)];
    let whole = compile("[face]\nblink = 4\n", &hello);
    let start = section(&whole, Tag::FACES).start;
    // The offsets of settings in the record, and their lengths in bytes.
    let places = (0..14).map(|number| (2 * number, 2)).chain([(28, 1), (29, 1), (30, 2), (32, 2), (34, 2), (36, 2)]);
    let profile = Bank::open(&whole).unwrap().default_face_profile();
    for ((setting, (at, bytes)), usual) in SETTINGS.into_iter().zip(places).zip(numbers(&profile)) {
        for number in [
            0,
            1,
            39,
            40,
            99,
            100,
            101,
            199,
            200,
            255,
            400,
            401,
            999,
            1000,
            30_000,
            30_001,
            60_000,
            60_001,
            u16::MAX,
            usual,
        ] {
            if bytes == 1 && number > 255 {
                continue;
            }
            let bank = changed(&whole, |bank| {
                bank[start + at..start + at + bytes].copy_from_slice(&number.to_le_bytes()[..bytes]);
            });
            let result = Bank::open(&bank).unwrap().verify().map(|bank| numbers(&bank.default_face_profile()));
            assert_eq!(result.is_ok(), setting.allows(number), "{} {number}", setting.name);
            match result {
                Ok(found) => assert!(found.contains(&number)),
                Err(error) => assert_eq!(error.kind(), ErrorKind::Face),
            }
        }
    }
    assert_eq!(section(&whole, Tag::FACES).len(), size_of::<FaceRecord>() + "default".len());
}

/// Changes every byte of the section to many values. Even before `verify`, no query panics.
#[test]
fn every_change_is_found_or_valid() {
    let hello = [Input::from_bytes("hello", r#"{ "fps": 24, "visemes": "AA" }"#)];
    let whole = compile("face.a = { head = 0 }\nface.b.blink = 9\n", &hello);
    let mut refused = 0;
    for at in section(&whole, Tag::FACES) {
        for value in (0..=u8::MAX).step_by(5) {
            let bytes = changed(&whole, |bank| bank[at] = value);
            let bank = Bank::open(&bytes).unwrap();
            let clip = bank.clip_by_key("hello").unwrap();
            for profile in bank.face_profiles().chain([bank.default_face_profile()]) {
                for time in [0, 40_000, 3_999_999, i64::MAX] {
                    clip.face_at(Micros(time), Who::Speaker, &profile, LookAt::AHEAD);
                }
                profile.name();
            }
            match bank.verify() {
                Ok(bank) => assert_eq!(bank.face_profiles().count(), 2),
                Err(error) => {
                    assert_eq!(error.kind(), ErrorKind::Face);
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 500, "{refused}");
}
