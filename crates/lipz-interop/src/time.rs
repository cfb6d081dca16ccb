//! Exact times, which do not lose precision in any unit before frames are chosen.

use lipz_file::rate::Rate;
use std::cmp::Ordering;
use std::fmt;

/// The number of decimal places of seconds that are kept: nanoseconds. More are rounded.
const MAX_PLACES: u32 = 9;
/// The units per second of times from binary floating-point numbers.
const FLOAT_UNITS: u32 = 1 << 30;

/// A time since the start of the recording: an exact number of seconds.
///
/// Milliseconds, ticks of 100 ns, samples and frames of any rate are all fractions, and are compared exactly.
///
/// ```
/// use lipz_interop::Time;
/// assert_eq!(Time::new(250, 1000), Time::parse("0.25").ok_or("a number")?);
/// assert!(Time::new(1, 24) > Time::parse("0.0416").ok_or("a number")?);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Time {
    units: u64,
    /// The units per second, not 0.
    per_second: u32,
}

impl Time {
    /// The start of the recording.
    pub const ZERO: Time = Time { units: 0, per_second: 1 };

    /// Returns the time of `units` at `per_second` units per second (0 counts as 1).
    pub const fn new(units: u64, per_second: u32) -> Time {
        Time { units, per_second: if per_second == 0 { 1 } else { per_second } }
    }

    /// Returns the start of a frame at a rate. The first is frame 0.
    pub const fn of_frame(frame: u64, rate: Rate) -> Time {
        Time::new(frame.saturating_mul(rate.denominator as u64), rate.numerator)
    }

