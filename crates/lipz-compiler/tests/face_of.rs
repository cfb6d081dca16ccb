//! Faces of listeners, and of a speaker whose events name them.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotion, Face, FaceProfile, LookAt, Who};
use lipz_bank::{Bank, Clip, Micros};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input};

/// Sixty frames, three seconds.
const VISEMES: &str = "MAEOMAEOMAEOMAEOMAEO|MAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEO";

fn compile(settings: &str, inputs: &[Input]) -> Vec<u8> {
    let settings = Settings::parse(settings, "lipz.toml", "").unwrap();
    Compiler::new(settings.options).compile(inputs).into_bank().unwrap()
}

fn with_events(events: &str) -> Vec<u8> {
    let file = format!(r#"{{ "fps": 20, "visemes": "{VISEMES}", "events": "{events}" }}"#);
    compile("", &[Input::from_bytes("line", file)])
}

/// Returns the faces of three seconds, and one more.
fn faces<'n>(clip: &Clip<'_>, who: impl Into<Who<'n>> + Copy) -> Vec<Face> {
    let at = |ms: i64| clip.face_at(Micros(ms * 1000), who, &FaceProfile::DEFAULT, LookAt::AHEAD);
    (-100..4000).step_by(7).map(at).collect()
}

#[test]
fn who_listens_moves_by_their_own_curves_only() {
    let bytes = with_events("feels joy 4, shakes, mara nods 6|mara feels fear 5, mara looks away, mara blinks");
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("line").unwrap();
    let mara = |ms: i64| clip.face_at(Micros(ms * 1000), "mara", &FaceProfile::DEFAULT, LookAt::AHEAD);
    let nod = clip.curve("mara.nod").unwrap();
    for ms in (0..1000).step_by(10) {
        let pitch = 2 * (nod.value_at(Micros(ms * 1000)).unwrap().thousandths() - 5000);
        assert_eq!(
            [mara(ms).head_pitch, mara(ms).head_yaw, mara(ms).head_roll].map(CurveValue::thousandths),
            [pitch, 0, 0]
        );
    }
    assert!((1000..1400).any(|ms| mara(ms).blink.thousandths() == 1000), "she blinks");
    assert!(mara(1600).head_yaw.thousandths() > 3000, "she looks away");
    assert_eq!(clip.emotions_at(Micros(2_500_000), "mara").strongest().map(|(leads, _)| leads), Some(Emotion::Fear));
    assert_ne!(faces(&clip, "mara"), faces(&clip, "otto"), "each has their own blinks and gaze");
    // A part of a name is a different name.
    assert!(faces(&clip, "mar").iter().all(|face| face.head_pitch.thousandths() == 0));
}

/// `mara feels fear` in her own line means `feels fear` for a program that names her as the speaker.
#[test]
fn a_speaker_with_a_name_is_the_speaker() {
    let named = with_events("mara feels joy 4, mara nods 6, mara blinks|mara feels fear 5 + anger 2, mara looks away");
    let without = with_events("feels joy 4, nods 6, blinks|feels fear 5 + anger 2, looks away");
    let banks = [&named, &without].map(|bytes| Bank::open(bytes).unwrap().verify().unwrap());
    let [named, without] = [0, 1].map(|bank: usize| banks[bank].clip_by_key("line").unwrap());
    let expected = faces(&without, Who::Speaker);
    assert_eq!(faces(&named, Who::SpeakerNamed("mara")), expected);
    assert_eq!(faces(&without, Who::SpeakerNamed("mara")), expected);
    assert_ne!(faces(&named, Who::Speaker), expected);
    for ms in (0..3500).step_by(13) {
        let now = Micros(ms * 1000);
        assert_eq!(named.emotions_at(now, Who::SpeakerNamed("mara")), without.emotions_at(now, Who::Speaker));
        assert_eq!(named.emotions_at(now, Who::Speaker).sum().thousandths(), 0);
    }
}

