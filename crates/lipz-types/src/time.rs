//! Points in time of a clip's audio, in the units that audio engines report.

use crate::position::sixteen_bits;
use crate::stored_fps::{LATEST_US, one_of};
use crate::{Position, StoredFps};

/// A point in time since the clip's audio began, in one of the units that audio engines report:
/// [`Micros`], [`Samples`], [`Seconds`] or [`core::time::Duration`]; [`AnyTime`] if the unit is known only at run time.
///
/// Every unit leads to the frame number of exact arithmetic, ⌊time · fps⌋ (Lipz specification, "Knowing which Viseme to
/// Show"). Times before the start, after the end, infinite or NaN are not errors: they lead to no frame, and so to
/// rest.
pub trait Time: Copy + sealed::Sealed {
    /// Returns the frame at this time, if it is one of the first `frame_count`.
    #[doc(hidden)]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32>;

    /// Whether this time is at or after the start.
    #[doc(hidden)]
    fn has_begun(self) -> bool;

    /// Returns the time `us` microseconds later. Integer units round up, floats to the nearest.
    #[doc(hidden)]
    fn later(self, us: u32) -> Self;

    /// Returns the part of `frame` that has passed at this time, which is in the frame, and the same for the whole
    /// frame; modulo 2⁶⁴.
    #[doc(hidden)]
    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64);

    /// Returns the frame at this time, and the part of it that has passed.
    #[doc(hidden)]
    fn position(self, fps: StoredFps) -> Position {
        match self.frame(fps, u32::MAX) {
            Some(frame) => {
                let (passed, whole) = self.since_start_of(frame, fps);
                Position { frame, sixteen_bits: sixteen_bits(passed, whole) }
            }
            None if self.has_begun() => Position::LAST,
            None => Position::START,
        }
    }
}

/// Returns the rest of `time` after the frames before `frame`. There are `per_second` units in a second.
fn rest_of_units(time: u64, per_second: u64, frame: u32, fps: StoredFps) -> (u64, u64) {
    let whole = per_second.wrapping_mul(u64::from(fps.denominator()));
    let frames = time.wrapping_mul(u64::from(fps.numerator()));
    (frames.wrapping_sub(whole.wrapping_mul(u64::from(frame))), whole)
}

/// Microseconds in a second.
const MICROS_PER_SECOND: u32 = 1_000_000;
/// Nanoseconds in a second.
const NANOS_PER_SECOND: u64 = 1_000_000_000;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Micros {}
    impl Sealed for super::Samples {}
    impl Sealed for super::Seconds<f32> {}
    impl Sealed for super::Seconds<f64> {}
    impl Sealed for core::time::Duration {}
    impl Sealed for super::AnyTime {}
}

/// Microseconds since the clip's audio began. The fastest unit: no division, no loop.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Micros(pub i64);

impl Time for Micros {
    #[inline]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32> {
        // Times before the start become very large, so they are past the latest one as well.
        let time_us = self.0 as u64;
        if time_us >= LATEST_US {
            return None;
        }
        let frame = fps.into().frame_at_micros(time_us);
        if frame < u64::from(frame_count) { Some(frame as u32) } else { None }
    }

    #[inline]
    fn has_begun(self) -> bool {
        self.0 >= 0
    }

    #[inline]
    fn later(self, us: u32) -> Self {
        Micros(self.0.saturating_add(i64::from(us)))
    }

    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64) {
        rest_of_units(self.0 as u64, u64::from(MICROS_PER_SECOND), frame, fps)
    }
}

/// A position in samples, with a sample rate.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Samples {
    /// Samples per channel since the clip's audio began.
    pub position: i64,
    /// Samples per second and channel. At rate 0 no frame shows.
    pub rate_hz: u32,
}

