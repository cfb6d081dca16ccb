//! Seconds in floating point: tests the rule of two units in the last place in exact arithmetic.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Fps, Seconds, Time};
use proptest::prelude::*;

/// Rates as authors write them, each with its exact ratio.
const RATES: [(f64, u32, u32); 9] = [
    (24.0, 24, 1),
    (25.0, 25, 1),
    (30.0, 30, 1),
    (60.0, 60, 1),
    (12.5, 25, 2),
    (23.976, 2997, 125),
    (29.97, 2997, 100),
    (59.94, 2997, 50),
    (1000.0, 1000, 1),
];

fn fps(numerator: u32, denominator: u32) -> Fps {
    Fps::new(numerator, denominator).expect("from 1 to 1000")
}

/// Returns a number as mantissa · 2^exponent, without rounding.
fn exactly(number: f64) -> (u128, i32) {
    let bits = number.to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32 & 0x7FF, u128::from(bits & ((1 << 52) - 1)));
    if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) }
}

/// Returns ⌊mantissa · 2^exponent · fps⌋ by plain division, if it is below `frame_count`.
fn floor_product((mantissa, exponent): (u128, i32), fps: Fps, frame_count: u32) -> Option<u32> {
    let (numerator, denominator) = (u128::from(fps.numerator()), u128::from(fps.denominator()));
    let frame = match exponent {
        // 2^54 · 2^32 < 2^95, so such a product rounds down to 0.
        ..=-96 => 0,
        -95..=-1 => mantissa * numerator / (denominator << exponent.unsigned_abs()),
        0..=40 => (mantissa << exponent) * numerator / denominator,
        // At least 2^41 seconds, unless the mantissa is small, in which case the exponent is small too.
        _ => return None,
    };
    u32::try_from(frame).ok().filter(|&frame| frame < frame_count)
}

/// The rule for `f64`, with the two units added to the mantissa.
fn rule_f64(time: f64, fps: Fps, frame_count: u32) -> Option<u32> {
    let (mantissa, exponent) = exactly(time);
    floor_product((mantissa + 2, exponent), fps, frame_count)
}

/// The rule for `f32`. Every sum below is exact in `f64`.
fn rule_f32(time: f32, fps: Fps, frame_count: u32) -> Option<u32> {
    let next = f32::from_bits(time.to_bits() + 1);
    if next.is_infinite() {
        return None;
    }
    let unit = f64::from(next) - f64::from(time);
    floor_product(exactly(f64::from(time) + 2.0 * unit), fps, frame_count)
}

fn assert_starts(n: u32, rate: f64, exact: Fps) {
    let start = f64::from(n) / rate;
    assert_eq!(Seconds(start).frame(exact, u32::MAX), Some(n), "{n} / {rate}");
}

fn assert_starts_f32(n: u32, rate: f64, exact: Fps) {
    let start = n as f32 / rate as f32;
    assert_eq!(Seconds(start).frame(exact, u32::MAX), Some(n), "{n} / {rate}");
}

/// `n / fps` leads to frame n, for every n in `f64`.
#[test]
fn the_start_that_hosts_compute_f64() {
    for (rate, numerator, denominator) in RATES {
        let exact = fps(numerator, denominator);
        for n in (0..50_000).chain((50_000..u32::MAX).step_by(65_521)).chain(u32::MAX - 1000..u32::MAX) {
            assert_starts(n, rate, exact);
        }
    }
}

/// The same up to 2²¹ in `f32`, one day at 24 frames per second.
#[test]
fn the_start_that_hosts_compute_f32() {
    for (rate, numerator, denominator) in RATES {
        let exact = fps(numerator, denominator);
        for n in (0..50_000).chain((50_000..1 << 21).step_by(13)).chain((1 << 21) - 1000..=1 << 21) {
            assert_starts_f32(n, rate, exact);
        }
    }
}

/// The tolerance is no greater than documented: three units before an exact start, the previous frame still shows.
#[test]
fn three_units_before_is_before() {
    for n in (24..240_000_u32).step_by(24) {
        let start = f64::from(n / 24);
        let before = |units: u64| Seconds(f64::from_bits(start.to_bits() - units)).frame(fps(24, 1), u32::MAX);
        assert_eq!([1, 2, 3].map(before), [Some(n), Some(n), Some(n - 1)], "{start} s");
    }
}