/// Curves are sorted by name: `mara.pose` comes before `pose`, `zoe.pose` after it.
#[test]
fn of_two_curves_of_poses_that_of_the_name_counts() {
    for name in ["mara", "zoe"] {
        let curves = |curves: String| {
            let file =
                format!(r#"{{ "fps": 20, "visemes": "{VISEMES}", "viseme_type": "blair", "curves": {{ {curves} }} }}"#);
            compile("", &[Input::from_bytes("line", file)])
        };
        let own = curves(format!(r#""{name}.pose": "0:0""#));
        let both = curves(format!(r#""{name}.pose": "0:0", "pose": "0:1 10:1 20:1 30:1""#));
        let [own, both] = [&own, &both].map(|bytes| Bank::open(bytes).unwrap().verify().unwrap());
        let [own, both] = [&own, &both].map(|bank| bank.clip_by_key("line").unwrap());
        let who = Who::SpeakerNamed(name);
        assert_eq!(faces(&both, who), faces(&own, who));
        assert_ne!(faces(&both, Who::Speaker), faces(&own, who));
        let made = |clip: &Clip<'_>, ms: i64| {
            clip.face_at(Micros(ms * 1000), who, &FaceProfile::DEFAULT.without_curves(), LookAt::AHEAD)
        };
        for ms in (0..4000).step_by(7) {
            assert_eq!(made(&both, ms), made(&own, ms));
            assert_eq!(made(&both, ms).head_yaw.thousandths(), 0, "it stays ahead");
        }
    }
}

#[test]
fn of_two_curves_for_the_same_the_one_farther_from_neutral_counts() {
    let bytes = with_events("feels joy 4 over 0s, nods 2|mara feels joy 2 + fear 3 over 0s, mara nods 8");
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("line").unwrap();
    let speaker = Who::SpeakerNamed("mara");
    let of = |emotion| clip.emotions_at(Micros(2_000_000), speaker).get(emotion).thousandths();
    assert_eq!([Emotion::Joy, Emotion::Fear].map(of), [4000, 3000]);
    let pitch = |who: Who<'_>, ms: i64| {
        let profile = FaceProfile::DEFAULT;
        clip.face_at(Micros(ms * 1000), who, &profile, LookAt::AHEAD).head_pitch.thousandths()
    };
    // Both nods are visible: 2 degrees for 1, the lower one half below 5, and none of her own during the other.
    let lowest = |from: i64| (from..from + 600).map(|ms| pitch(speaker, ms) - pitch(Who::Speaker, ms)).min().unwrap();
    assert_eq!((lowest(0), lowest(1000)), (0, -8000));
}

/// In clips of a different speaker, a listener blinks according to their own emotions, in the same intervals as a
/// speaker.
#[test]
fn listeners_blink_in_the_stated_intervals() {
    let file =
        r#"{ "fps": 1, "visemes": "AAAAAAAAAAAA", "events": "feels anger 5 over 0s, mara feels fear 5 over 0s" }"#;
    let inputs: Vec<Input> = (0..1000).map(|number| Input::from_bytes(format!("c{number}"), file)).collect();
    let bytes = compile("face.double-blinks = 0\n", &inputs);
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let profile = bank.default_face_profile();
    for (who, stated) in [(Who::Speaker, 6.0), (Who::Other("mara"), 2.0), (Who::Other("otto"), 4.0)] {
        let mut blinks = 0;
        for clip in bank.clips() {
            let closed =
                |ms: i64| clip.face_at(Micros(ms * 1000), who, &profile, LookAt::AHEAD).blink.thousandths() == 1000;
            let shown: Vec<bool> = (0..12_000).step_by(40).map(closed).collect();
            blinks += shown.windows(2).filter(|pair| !pair[0] && pair[1]).count();
        }
        let seconds = 12_000.0 / f64::from(u32::try_from(blinks).unwrap());
        assert!((seconds / stated - 1.0_f64).abs() < 0.05, "{who:?}: a blink in {seconds} seconds, not in {stated}");
    }
}