impl Time for Samples {
    #[inline]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32> {
        if self.position < 0 || self.rate_hz == 0 {
            return None;
        }
        fps.into().frame_at_units(self.position as u128, self.rate_hz, frame_count)
    }

    #[inline]
    fn has_begun(self) -> bool {
        self.position >= 0 && self.rate_hz > 0
    }

    #[allow(clippy::arithmetic_side_effects)] // the divisor is not zero
    fn later(self, us: u32) -> Self {
        let millionths = u64::from(us).wrapping_mul(u64::from(self.rate_hz));
        let micros = u64::from(MICROS_PER_SECOND);
        let samples = (millionths / micros).wrapping_add(u64::from(millionths % micros != 0));
        Samples { position: self.position.saturating_add(samples as i64), ..self }
    }

    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64) {
        rest_of_units(self.position as u64, u64::from(self.rate_hz), frame, fps)
    }
}

impl Time for core::time::Duration {
    #[inline]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32> {
        fps.into().frame_at_units(self.as_nanos(), NANOS_PER_SECOND as u32, frame_count)
    }

    #[inline]
    fn has_begun(self) -> bool {
        true
    }

    #[inline]
    fn later(self, us: u32) -> Self {
        self.saturating_add(core::time::Duration::from_micros(u64::from(us)))
    }

    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64) {
        rest_of_units(self.as_nanos() as u64, NANOS_PER_SECOND, frame, fps)
    }
}

/// Seconds in floating point, `f32` or `f64`.
///
/// A floating-point time is rounded, so a host that computes the start of frame *n* as `n / fps` often ends slightly
/// before it. The rule: the frame is that of the time **two units in the last place later** (at most 2⁻²² of an `f32`
/// time, 2⁻⁵¹ of an `f64` one), in exact arithmetic. With it, `n / fps` leads to frame *n* for every *n* in `f64`, and
/// up to 2²¹ (a day at 24 fps) in `f32`. If your engine has an integer clock, use [`Micros`] or [`Samples`].
///
/// ```
/// # use lipz_types::{Fps, Seconds};
/// let start_of_frame_123 = 123.0_f64 / 30.0;
/// assert!(start_of_frame_123 * 30.0 < 123.0); // the naive product shows frame 122
/// assert_eq!(Fps::whole(30).frame_at(Seconds(start_of_frame_123)), Some(123));
/// ```
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Seconds<T>(pub T);

impl Seconds<f32> {
    /// Returns mantissa and shift: the time is `mantissa` · 2^−`shift` seconds. `None` if it is negative, infinite or
    /// NaN.
    #[inline]
    fn parts(self) -> Option<(u64, i32)> {
        let bits = self.0.to_bits();
        let exponent = bits >> 23; // the sign is above its eight bits
        let fraction = u64::from(bits & 0x7F_FFFF);
        match exponent {
            _ if bits == 1 << 31 => Some((0, 149)), // -0.0
            255.. => None,
            0 => Some((fraction, 149)),
            _ => Some((fraction | 1 << 23, 150_i32.wrapping_sub(exponent as i32))),
        }
    }
}

impl Time for Seconds<f32> {
    #[inline]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32> {
        let (mantissa, shift) = self.parts()?;
        frame_at_float(fps.into(), frame_count, mantissa, shift)
    }

    #[inline]
    fn has_begun(self) -> bool {
        self.parts().is_some() || self.0.to_bits() == f32::INFINITY.to_bits()
    }

    fn later(self, us: u32) -> Self {
        let digits = f32::MANTISSA_DIGITS;
        let is_before = self.0.to_bits() > 1 << 31;
        let parts = Seconds(f32::from_bits(self.0.to_bits() & u32::MAX >> 1)).parts();
        match parts.and_then(|(mantissa, shift)| later_float(mantissa, shift, is_before, us, digits)) {
            Some((0, _)) => Seconds(0.0),
            Some((mantissa, shift)) => {
                let exponent = 149_i32.wrapping_sub(shift) as u32;
                Seconds(f32::from_bits((mantissa as u32).wrapping_add(exponent << 23)))
            }
            None => self,
        }
    }

    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64) {
        self.parts().map_or((0, 1), |(mantissa, shift)| rest_of_float(mantissa, shift, frame, fps))
    }
}

