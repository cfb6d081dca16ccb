//! Conversion of times to frames, with every unit compared to plain wide arithmetic.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Fps, Micros, Samples, Time};
use proptest::prelude::*;
use std::time::Duration;

/// ⌊`time` · fps / `units_per_second`⌋ if it is one of the first `frame_count` frames.
fn reference(time: u128, units_per_second: u128, fps: Fps, frame_count: u32) -> Option<u32> {
    let frame = time * u128::from(fps.numerator()) / (u128::from(fps.denominator()) * units_per_second);
    u32::try_from(frame).ok().filter(|&frame| frame < frame_count)
}

fn fps(numerator: u32, denominator: u32) -> Fps {
    Fps::new(numerator, denominator).expect("from 1 to 1000")
}

/// Returns common rates, and the extremes of ratios of 32-bit numbers.
fn rates() -> Vec<Fps> {
    let ratios = [
        (1, 1),
        (24, 1),
        (25, 1),
        (30, 1),
        (60, 1),
        (1000, 1),
        (2997, 125),
        (24_000, 1001),
        (30_000, 1001),
        (25, 2),
        (u32::MAX, u32::MAX - 1),
        (u32::MAX, u32::MAX - 4),
        (u32::MAX, 4_294_968),
        (4_294_967_000, 4_294_967),
        (999_999_999, 1_000_001),
        (1_000_003, 1009),
    ];
    ratios.into_iter().map(|(numerator, denominator)| fps(numerator, denominator)).collect()
}

/// Returns frame numbers that are likely to cause errors.
fn frames() -> impl Iterator<Item = u32> {
    let small = 0..3000;
    let powers = (12..32).flat_map(|bit| [(1 << bit) - 1, 1_u32 << bit, (1 << bit) + 1]);
    small.chain(powers).chain([u32::MAX - 2, u32::MAX - 1])
}

/// Returns the first time in these units at which `frame` shows.
fn first_unit(frame: u32, units_per_second: u128, fps: Fps) -> u128 {
    (u128::from(frame) * u128::from(fps.denominator()) * units_per_second).div_ceil(u128::from(fps.numerator()))
}

#[test]
fn micros_around_every_boundary() {
    for rate in rates() {
        for frame in frames() {
            let start = first_unit(frame, 1_000_000, rate) as i64;
            assert_eq!(Micros(start).frame(rate, u32::MAX), Some(frame), "{rate:?}");
            assert_eq!(Micros(start).frame(rate, frame), None, "{rate:?}: the end of {frame} frames");
            assert_eq!(Micros(start - 1).frame(rate, u32::MAX), frame.checked_sub(1), "{rate:?}: before {frame}");
        }
    }
}

#[test]
fn samples_around_every_boundary() {
    for rate in rates() {
        for rate_hz in [8_000, 11_025, 44_100, 48_000, 192_000, u32::MAX] {
            for frame in frames() {
                let Ok(start) = i64::try_from(first_unit(frame, u128::from(rate_hz), rate)) else { continue };
                let at = |position| Samples { position, rate_hz }.frame(rate, u32::MAX);
                assert_eq!(Samples { position: start, rate_hz }.frame(rate, frame), None, "the end of {frame} frames");
                assert_eq!(at(start), Some(frame), "{rate:?} at {rate_hz}");
                assert_eq!(at(start - 1), frame.checked_sub(1), "{rate:?} at {rate_hz}: before {frame}");
            }
        }
        // There are fewer samples than frames, so some frames have no sample.
        for position in 0..2000 {
            for rate_hz in [1, 2, 7] {
                let expected = reference(position as u128, u128::from(rate_hz), rate, u32::MAX);
                assert_eq!(Samples { position, rate_hz }.frame(rate, u32::MAX), expected);
            }
        }
    }
}

#[test]
fn durations_around_every_boundary() {
    for rate in rates() {
        for frame in frames() {
            let start = first_unit(frame, 1_000_000_000, rate);
            let time = Duration::new((start / 1_000_000_000) as u64, (start % 1_000_000_000) as u32);
            assert_eq!(time.frame(rate, u32::MAX), Some(frame), "{rate:?}");
            assert_eq!(time.frame(rate, frame), None, "{rate:?}: the end of {frame} frames");
            if let Some(before) = time.checked_sub(Duration::from_nanos(1)) {
                assert_eq!(before.frame(rate, u32::MAX), frame.checked_sub(1), "{rate:?}: before {frame}");
            }
        }
        assert_eq!(Duration::MAX.frame(rate, u32::MAX), None);
    }
}

