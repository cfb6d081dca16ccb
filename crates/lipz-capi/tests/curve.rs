//! Curves give the answers of the reader, by name and by index, in every unit of time.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{Answer, CURVES, bank, ptr, text_of};
use lipz_bank::{ClipId, CurveValue, Emotion, Micros, Samples, Seconds};
use lipz_capi::*;
use lipz_compiler::{Compiler, Input};

#[test]
fn curves_give_the_answers_of_the_reader() {
    let (expected, bank) = bank(CURVES);
    let bank = Some(&bank);
    let mut seen = 0;
    for clip in expected.clips() {
        let asked = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(bank, clip.id().get(), out) }).ok();
        let asked = Some(&asked);
        for (index, curve) in clip.curves().enumerate() {
            let found =
                Answer::<Curve>::from_call(|out| unsafe { lipz_clip_curve_at(bank, asked, index as u32, out) }).ok();
            let (name, length) = ptr(curve.name().as_str());
            let named =
                Answer::<Curve>::from_call(|out| unsafe { lipz_clip_curve(bank, asked, name, length, out) }).ok();
            assert_eq!((named.place, text_of(named.name)), (found.place, curve.name().as_str()));
            assert_eq!((found.place, found.key_count), (curve.place(), curve.key_count()));
            for (index, key) in (0..).zip(curve.keys()) {
                let found = Answer::<CurveKey>::from_call(|out| unsafe {
                    lipz_clip_curve_key(bank, asked, Some(&named), index, out)
                });
                assert_eq!((found.ok().frame, found.ok().thousandths), (key.frame, key.value.thousandths()));
                let value = Answer::from_call(|out| unsafe {
                    lipz_clip_curve_value(bank, asked, Some(&named), None, key.frame, out)
                })
                .ok();
                assert_eq!(value, key.value.thousandths());
            }
            at_times(bank, asked, &named, &curve);
            seen += 1;
        }
        let behind = clip.curves().count() as u32;
        let none = Answer::<Curve>::from_call(|out| unsafe { lipz_clip_curve_at(bank, asked, behind, out) });
        assert_eq!((none.status, none.written().key_count), (LIPZ_NONE, 0));
        let none = Answer::<Curve>::from_call(|out| unsafe { lipz_clip_curve(bank, asked, ptr("no").0, 2, out) });
        assert_eq!(none.status, LIPZ_NONE);
    }
    assert_eq!(seen, 7);
}

/// A curve that is kept, and asked of another version of its bank, is no curve of that.
#[test]
fn a_curve_of_another_bank_is_none() {
    let sources =
        [("b", r#"{ "fps": 24, "visemes": "MAMA", "curves": { "joy": "0:1 3:4" } }"#), ("a", r#"{ "visemes": "MA" }"#)];
    let banks = [1, 2].map(|count| {
        let inputs = sources.into_iter().take(count).map(|(key, file)| Input::from_bytes(key, file));
        Compiler::default().compile(&inputs.collect::<Vec<_>>()).into_bank().unwrap()
    });
    let opened = banks.map(|bytes| bank(bytes.leak()).1);
    let [old, newer] = &opened;
    let id = ClipId::from_key("b").get();
    let clip = |bank| Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(Some(bank), id, out) }).ok();
    let curve = |bank| {
        let ((name, length), clip) = (ptr("joy"), clip(bank));
        Answer::<Curve>::from_call(|out| unsafe { lipz_clip_curve(Some(bank), Some(&clip), name, length, out) }).ok()
    };
    let status = |bank, curve| {
        let clip = clip(bank);
        let call =
            |out: Option<&mut _>| unsafe { lipz_clip_curve_value(Some(bank), Some(&clip), Some(curve), None, 3, out) };
        Answer::<i32>::from_call(call).status
    };
    let (kept, found) = (curve(old), curve(newer));
    assert_eq!(kept.place, found.place, "only the bank tells them apart");
    assert_eq!([status(old, &kept), status(newer, &kept), status(newer, &found)], [LIPZ_OK, LIPZ_NONE, LIPZ_OK]);
}