impl Seconds<f64> {
    /// Returns mantissa and shift: the time is `mantissa` · 2^−`shift` seconds. `None` if it is negative, infinite or
    /// NaN.
    #[inline]
    fn parts(self) -> Option<(u64, i32)> {
        let bits = self.0.to_bits();
        let exponent = bits >> 52; // the sign is above its eleven bits
        let fraction = bits & 0xF_FFFF_FFFF_FFFF;
        match exponent {
            _ if bits == 1 << 63 => Some((0, 1074)), // -0.0
            2047.. => None,
            0 => Some((fraction, 1074)),
            _ => Some((fraction | 1 << 52, 1075_i32.wrapping_sub(exponent as i32))),
        }
    }
}

impl Time for Seconds<f64> {
    #[inline]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32> {
        let (mantissa, shift) = self.parts()?;
        frame_at_float(fps.into(), frame_count, mantissa, shift)
    }

    #[inline]
    fn has_begun(self) -> bool {
        self.parts().is_some() || self.0.to_bits() == f64::INFINITY.to_bits()
    }

    fn later(self, us: u32) -> Self {
        let digits = f64::MANTISSA_DIGITS;
        let is_before = self.0.to_bits() > 1 << 63;
        let parts = Seconds(f64::from_bits(self.0.to_bits() & u64::MAX >> 1)).parts();
        match parts.and_then(|(mantissa, shift)| later_float(mantissa, shift, is_before, us, digits)) {
            Some((0, _)) => Seconds(0.0),
            Some((mantissa, shift)) => {
                let exponent = 1074_i32.wrapping_sub(shift) as u64;
                Seconds(f64::from_bits(mantissa.wrapping_add(exponent << 52)))
            }
            None => self,
        }
    }

    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64) {
        self.parts().map_or((0, 1), |(mantissa, shift)| rest_of_float(mantissa, shift, frame, fps))
    }
}

/// Returns the frame at (`mantissa` + 2) · 2^−`shift` seconds.
///
/// With whole units (`shift` ≤ 0), the time is at least 2²³ seconds, or 97 days. From 2⁷⁵ seconds on, no clip of 2³²
/// frames at one frame per second is that long.
#[inline]
fn frame_at_float(fps: StoredFps, frame_count: u32, mantissa: u64, shift: i32) -> Option<u32> {
    if cfg!(target_pointer_width = "64") && fps.denominator() == 1 && (1..64).contains(&shift) {
        // A whole rate is at most 1000, so the product fits 64 bits.
        let frames = mantissa.wrapping_add(2).wrapping_mul(u64::from(fps.numerator())) >> shift;
        return if frames < u64::from(frame_count) { Some(frames as u32) } else { None };
    }
    wide_frame_at_float(fps, frame_count, mantissa, shift)
}

/// The same for any rate and any time.
#[cfg_attr(target_pointer_width = "64", cold, inline(never))]
fn wide_frame_at_float(fps: StoredFps, frame_count: u32, mantissa: u64, shift: i32) -> Option<u32> {
    let time = u128::from(mantissa.wrapping_add(2));
    if shift <= 0 {
        let shift = shift.unsigned_abs();
        return if shift > 22 { None } else { fps.frame_at_units(time << shift, 1, frame_count) };
    }
    // ⌊⌊t · n / 2^shift⌋ / d⌋ = ⌊t · n / (2^shift · d)⌋, and t · n has fewer than 87 bits.
    let frames = time.wrapping_mul(u128::from(fps.numerator()));
    let frames = if shift < 128 { frames >> shift } else { 0 };
    // The numerator is already included: divide by the denominator only.
    if fps.denominator() == 1 {
        return one_of(frames, frame_count);
    }
    StoredFps::from_parts(1, fps.denominator(), 0)?.frame_at_units(frames, 1, frame_count)
}

