//! Compares positions between frames, and values between keys, with unbounded arithmetic.
// Tests run with the workspace's compiler, not with the oldest one of this crate.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use core::time::Duration;
use lipz_types::{CurveValue, Fps, Micros, Position, Samples, Seconds, StoredFps, Time};

const ONE: u128 = 1 << 16;

/// ⌊`time` · rate · 2¹⁶ / `per_second`⌋.
fn exact(time: u128, per_second: u128, fps: Fps) -> u128 {
    time * u128::from(fps.numerator()) * ONE / (per_second * u128::from(fps.denominator()))
}

fn found(position: Position) -> u128 {
    u128::from(position.frame) * ONE + u128::from(position.sixteen_bits)
}

fn rates() -> [Fps; 5] {
    [(24, 1), (30_000, 1001), (2997, 125), (1, 1), (u32::MAX, 4_294_968)].map(|(n, d)| Fps::new(n, d).unwrap())
}

#[test]
fn positions_are_exact_in_every_unit() {
    for fps in rates() {
        let stored = StoredFps::from(fps);
        for time in [0_u32, 1, 41_666, 41_667, 999_999, 1_000_000, 123_456_789, u32::MAX] {
            let wide = u128::from(time);
            let of = |time: Micros| found(time.position(stored));
            assert_eq!(of(Micros(time.into())), exact(wide, 1_000_000, fps), "{time} us at {fps:?}");
            for rate_hz in [8_000, 44_100, u32::MAX] {
                let expected = exact(wide, rate_hz.into(), fps);
                let samples = Samples { position: time.into(), rate_hz };
                assert_eq!(found(samples.position(stored)), expected.min((1 << 48) - 1), "{samples:?} at {fps:?}");
            }
            let nanos = found(Duration::from_nanos(time.into()).position(stored));
            assert_eq!(nanos, exact(wide, 1_000_000_000, fps));
            // A float stands for the time two units in the last place later.
            let (bits, shift) = (u128::from(time) << 20, 52);
            let seconds = time as f64 / 2_f64.powi(32);
            if (0.5..1.0).contains(&seconds) {
                let expected = exact((bits << 1) + 2, 1 << (shift + 1), fps);
                assert_eq!(found(Seconds(seconds).position(stored)), expected, "{seconds} s at {fps:?}");
            }
        }
    }
}

#[test]
fn floats_of_seconds_agree_with_fractions_of_seconds() {
    let fps = StoredFps::from(Fps::whole(24));
    for (seconds, frame, sixteen_bits) in [(0.0, 0, 0), (0.0625, 1, 0x8000), (2.75, 66, 0)] {
        let expected = Position { frame, sixteen_bits };
        assert_eq!(Seconds(seconds).position(fps), expected);
        assert_eq!(Seconds(seconds as f32).position(fps).frame, expected.frame);
    }
    assert_eq!(Seconds(8_388_609.5).position(fps), Position::of_frame(201_326_628));
    assert_eq!(Seconds(3e7_f64).position(fps), Position::of_frame(720_000_000));
    assert_eq!(Seconds(f64::MIN_POSITIVE).position(fps), Position::of_frame(0));
}

#[test]
fn times_outside_are_the_start_or_the_end() {
    let fps = StoredFps::from(Fps::whole(24));
    let last = Position { frame: u32::MAX, sixteen_bits: u16::MAX };
    for time in [Micros(-1), Micros(i64::MIN)] {
        assert_eq!(time.position(fps), Position::of_frame(0));
    }
    assert_eq!(Micros(i64::MAX).position(fps), last);
    assert_eq!(Seconds(f32::NAN).position(fps), Position::of_frame(0));
    assert_eq!(Seconds(f64::INFINITY).position(fps), last);
    assert_eq!(Samples { position: 5, rate_hz: 0 }.position(fps), Position::of_frame(0));
}

#[test]
fn values_between_two_are_exact() {
    let values = [0, 1, -1, 2200, 10_000, -32_768, i32::MAX, i32::MIN];
    for (from, to) in values.iter().flat_map(|from| values.map(|to| (*from, to))) {
        for (done, whole) in
            [(0, 2), (1, 2), (1, 65_536), (65_535, 65_536), (12 << 16, 25 << 16), ((1 << 48) - 1, 1 << 48)]
        {
            let (from, to) = (CurveValue::from_thousandths(from), CurveValue::from_thousandths(to));
            let distance = i128::from(to.thousandths()) - i128::from(from.thousandths());
            let part = (distance.abs() * i128::from(done) * 2 + i128::from(whole)) / (i128::from(whole) * 2);
            let expected = i128::from(from.thousandths()) + part * distance.signum();
            assert_eq!(i128::from(from.towards(to, done, whole).thousandths()), expected, "{from} {to} {done}/{whole}");
        }
    }
}

#[test]
fn values_are_displayed_as_numbers() {
    let texts = [(0, "0"), (-50, "-0.05"), (2200, "2.2"), (1_001, "1.001"), (i32::MIN, "-2147483.648"), (20, "0.02")];
    for (thousandths, text) in texts {
        assert_eq!(CurveValue::from_thousandths(thousandths).to_string(), text);
    }
}

/// The same for rates that no valid bank has, as far as 64 bits allow.
#[test]
fn starts_of_frames_are_exact_or_as_late_as_can_be() {
    let numbers = [1, 2, 3, 7, 24, 1000, 1001, 65_537, u32::MAX - 1, u32::MAX];
    for (numerator, denominator) in numbers.iter().flat_map(|n| numbers.iter().map(move |d| (*n, *d))) {
        let rate = StoredFps::from_parts(numerator, denominator, 0).unwrap();
        for frame in numbers.into_iter().chain([0]) {
            let exact = (u128::from(frame) * u128::from(denominator) * 1_000_000).div_ceil(u128::from(numerator));
            let start = u128::from(rate.start_of_frame_us(frame));
            assert_eq!(start, exact.min(u128::from(u64::MAX)), "{frame} at {numerator}/{denominator}");
        }
    }
}