/// One cursor for all: jumps and other curves change no answer.
fn at_times(bank: Option<&Bank>, clip: Option<&Clip>, named: &Curve, curve: &lipz_bank::Curve<'_>) {
    let (named, mut cursor) = (Some(named), CurveCursor { key: u32::MAX });
    for (step, us) in (-50_000..1_500_000).step_by(33_333).enumerate() {
        let (seconds, position, rate_hz) = (us as f64 / 1e6, us * 441 / 10_000, 44_100);
        for is_with in [false, true] {
            let us_found = Answer::from_call(|out| unsafe {
                lipz_clip_curve_value_at_us(bank, clip, named, Some(&mut cursor).filter(|_| is_with), us, out)
            });
            let samples_found = Answer::from_call(|out| unsafe {
                lipz_clip_curve_value_at_samples(
                    bank,
                    clip,
                    named,
                    Some(&mut cursor).filter(|_| is_with),
                    position,
                    rate_hz,
                    out,
                )
            });
            let seconds_found = Answer::from_call(|out| unsafe {
                lipz_clip_curve_value_at_seconds(bank, clip, named, Some(&mut cursor).filter(|_| is_with), seconds, out)
            });
            let short_found = Answer::from_call(|out| unsafe {
                lipz_clip_curve_value_at_seconds_f32(
                    bank,
                    clip,
                    named,
                    Some(&mut cursor).filter(|_| is_with),
                    seconds as f32,
                    out,
                )
            });
            let frame_found = Answer::<i32>::from_call(|out| unsafe {
                lipz_clip_curve_value(bank, clip, named, Some(&mut cursor).filter(|_| is_with), step as u32, out)
            });
            let answers = [
                (us_found, curve.value_at(Micros(us))),
                (samples_found, curve.value_at(Samples { position, rate_hz })),
                (seconds_found, curve.value_at(Seconds(seconds))),
                (short_found, curve.value_at(Seconds(seconds as f32))),
                (frame_found, Some(curve.value(step as u32))),
            ];
            for (found, expected) in answers {
                assert_eq!(found.some(), expected.map(CurveValue::thousandths), "{us} us");
            }
        }
    }
    let last = curve.value(u32::MAX).thousandths();
    let found = Answer::<i32>::from_call(|out| unsafe {
        lipz_clip_curve_value(bank, clip, named, Some(&mut cursor), u32::MAX, out)
    });
    assert_eq!((found.ok(), cursor.key), (last, curve.key_count() - 1), "it is at the last key");
}

/// The attributes have the numbers of the reader.
#[test]
fn emotions_are_those_of_the_reader() {
    let numbers = [
        LIPZ_SADNESS,
        LIPZ_ANGER,
        LIPZ_JOY,
        LIPZ_FEAR,
        LIPZ_DISGUST,
        LIPZ_SURPRISE,
        LIPZ_SHOCK,
        LIPZ_PERPLEXED,
        LIPZ_ASLEEP,
        LIPZ_PAIN,
        LIPZ_EXERTION,
        LIPZ_SHOUT,
    ];
    assert_eq!(Emotion::ALL.map(|emotion| emotion as u32), numbers);
    let (expected, bank) = bank(CURVES);
    let clip = expected.clip_by_key("act1/rig").unwrap();
    let asked = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(Some(&bank), clip.id().get(), out) }).ok();
    let (bank, asked) = (Some(&bank), Some(&asked));
    for us in (-50_000..1_000_000).step_by(41_000) {
        let (seconds, position, rate_hz) = (us as f64 / 1e6, us * 441 / 10_000, 44_100);
        let answers = [
            (
                Answer::<Emotions>::from_call(|out| unsafe { lipz_clip_emotions_at_us(bank, asked, us, out) }),
                clip.emotions_at(Micros(us)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_clip_emotions_at_samples(bank, asked, position, rate_hz, out) }),
                clip.emotions_at(Samples { position, rate_hz }),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_clip_emotions_at_seconds(bank, asked, seconds, out) }),
                clip.emotions_at(Seconds(seconds)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_clip_emotions_at_seconds_f32(bank, asked, seconds as f32, out) }),
                clip.emotions_at(Seconds(seconds as f32)),
            ),
        ];
        for (found, expected) in answers {
            let found = found.ok();
            assert_eq!(
                found.thousandths.to_vec(),
                expected.iter().map(|(_, value)| value.thousandths()).collect::<Vec<_>>()
            );
            assert_eq!(found.sum, expected.sum().thousandths());
            assert_eq!(found.strongest, expected.strongest().map_or(LIPZ_NEUTRAL, |(emotion, _)| emotion as u32));
        }
    }
    let angry =
        Answer::<Emotions>::from_call(|out| unsafe { lipz_clip_emotions_at_us(bank, asked, 500_000, out) }).ok();
    assert_eq!((angry.strongest, angry.thousandths.get(1)), (LIPZ_ANGER, Some(&2200)));
}

#[test]
fn null_pointers_are_a_status() {
    let (_, bank) = bank(CURVES);
    let clip = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_at(Some(&bank), 0, out) }).ok();
    let value =
        Answer::<i32>::from_call(|out| unsafe { lipz_clip_curve_value(Some(&bank), Some(&clip), None, None, 0, out) });
    assert_eq!((value.status, value.written()), (LIPZ_NULL_POINTER, 0));
    assert_eq!(unsafe { lipz_clip_curve_at(Some(&bank), Some(&clip), 0, None) }, LIPZ_NULL_POINTER);
}
