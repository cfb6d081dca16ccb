//! Compares babble with the viewer's arithmetic, and tests openness for all viseme types.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::babble::{Babble, VoiceLevel, Weight, Weights};
use lipz_bank::{Fps, Micros, Samples, Seconds, Viseme, VisemeType};
use lipz_testkit::golden::{SMALL, verified};
use std::time::Duration;

/// The period of loops of 28 and 24 digits together, in digits.
const PERIOD: u32 = 168;

/// Computes a morph as in the viewer's documentation, with its floating point.
fn viewer(digits: &str, transfer: &str, rate: f32, elapsed_s: f32, power: f32) -> f32 {
    let values = |digits: &str| -> Vec<f32> { digits.bytes().map(|digit| f32::from(digit - b'0') * 0.11).collect() };
    let (values, transfers) = (values(digits), values(transfer));
    let frame = (elapsed_s * rate) as u32;
    let index = ((transfers.len() as f32 * power) as usize).min(transfers.len() - 1);
    transfers[index] * values[frame as usize % values.len()]
}

fn close(exact: f32, viewers: f32) -> bool {
    (exact - viewers).abs() <= 2.0 * f32::EPSILON
}

#[test]
fn every_frame_at_every_power_is_the_viewers() {
    let babble = Babble::DEFAULT;
    for frame in 0..2 * PERIOD {
        let middle_s = (frame as f32 + 0.5) / 24.0;
        for step in 0..=1000 {
            let power = step as f32 / 1000.0;
            let exact = babble.at(Seconds(middle_s), power);
            let ooh = viewer("1247898743223344444443200000", "0012345566778899", 24.0, middle_s, power);
            let aah = viewer("257998776531013446642343", "0000123456789", 24.0, middle_s, power);
            assert!(close(exact.ooh.to_f32(), ooh) && close(exact.aah.to_f32(), aah), "{frame} {power}");
        }
    }
}

#[test]
fn the_pair_repeats_after_its_period_and_no_sooner() {
    let at = |frame: u32| Babble::DEFAULT.at(Samples { position: frame.into(), rate_hz: 24 }, 1.0);
    let repeats = |period: u32| (0..PERIOD).all(|frame| at(frame) == at(frame + period));
    assert_eq!((1..=PERIOD).filter(|&period| repeats(period)).collect::<Vec<_>>(), [PERIOD]);
}

#[test]
fn time_is_exact_in_every_unit_however_long_the_speech() {
    let babble = Babble::DEFAULT;
    for frame in [0, 1, 23, 167, 168, 1_000_000, 100_000_000_u64] {
        let expected = babble.at(Samples { position: frame as i64, rate_hz: 24 }, 1.0);
        let start_us = (frame * 1_000_000).div_ceil(24);
        assert_eq!(babble.at(Micros(start_us as i64), 1.0), expected);
        assert_eq!(babble.at(Duration::from_micros(start_us), 1.0), expected);
        assert_eq!(babble.at(Seconds(frame as f64 / 24.0), 1.0), expected);
        if frame > 0 {
            let before = babble.at(Samples { position: frame as i64 - 1, rate_hz: 24 }, 1.0);
            assert_eq!(babble.at(Micros(start_us as i64 - 1), 1.0), before);
        }
    }
    assert_eq!(babble.at(Micros(-1), 1.0), Weights::default(), "nobody speaks yet");
}

#[test]
fn levels_are_powers_and_no_power_leaves_the_transfer() {
    let babble = Babble::DEFAULT;
    let elapsed = Micros(200_000); // digits 9 and 9
    for level in 0..=u16::MAX {
        assert_eq!(babble.at(elapsed, VoiceLevel(level)), babble.at(elapsed, f32::from(level) / 65_536.0));
    }
    let loudest = babble.at(elapsed, VoiceLevel(u16::MAX));
    assert_eq!(loudest.ooh.ten_thousandths(), 81 * 121 - 9 * 121, "8 of the loop, 9 of the transfer");
    for power in [1.0, 1.5, f32::INFINITY] {
        assert_eq!(babble.at(elapsed, power), loudest);
    }
    for power in [0.0, -1.0, f32::NEG_INFINITY, f32::NAN] {
        assert_eq!(babble.at(elapsed, power), babble.at(elapsed, VoiceLevel(0)));
    }
    let mut calls = 0;
    assert_eq!(
        babble.at(elapsed, || {
            calls += 1;
            1.0
        }),
        loudest
    );
    assert_eq!(calls, 1, "measured once");
}

#[test]
fn a_bank_without_profiles_has_the_built_in_one() {
    let bank = verified(SMALL);
    assert_eq!((bank.babbles().count(), bank.babble("default")), (0, None));
    assert_eq!(bank.default_babble(), Babble::DEFAULT);
    assert_eq!(Babble::DEFAULT.name(), "default");
}

#[test]
fn all_mouths_answer_one_question() {
    let bank = verified(SMALL);
    let clip = |key| bank.clip_by_key(key).expect("a clip");
    let open = |key, us| clip(key).openness_at(Micros(us)).map(Weight::ten_thousandths);
    assert_eq!(open("act1/rms", 81_000), Some(0)); // -0123456789- at 12.5 fps
    assert_eq!(open("act1/rms", 161_000), Some(1100));
    assert_eq!(open("act1/rms", 801_000), Some(9900));
    assert_eq!(open("act1/rms", -1), Some(0));
    assert_eq!(open("act1/blair", 42_000), Some(9900)); // A
    assert_eq!(open("act2/silent", 0), None);
    assert_eq!(open("act2/unspecified", 0), None);
    let now = Micros(250_000);
    let babble = Babble::DEFAULT;
    let silent = clip("act2/silent").openness_or_babble(now, &babble, 0.8);
    assert_eq!(silent, babble.at(now, 0.8).aah);
    let unasked = || -> f32 { panic!("a clip with shapes asks for no power") };
    assert_eq!(Some(clip("act1/blair").openness_or_babble(now, &babble, unasked)), clip("act1/blair").openness_at(now));
}

#[test]
fn shapes_open_as_their_counterparts() {
    let openness = |kind: VisemeType| -> Vec<u16> {
        let weight = |code| Viseme::from_code(code).openness(kind).ten_thousandths() / 1100;
        kind.codes().bytes().map(weight).collect()
    };
    assert_eq!(openness(VisemeType::Rms), [0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    assert_eq!(openness(VisemeType::Blair), [0, 9, 0, 6, 3, 2, 6, 1, 4, 2]); // -AMOSWEFLU
    assert_eq!(openness(VisemeType::ToonBoom), [0, 0, 3, 6, 9, 6, 2, 1]); // -ABCDEFG
    assert_eq!(Babble::DEFAULT.rate(), Fps::whole(24));
}