    /// Parses seconds in decimal digits, such as `1.25` or `1e-2`, to the nanosecond. Returns `None` if they are not a
    /// number, negative, or exceed 64 bits.
    pub fn parse(seconds: &str) -> Option<Time> {
        let (mantissa, exponent) = seconds.split_once(['e', 'E']).unwrap_or((seconds, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let exponent: i32 = exponent.strip_prefix('+').unwrap_or(exponent).parse().ok()?;
        let digits = || whole.bytes().chain(fraction.bytes());
        if digits().next().is_none() || !digits().all(|byte| byte.is_ascii_digit()) {
            return None;
        }
        let mut places = i32::try_from(fraction.len()).ok()?.checked_sub(exponent)?;
        let mut value: u128 = 0;
        for digit in digits() {
            value = value.checked_mul(10)?.checked_add(u128::from(digit - b'0'))?;
        }
        while places < 0 && value != 0 {
            value = value.checked_mul(10)?;
            places += 1;
        }
        let mut places = u32::try_from(places).unwrap_or(0);
        if let Some(cut_off) = places.checked_sub(MAX_PLACES).filter(|cut_off| *cut_off > 0) {
            // Beyond 38 digits, the scale does not fit, and the value is less than a nanosecond.
            let scale = 10_u128.checked_pow(cut_off);
            value = scale.map_or(0, |scale| value.saturating_add(scale / 2) / scale);
            places = MAX_PLACES;
        }
        Some(Time::new(u64::try_from(value).ok()?, 10_u32.pow(places)))
    }

    /// Converts seconds as a binary floating-point number; `None` if it is not a number, negative or too large.
    pub fn from_f32(seconds: f32) -> Option<Time> {
        let units = f64::from(seconds) * f64::from(FLOAT_UNITS);
        let is_time = units.is_finite() && units > -0.5 && units < 2_f64.powi(63);
        // In range, and the rounding error is far less than any frame.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        is_time.then(|| Time::new(units.round() as u64, FLOAT_UNITS))
    }

    /// Returns the seconds as the nearest floating-point number.
    #[allow(clippy::cast_precision_loss, reason = "the nearest one is meant")]
    pub fn as_f64(self) -> f64 {
        self.units as f64 / f64::from(self.per_second)
    }

    /// Returns the time halfway between two times, with a precision of 2⁻³⁰ seconds.
    pub fn midpoint(self, other: Time) -> Time {
        Time::new(u64::midpoint(self.in_units(FLOAT_UNITS), other.in_units(FLOAT_UNITS)), FLOAT_UNITS)
    }

    /// Returns the time in units of `per_second` per second, rounded to the nearest.
    pub fn in_units(self, per_second: u32) -> u64 {
        nearest(u128::from(self.units) * u128::from(per_second), u128::from(self.per_second))
    }

    /// Returns the frame boundary nearest to the time: the number of frames before it.
    pub fn nearest_frame(self, rate: Rate) -> u64 {
        let (frames, scale) = self.frames(rate);
        nearest(frames, scale)
    }

    /// Returns the frame at this time.
    pub fn frame(self, rate: Rate) -> u64 {
        let (frames, scale) = self.frames(rate);
        fit(frames / scale)
    }

    /// Returns the number of frames that have started before the time.
    pub fn frames_begun(self, rate: Rate) -> u64 {
        let (frames, scale) = self.frames(rate);
        fit(frames.div_ceil(scale))
    }

    /// Returns the time in frames, as a ratio.
    fn frames(self, rate: Rate) -> (u128, u128) {
        let frames = u128::from(self.units) * u128::from(rate.numerator);
        (frames, u128::from(self.per_second) * u128::from(rate.denominator.max(1)))
    }
}

fn nearest(dividend: u128, divisor: u128) -> u64 {
    fit((dividend + divisor / 2) / divisor)
}

fn fit(number: u128) -> u64 {
    u64::try_from(number).unwrap_or(u64::MAX)
}

impl Default for Time {
    fn default() -> Time {
        Time::ZERO
    }
}

impl PartialEq for Time {
    fn eq(&self, other: &Time) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Time {}

impl PartialOrd for Time {
    fn partial_cmp(&self, other: &Time) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Time {
    fn cmp(&self, other: &Time) -> Ordering {
        let scaled = |time: &Time, other: &Time| u128::from(time.units) * u128::from(other.per_second);
        scaled(self, other).cmp(&scaled(other, self))
    }
}

/// Prints seconds to the millisecond, as in messages: `1.250 s`.
impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = self.in_units(1000);
        write!(f, "{}.{:03} s", ms / 1000, ms % 1000)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    const NTSC: Rate = Rate { numerator: 2997, denominator: 125, is_exact: true };

    #[test]
    fn decimal_seconds_are_exact() {
        for (text, units, per_second) in [
            ("0.04", 4, 100),
            ("12", 12, 1),
            ("1.5e1", 15, 1),
            ("25e-3", 25, 1000),
            (".5", 1, 2),
            ("0.1234567895", 123_456_790, 1_000_000_000),
        ] {
            assert_eq!(Time::parse(text), Some(Time::new(units, per_second)), "{text}");
        }
        for text in ["", ".", "-1", "1,5", "NaN", "1e99", "1e", "0x1", " 1", "99999999999999999999"] {
            assert_eq!(Time::parse(text), None, "{text}");
        }
        assert_eq!(Time::parse("1e-60"), Some(Time::ZERO));
        assert_eq!(Time::parse("0e999999999"), Some(Time::ZERO));
    }

    #[test]
    fn frames_of_fractional_rates() {
        for frame in [0, 1, 23, 24, 1_000_003] {
            let time = Time::of_frame(frame, NTSC);
            assert_eq!((time.frame(NTSC), time.nearest_frame(NTSC), time.frames_begun(NTSC)), (frame, frame, frame));
        }
        let late = Time::parse("0.06").unwrap();
        assert_eq!((late.frame(NTSC), late.nearest_frame(NTSC), late.frames_begun(NTSC)), (1, 1, 2));
    }

    #[test]
    fn midpoints_lie_between() {
        let half = Time::new(1, 4).midpoint(Time::new(750, 1000));
        assert_eq!(half, Time::new(1, 2));
        assert_eq!(Time::ZERO.midpoint(Time::ZERO), Time::ZERO);
    }

    #[test]
    fn floating_point_seconds_return() {
        for seconds in [0.0_f32, 0.041_666_668, 1.1, 3.733_333, 599.99] {
            let time = Time::from_f32(seconds).unwrap();
            #[allow(clippy::cast_possible_truncation)]
            let back = time.as_f64() as f32;
            assert_eq!(back.to_bits(), seconds.to_bits());
        }
        for seconds in [f32::NAN, f32::INFINITY, -1.0, f32::MAX] {
            assert_eq!(Time::from_f32(seconds), None);
        }
    }
}
