//! Tests times in units that are known only at run time, and shifted times.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{AnyTime, Fps, Micros, Samples, Seconds, Time};
use proptest::prelude::*;

proptest! {
    /// The sum of floats is rounded twice, so it may be off by one unit in the last place.
    #[test]
    fn floats_are_later_without_floating_point(time in 0.0_f64..1e6, us in any::<u32>()) {
        let sum = time + f64::from(us) / 1e6;
        let units = Seconds(time).later(us).0.to_bits().abs_diff(sum.to_bits());
        prop_assert!(units <= 1, "{time} {us}: {units}");
        let (time, micros) = (time as f32, f64::from(us) / 1e6);
        let sum = (f64::from(time) + micros) as f32;
        let units = Seconds(time).later(us).0.to_bits().abs_diff(sum.to_bits());
        prop_assert!(units <= 1, "{time} {us}: {units}");
    }

    /// A lead may show the first visemes before the audio starts.
    #[test]
    fn a_time_before_the_start_can_become_one_after_it(before_us in 0_i64..200_000, us in 0_u32..200_000) {
        let at = |time_us: i64| (time_us as f64 / 1e6, time_us as f32 / 1e6);
        let (double, single) = at(-before_us);
        let fps = Fps::whole(1000);
        let expected = Micros(-before_us).later(us).frame(fps, 1000);
        // At the exact start of a frame, the rounding of decimal fractions decides.
        if (i64::from(us) - before_us) % 1000 != 0 {
            prop_assert_eq!(Seconds(double).later(us).frame(fps, 1000), expected);
        }
        // Half a millisecond is far larger than the rounding of single precision.
        if (i64::from(us) - before_us) % 1000 == 500 {
            prop_assert_eq!(Seconds(single).later(us).frame(fps, 1000), expected);
        }
        prop_assert_eq!(Seconds(double).later(us).has_begun(), i64::from(us) >= before_us);
    }

    #[test]
    fn any_time_is_the_time_in_it(seconds in -1.0_f64..1e6, us in 0..2_000_000_u32, fps in 1..1000_u16) {
        fn same(time: impl Time, any: AnyTime, us: u32, fps: Fps) {
            assert_eq!(any.frame(fps, u32::MAX), time.frame(fps, u32::MAX));
            assert_eq!(any.later(us).frame(fps, 1000), time.later(us).frame(fps, 1000));
            assert_eq!(any.position(fps.into()), time.position(fps.into()));
            assert_eq!(any.has_begun(), time.has_begun());
        }
        let fps = Fps::whole(fps);
        let (micros, single) = (Micros((seconds * 1e6) as i64), Seconds(seconds as f32));
        let samples = Samples { position: (seconds * 48e3) as i64, rate_hz: 48_000 };
        same(micros, AnyTime::Micros(micros), us, fps);
        same(samples, AnyTime::Samples(samples), us, fps);
        same(single, AnyTime::SecondsF32(single), us, fps);
        same(Seconds(seconds), AnyTime::SecondsF64(Seconds(seconds)), us, fps);
    }
}

#[test]
fn what_is_no_time_is_never_later() {
    for time in [-1.0, -1e300, f64::NEG_INFINITY, f64::INFINITY, 1e300] {
        assert_eq!(Seconds(time).later(1000).0.to_bits(), time.to_bits());
    }
    assert!(Seconds(f64::NAN).later(1).0.is_nan() && !Seconds(f64::NAN).has_begun());
    assert!(Seconds(-0.0_f32).has_begun() && !Seconds(-1e-30_f32).has_begun());
    assert_eq!(Seconds(0.0_f64).later(500_000), Seconds(0.5));
    assert_eq!(Seconds(-0.041_667_f64).later(41_667).0.to_bits(), 0, "not a hair before the start");
    assert_eq!(Seconds(-0.041_667_f32).later(41_667).frame(Fps::whole(24), 9), Some(0));
    assert_eq!(Seconds(-0.02_f32).later(41_667).frame(Fps::whole(100), 9), Some(2));
    assert!(!Seconds(-0.05_f64).later(41_667).has_begun());
    assert_eq!(Seconds(5e-324_f64).later(0), Seconds(5e-324));
}