#[test]
fn before_the_start_and_after_the_end() {
    for rate in rates() {
        for time in [-1, -1_000_000, i64::MIN, i64::MIN + 1] {
            assert_eq!(Micros(time).frame(rate, u32::MAX), None);
            assert_eq!(Samples { position: time, rate_hz: 44_100 }.frame(rate, u32::MAX), None);
        }
        assert_eq!(Micros(i64::MAX).frame(rate, u32::MAX), None);
        assert_eq!(Samples { position: i64::MAX, rate_hz: 44_100 }.frame(rate, u32::MAX), None);
        assert_eq!(Samples { position: 0, rate_hz: 0 }.frame(rate, u32::MAX), None);
        assert_eq!(Micros(0).frame(rate, 0), None);
    }
    // At the highest sample rate, the largest position is still within range.
    let farthest = Samples { position: i64::MAX, rate_hz: u32::MAX };
    assert_eq!(farthest.frame(fps(1, 1), u32::MAX), Some(1 << 31));
}

#[test]
fn a_frame_starts_at_its_first_microsecond() {
    for rate in rates() {
        for frame in frames() {
            let start = rate.start_of_frame_us(frame);
            assert_eq!(u128::from(start), first_unit(frame, 1_000_000, rate));
        }
    }
    assert_eq!(fps(24, 1).start_of_frame_us(1), 41_667);
}

#[test]
fn rates_outside_1_to_1000_are_none() {
    for (numerator, denominator) in [(0, 1), (1, 0), (0, 0), (1, 2), (1001, 1), (u32::MAX, 4_294_967), (3, 4)] {
        assert_eq!(Fps::new(numerator, denominator), None, "{numerator}/{denominator}");
    }
    assert_eq!((fps(48, 2).numerator(), fps(48, 2).denominator()), (24, 1));
    assert_eq!(fps(48, 2), Fps::whole(24));
}

/// Returns any rate from 1 to 1000.
fn any_fps() -> impl Strategy<Value = Fps> {
    let denominator = prop_oneof![1..2000_u32, any::<u32>().prop_map(|denominator| denominator.max(1))];
    denominator.prop_flat_map(|denominator| {
        let most = u32::try_from(u64::from(denominator) * 1000).unwrap_or(u32::MAX);
        (denominator..=most).prop_map(move |numerator| fps(numerator, denominator))
    })
}

proptest! {
    // Failed cases are not stored, because some of the machines cannot write files.
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn micros_are_exact(rate in any_fps(), time in 0..=i64::MAX, shift in 0..40_u32, count: u32) {
        let time = time >> shift;
        prop_assert_eq!(Micros(time).frame(rate, count), reference(time as u128, 1_000_000, rate, count));
    }

    #[test]
    fn samples_are_exact(rate in any_fps(), time in 0..=i64::MAX, shift in 0..40_u32, rate_hz in 1..u32::MAX, count: u32) {
        let position = time >> shift;
        let expected = reference(position as u128, u128::from(rate_hz), rate, count);
        prop_assert_eq!(Samples { position, rate_hz }.frame(rate, count), expected);
    }

    #[test]
    fn durations_are_exact(rate in any_fps(), seconds: u64, shift in 0..64_u32, nanos in 0..1_000_000_000_u32, count: u32) {
        let time = Duration::new(seconds >> shift, nanos);
        prop_assert_eq!(time.frame(rate, count), reference(time.as_nanos(), 1_000_000_000, rate, count));
    }

    #[test]
    fn the_reciprocal_is_rounded_up(rate in any_fps()) {
        let micros = u128::from(rate.denominator()) * 1_000_000;
        let expected = (u128::from(rate.numerator()) << 64).div_ceil(micros);
        prop_assert_eq!(u128::from(rate.frames_per_micro_q64()), expected);
    }

    #[test]
    fn starts_and_frames_are_inverse(rate in any_fps(), frame in 0..u32::MAX) {
        let start = rate.start_of_frame_us(frame) as i64;
        prop_assert_eq!(Micros(start).frame(rate, u32::MAX), Some(frame));
        prop_assert_eq!(Micros(start - 1).frame(rate, u32::MAX), frame.checked_sub(1));
    }
}