#[test]
fn no_time_leads_to_no_frame() {
    let rate = fps(24, 1);
    for time in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -5e-324, f64::MIN, f64::MAX, 1e30] {
        assert_eq!(Seconds(time).frame(rate, u32::MAX), None, "{time}");
    }
    for time in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -1e-45, f32::MIN, f32::MAX, 1e30] {
        assert_eq!(Seconds(time).frame(rate, u32::MAX), None, "{time}");
    }
    assert_eq!(Seconds(1.0_f64).frame(rate, 24), None);
    assert_eq!(Seconds(1.0_f32).frame(rate, 24), None);
}

#[test]
fn next_to_nothing_leads_to_the_first_frame() {
    let rate = fps(1000, 1);
    for time in [0.0, 5e-324, f64::MIN_POSITIVE, 1e-300, 1e-9] {
        assert_eq!(Seconds(time).frame(rate, 1), Some(0), "{time}");
        assert_eq!(Seconds(time).frame(rate, 0), None);
    }
    for time in [0.0, 1e-45, f32::MIN_POSITIVE, 1e-30, 1e-9] {
        assert_eq!(Seconds(time).frame(rate, 1), Some(0), "{time}");
        assert_eq!(Seconds(time).frame(rate, 0), None);
    }
}

/// Times at which the unit in the last place is a whole number of seconds.
#[test]
fn decades() {
    let rate = fps(1, 1);
    for exponent in 20..33 {
        let time = (1_u64 << exponent) as f32;
        assert_eq!(Seconds(time).frame(rate, u32::MAX), rule_f32(time, rate, u32::MAX), "{time}");
        assert_eq!(Seconds(f64::from(time)).frame(rate, u32::MAX), u32::try_from(1_u64 << exponent).ok(), "{time}");
    }
    // Two units are 512 seconds here.
    assert_eq!(Seconds(2_147_483_648.0_f32).frame(rate, u32::MAX), Some((1 << 31) + 512));
}

/// Times of any magnitude within reach of some rate, in every binade.
fn any_time() -> impl Strategy<Value = f64> {
    let bits = prop_oneof![any::<u64>(), (1000_u64..1080, any::<u64>()).prop_map(|(e, f)| e << 52 | f >> 12)];
    bits.prop_map(|bits| f64::from_bits(bits & !(1 << 63))).prop_filter("a number", |time| time.is_finite())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_rule_holds_f64(time in any_time(), d in 1..u32::MAX, extra: u32, count: u32) {
        let rate = fps(d.saturating_add(extra % (d | 1)), d);
        prop_assert_eq!(Seconds(time).frame(rate, count), rule_f64(time, rate, count));
        prop_assert_eq!(Seconds(time).frame(Fps::whole(60), u32::MAX), rule_f64(time, Fps::whole(60), u32::MAX));
    }

    #[test]
    fn the_rule_holds_f32(time in any_time(), d in 1..u32::MAX, extra: u32, count: u32) {
        let time = if (time as f32).is_finite() { time as f32 } else { f32::from_bits(time.to_bits() as u32 >> 2) };
        let rate = fps(d.saturating_add(extra % (d | 1)), d);
        prop_assert_eq!(Seconds(time).frame(rate, count), rule_f32(time, rate, count));
        prop_assert_eq!(Seconds(time).frame(Fps::whole(60), u32::MAX), rule_f32(time, Fps::whole(60), u32::MAX));
    }

    #[test]
    fn any_start_leads_to_its_frame(n in 0..u32::MAX, which in 0..RATES.len()) {
        let (rate, numerator, denominator) = RATES[which];
        assert_starts(n, rate, fps(numerator, denominator));
        assert_starts_f32(n & ((1 << 21) - 1), rate, fps(numerator, denominator));
    }
}

/// Two units in the last place after -0.0 are as small as after 0.0.
#[test]
fn negative_zero_is_zero() {
    for rate in [1, 24, 1000] {
        assert_eq!(Fps::whole(rate).frame_at(Seconds(-0.0_f64)), Some(0));
        assert_eq!(Fps::whole(rate).frame_at(Seconds(-0.0_f32)), Some(0));
    }
}
