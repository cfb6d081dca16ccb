//! Faces give the answers of the reader, in every unit of time, with every profile and direction.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{Answer, CURVES, SPECIALS, bank, ptr, text_of};
use lipz_bank::{CurveValue, Micros, Samples, Seconds};
use lipz_capi::*;

fn fields(face: lipz_bank::Face) -> [i32; 9] {
    let angles = [face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw];
    let [pitch, yaw, roll, eye_pitch, eye_yaw] = angles.map(CurveValue::thousandths);
    let [blink, brows, shrug, breath] = [face.blink, face.brows, face.shrug, face.breath].map(CurveValue::thousandths);
    [blink, pitch, yaw, roll, eye_pitch, eye_yaw, brows, shrug, breath]
}

fn fields_of_c(face: Face) -> [i32; 9] {
    let Face { blink, head_pitch, head_yaw, head_roll, eye_pitch, eye_yaw, brows, shrug, breath } = face;
    [blink, head_pitch, head_yaw, head_roll, eye_pitch, eye_yaw, brows, shrug, breath]
}

#[test]
fn faces_give_the_answers_of_the_reader() {
    let (expected, bank) = bank(CURVES);
    let bank = Some(&bank);
    let profile = Answer::<FaceProfile>::from_call(|out| unsafe { lipz_face_profile_default(bank, out) }).ok();
    assert_eq!((text_of(profile.name), profile.index), ("default", LIPZ_BUILT_IN));
    let own = expected.default_face_profile();
    let angle = CurveValue::from_thousandths;
    let directions = [
        (None, lipz_bank::LookAt::AHEAD),
        (
            Some(LookAt { pitch: -5000, yaw: 40_000, is_person: 1 }),
            lipz_bank::LookAt::person(angle(-5000), angle(40_000)),
        ),
        (Some(LookAt { pitch: 0, yaw: -90_000, is_person: 0 }), lipz_bank::LookAt::point(angle(0), angle(-90_000))),
    ];
    for clip in expected.clips() {
        let asked = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(bank, clip.id().get(), out) }).ok();
        let asked = Some(&asked);
        for (us, (c_look, look)) in (-50_000..9_000_000).step_by(133_333).zip(directions.iter().cycle()) {
            let (seconds, position, rate_hz) = (us as f64 / 1e6, us * 441 / 10_000, 44_100);
            let (look, to, with) = (*look, c_look.as_ref(), [None, Some(&profile)][us as usize & 1]);
            let answers = [
                (
                    Answer::<Face>::from_call(|out| unsafe { lipz_clip_face_at_us(bank, asked, with, to, us, out) }),
                    clip.face_at(Micros(us), &own, look),
                ),
                (
                    Answer::from_call(|out| unsafe {
                        lipz_clip_face_at_samples(bank, asked, with, to, position, rate_hz, out)
                    }),
                    clip.face_at(Samples { position, rate_hz }, &own, look),
                ),
                (
                    Answer::from_call(|out| unsafe { lipz_clip_face_at_seconds(bank, asked, with, to, seconds, out) }),
                    clip.face_at(Seconds(seconds), &own, look),
                ),
                (
                    Answer::from_call(|out| unsafe {
                        lipz_clip_face_at_seconds_f32(bank, asked, with, to, seconds as f32, out)
                    }),
                    clip.face_at(Seconds(seconds as f32), &own, look),
                ),
                (
                    Answer::from_call(|out| unsafe { lipz_face_idle_at_us(bank, with, to, 7, us, out) }),
                    own.idle_at(Micros(us), 7, look),
                ),
                (
                    Answer::from_call(|out| unsafe {
                        lipz_face_idle_at_samples(bank, with, to, 8, position, rate_hz, out)
                    }),
                    own.idle_at(Samples { position, rate_hz }, 8, look),
                ),
                (
                    Answer::from_call(|out| unsafe { lipz_face_idle_at_seconds(bank, with, to, 9, seconds, out) }),
                    own.idle_at(Seconds(seconds), 9, look),
                ),
                (
                    Answer::from_call(|out| unsafe {
                        lipz_face_idle_at_seconds_f32(bank, with, to, 9, seconds as f32, out)
                    }),
                    own.idle_at(Seconds(seconds as f32), 9, look),
                ),
            ];
            for (found, expected) in answers {
                assert_eq!(fields_of_c(found.ok()), fields(expected), "{us} us");
            }
        }
    }
}