/// Returns the time `us` microseconds after `mantissa` · 2^−`shift` seconds, or after the same time before the start,
/// as a mantissa with this number of digits and its shift.
///
/// `None` if nothing is added: `us` is 0, the sum is still before the start, or the time is so late (from 2²⁴ s in
/// single precision) that its unit is two seconds or more, where leads are ignored.
///
/// Uses integers only, because small processors have no floating-point unit, or one for single precision only.
fn later_float(mantissa: u64, shift: i32, is_before: bool, us: u32, digits: u32) -> Option<(u64, i32)> {
    /// ⌈2⁹⁶ / 10⁶⌉
    const MICRO_Q96: u128 = (1_u128 << 96) / MICROS_PER_SECOND as u128 + 1;
    if shift < 0 || us == 0 {
        return None;
    }
    // In units of 2^−64 seconds: fewer than 118 bits. The lowest ones are rounded away.
    let seconds = |mantissa: u64| if shift < 128 { u128::from(mantissa) << 64 >> shift } else { 0 };
    let (time, added) = (seconds(mantissa), u128::from(us).wrapping_mul(MICRO_Q96) >> 32);
    let sum = match added.checked_sub(time) {
        _ if !is_before => time.wrapping_add(added),
        Some(sum) => sum,
        // The start, within the tolerance of two units in the last place.
        None if time.wrapping_sub(added) <= seconds(2) => 0,
        None => return None,
    };
    let excess = 128_i32.wrapping_sub(sum.leading_zeros() as i32).wrapping_sub(digits as i32);
    let rounded = match excess {
        1.. => (sum >> excess.wrapping_sub(1)).wrapping_add(1) >> 1,
        _ => sum << excess.unsigned_abs(),
    };
    Some((rounded as u64, 64_i32.wrapping_sub(excess)))
}

/// Returns the rest of (`mantissa` + 2) · 2^−`shift` seconds after the frames before `frame`, in 65,536ths of the time
/// that a numerator of frames takes.
fn rest_of_float(mantissa: u64, shift: i32, frame: u32, fps: StoredFps) -> (u64, u64) {
    let frames = u128::from(mantissa.wrapping_add(2)).wrapping_mul(u128::from(fps.numerator()));
    // Fewer than 87 bits, and 16 more; up to 22 more for whole units.
    let shifted = match shift.wrapping_sub(16) {
        left @ -38..=0 => frames.wrapping_shl(left.unsigned_abs()),
        right @ 1..=127 => frames >> right,
        _ => 0,
    };
    let whole = u64::from(fps.denominator()) << 16;
    ((shifted as u64).wrapping_sub(whole.wrapping_mul(u64::from(frame))), whole)
}

/// A time whose unit is known only at run time, such as one from an engine's clock or a program in another language.
///
/// It leads to the same frames as the time that it contains. The code for each unit is compiled once.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum AnyTime {
    /// Microseconds.
    Micros(Micros),
    /// Samples.
    Samples(Samples),
    /// Seconds in single precision.
    SecondsF32(Seconds<f32>),
    /// Seconds in double precision.
    SecondsF64(Seconds<f64>),
}

impl Time for AnyTime {
    #[inline(never)]
    fn frame(self, fps: impl Into<StoredFps>, frame_count: u32) -> Option<u32> {
        match self {
            AnyTime::Micros(time) => time.frame(fps, frame_count),
            AnyTime::Samples(time) => time.frame(fps, frame_count),
            AnyTime::SecondsF32(time) => time.frame(fps, frame_count),
            AnyTime::SecondsF64(time) => time.frame(fps, frame_count),
        }
    }

    fn has_begun(self) -> bool {
        match self {
            AnyTime::Micros(time) => time.has_begun(),
            AnyTime::Samples(time) => time.has_begun(),
            AnyTime::SecondsF32(time) => time.has_begun(),
            AnyTime::SecondsF64(time) => time.has_begun(),
        }
    }

    #[inline(never)]
    fn later(self, us: u32) -> Self {
        match self {
            AnyTime::Micros(time) => AnyTime::Micros(time.later(us)),
            AnyTime::Samples(time) => AnyTime::Samples(time.later(us)),
            AnyTime::SecondsF32(time) => AnyTime::SecondsF32(time.later(us)),
            AnyTime::SecondsF64(time) => AnyTime::SecondsF64(time.later(us)),
        }
    }

    fn since_start_of(self, frame: u32, fps: StoredFps) -> (u64, u64) {
        match self {
            AnyTime::Micros(time) => time.since_start_of(frame, fps),
            AnyTime::Samples(time) => time.since_start_of(frame, fps),
            AnyTime::SecondsF32(time) => time.since_start_of(frame, fps),
            AnyTime::SecondsF64(time) => time.since_start_of(frame, fps),
        }
    }
}
