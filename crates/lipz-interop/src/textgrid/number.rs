//! The numbers of a TextGrid, as Praat reads them (its functions `getReal` and `Melder_a8tof`): signed, also fractions
//! and percentages. Characters after the number are ignored.

use crate::Time;

/// A time in seconds, which may be below 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Seconds {
    is_negative: bool,
    size: Time,
}

/// The precision of times that are added: nanoseconds, as [`Time`] keeps them.
const NANOSECONDS: u32 = 1_000_000_000;

impl Seconds {
    pub(super) const ZERO: Seconds = Seconds { is_negative: false, size: Time::ZERO };

    /// Parses the number at the start of a word.
    pub(super) fn parse(word: &str) -> Option<Seconds> {
        let digits = word.strip_prefix(['-', '+']).unwrap_or(word);
        let (number, rest) = digits.split_at(length(digits)?);
        let size = Time::parse(number)?;
        let size = match rest.chars().next() {
            Some('/') => {
                let divisor = rest.get(1..).unwrap_or_default();
                ratio(size, Time::parse(divisor.get(..length(divisor)?)?)?)?
            }
            Some('%') => ratio(size, Time::new(100, 1))?,
            _ => size,
        };
        // `-0`, and what is left of 0 after a calculation in floating point, is 0.
        let is_negative = word.starts_with('-') && size.in_units(NANOSECONDS) > 0;
        Some(Seconds { is_negative, size })
    }

    pub(super) fn is_negative(self) -> bool {
        self.is_negative
    }

    /// Returns the time since an origin at or below 0; `None` if it is before the origin.
    pub(super) fn since(self, origin: Seconds) -> Option<Time> {
        if !origin.is_negative {
            return (!self.is_negative).then_some(self.size);
        }
        let [own, before] = [self, origin].map(|seconds| seconds.size.in_units(NANOSECONDS));
        let sum = if self.is_negative { before.checked_sub(own)? } else { before.checked_add(own)? };
        Some(Time::new(sum, NANOSECONDS))
    }
}

/// Parses a number of tiers or intervals, which some programs write as `2.0`.
pub(super) fn count(word: &str) -> Option<usize> {
    let number = Seconds::parse(word)?;
    let whole = number.size.in_units(1);
    (!number.is_negative && number.size == Time::new(whole, 1)).then(|| usize::try_from(whole).ok()).flatten()
}

fn ratio(dividend: Time, divisor: Time) -> Option<Time> {
    let divisor = u32::try_from(divisor.in_units(1000)).ok().filter(|divisor| *divisor > 0)?;
    Some(Time::new(dividend.in_units(NANOSECONDS).checked_mul(1000)? / u64::from(divisor), NANOSECONDS))
}

/// Returns the length of the unsigned decimal number at the start of a word.
fn length(word: &str) -> Option<usize> {
    let digits = |at: usize| word.bytes().skip(at).take_while(u8::is_ascii_digit).count();
    let is_at = |at: usize, bytes: &[u8]| word.as_bytes().get(at).is_some_and(|byte| bytes.contains(byte));
    let whole = digits(0);
    let fraction = if is_at(whole, b".") { digits(whole + 1) } else { 0 };
    if whole + fraction == 0 {
        return None;
    }
    let mantissa = if is_at(whole, b".") { whole + 1 + fraction } else { whole };
    if !is_at(mantissa, b"eE") {
        return Some(mantissa);
    }
    let sign = usize::from(is_at(mantissa + 1, b"+-"));
    match digits(mantissa + 1 + sign) {
        0 => Some(mantissa),
        exponent => Some(mantissa + 1 + sign + exponent),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_praat_reads() {
        for (word, negative, ms) in [
            ("-0", false, 0),
            ("-0.0e-5", false, 0),
            ("-1e-17", false, 0),
            ("-1.5", true, 1500),
            ("+2", false, 2000),
            ("1/4", false, 250),
            ("-3/2", true, 1500),
            ("25%", false, 250),
            ("1.25e-1x", false, 125),
            ("2e", false, 2000),
            ("1.", false, 1000),
        ] {
            let seconds = Seconds::parse(word).unwrap();
            assert_eq!((seconds.is_negative, seconds.size.in_units(1000)), (negative, ms), "{word}");
        }
        for word in ["", "-", "+x", ".", "--1", "e5", "1/0", "1/x", "x"] {
            assert_eq!(Seconds::parse(word), None, "{word}");
        }
        assert_eq!(["2", "2.0", "-0", "+3", "2.5", "-1"].map(count), [Some(2), Some(2), Some(0), Some(3), None, None]);
    }
}