#[test]
fn what_there_is_not_is_a_status() {
    let (_, bank) = bank(CURVES);
    let bank = Some(&bank);
    let (name, length) = ptr("robot");
    let none = Answer::<FaceProfile>::from_call(|out| unsafe { lipz_face_profile_by_name(bank, name, length, out) });
    assert_eq!(none.status, LIPZ_NONE);
    let other = FaceProfile { index: 0, ..FaceProfile::default() };
    let ask = |bank, profile| {
        Answer::<Face>::from_call(|out| unsafe { lipz_face_idle_at_us(bank, profile, None, 0, 0, out) })
    };
    assert_eq!(ask(bank, Some(&other)).status, LIPZ_NONE);
    assert_eq!(ask(None, None).status, LIPZ_NULL_POINTER);
}

/// Of others and of a speaker with a name, in every unit of time; the bank has `mara.nod` and `otto.joy`.
#[test]
fn faces_and_emotions_of_characters_are_those_of_the_reader() {
    let (expected, bank) = bank(SPECIALS);
    let bank = Some(&bank);
    let clip = expected.clip_by_key("listens").unwrap();
    let asked = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(bank, clip.id().get(), out) }).ok();
    let (asked, own, ahead) = (Some(&asked), expected.default_face_profile(), lipz_bank::LookAt::AHEAD);
    let mut different = 0;
    for (name, is_speaker) in [("mara", 0), ("otto", 0), ("otto", 1), ("nobody", 7), ("", 0)] {
        let (data, length_bytes) = ptr(name);
        let who = Some(&Who { name: String { data, length_bytes }, is_speaker });
        let of = if is_speaker == 0 { lipz_bank::Who::Other(name) } else { lipz_bank::Who::SpeakerNamed(name) };
        for us in (-50_000..6_000_000).step_by(133_333) {
            let (seconds, position, rate_hz) = (us as f64 / 1e6, us * 441 / 10_000, 44_100);
            let (short, samples) = (Seconds(seconds as f32), Samples { position, rate_hz });
            let faces = [
                Answer::<Face>::from_call(|out| unsafe { lipz_clip_face_of_us(bank, asked, who, None, None, us, out) }),
                Answer::from_call(|out| unsafe {
                    lipz_clip_face_of_samples(bank, asked, who, None, None, position, rate_hz, out)
                }),
                Answer::from_call(|out| unsafe {
                    lipz_clip_face_of_seconds(bank, asked, who, None, None, seconds, out)
                }),
                Answer::from_call(|out| unsafe {
                    lipz_clip_face_of_seconds_f32(bank, asked, who, None, None, short.0, out)
                }),
            ];
            let of_reader = [
                clip.face_of(of, Micros(us), &own, ahead),
                clip.face_of(of, samples, &own, ahead),
                clip.face_of(of, Seconds(seconds), &own, ahead),
                clip.face_of(of, short, &own, ahead),
            ];
            different += i32::from(of_reader[0] != clip.face_at(Micros(us), &own, ahead));
            assert_eq!(faces.map(|face| fields_of_c(face.ok())), of_reader.map(fields), "{name} {us} us");
            let sums = [
                Answer::<Emotions>::from_call(|out| unsafe { lipz_clip_emotions_of_us(bank, asked, who, us, out) }),
                Answer::from_call(|out| unsafe {
                    lipz_clip_emotions_of_samples(bank, asked, who, position, rate_hz, out)
                }),
                Answer::from_call(|out| unsafe { lipz_clip_emotions_of_seconds(bank, asked, who, seconds, out) }),
                Answer::from_call(|out| unsafe { lipz_clip_emotions_of_seconds_f32(bank, asked, who, short.0, out) }),
            ];
            let of_reader = [
                clip.emotions_of(of, Micros(us)),
                clip.emotions_of(of, samples),
                clip.emotions_of(of, Seconds(seconds)),
                clip.emotions_of(of, short),
            ];
            assert_eq!(sums.map(|found| found.ok().sum), of_reader.map(|found| found.sum().thousandths()));
        }
    }
    assert!(different > 100, "{different}");
    let nobody = Who::default();
    let null = Answer::<Face>::from_call(|out| unsafe {
        lipz_clip_face_of_us(bank, asked, Some(&nobody), None, None, 0, out)
    });
    assert_eq!(null.status, LIPZ_NULL_POINTER);
    let speaker =
        Answer::<Face>::from_call(|out| unsafe { lipz_clip_face_of_us(bank, asked, None, None, None, 700_000, out) });
    assert_eq!(fields_of_c(speaker.ok()), fields(clip.face_at(Micros(700_000), &own, ahead)), "null is the speaker");
}
