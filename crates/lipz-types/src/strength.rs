//! The strength of a gesture.

use crate::CurveValue;
use core::fmt;

/// The strength of a gesture: the 4 of `nods 4`. Usually 0 to 10, in whole thousandths.
///
/// ```
/// use lipz_types::Strength;
/// let strength = Strength::parse(b"2.5");
/// assert_eq!(strength.map(Strength::thousandths), Some(2500));
/// assert_eq!(Strength::parse(b"-1"), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Strength(u32);

/// The maximal number of digits after the decimal point.
const PLACES: u32 = 3;

impl Strength {
    /// Returns the strength with this number of thousandths, which is limited to 2³¹ - 1.
    pub const fn from_thousandths(thousandths: u32) -> Strength {
        Strength(if thousandths < i32::MAX as u32 { thousandths } else { i32::MAX as u32 })
    }

    /// Returns the strength in thousandths, at most 2³¹ - 1.
    pub const fn thousandths(self) -> u32 {
        self.0
    }

    /// Returns the strength as a number.
    pub fn to_f32(self) -> f32 {
        self.value().to_f32()
    }

    /// Parses digits, with a point and up to three more digits if the strength is not whole; `None` for anything else
    /// (`docs/guides/faces.md`, "Gestures in events").
    pub fn parse(text: &[u8]) -> Option<Strength> {
        let mut value = 0_u32;
        // The number of digits after the point so far.
        let mut places: Option<u32> = None;
        let mut has_digit = false;
        for &byte in text {
            match (byte, places) {
                (b'.', None) if has_digit => {
                    places = Some(0);
                    has_digit = false;
                }
                // Any number of trailing zeros is accepted.
                (b'0', Some(PLACES)) => {}
                (b'0'..=b'9', Some(PLACES)) => return None,
                (b'0'..=b'9', _) => {
                    value = value.checked_mul(10)?.checked_add(u32::from(byte.wrapping_sub(b'0')))?;
                    places = places.map(|places| places.wrapping_add(1));
                    has_digit = true;
                }
                _ => return None,
            }
        }
        for _ in places.unwrap_or(0)..PLACES {
            value = value.checked_mul(10)?;
        }
        if has_digit && value <= i32::MAX as u32 { Some(Strength(value)) } else { None }
    }

    fn value(self) -> CurveValue {
        CurveValue::from_thousandths(self.0 as i32)
    }
}

/// Prints the strength as written, without trailing zeros: `2.5`.
impl fmt::Display for Strength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value().fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn strengths_are_written_in_digits() {
        for (text, thousandths, shown) in [
            ("0", 0, "0"),
            ("4", 4000, "4"),
            ("007", 7000, "7"),
            ("2.5", 2500, "2.5"),
            ("1.250000", 1250, "1.25"),
            ("2147483.647", 2_147_483_647, "2147483.647"),
        ] {
            let strength = Strength::parse(text.as_bytes()).unwrap();
            assert_eq!((strength.thousandths(), strength.to_string().as_str()), (thousandths, shown), "{text}");
        }
        for text in ["", ".", "4.", ".5", "-1", "+1", "1.2345", "1.2.3", "2147483.648", "4294968", "１"] {
            assert_eq!(Strength::parse(text.as_bytes()), None, "{text}");
        }
    }
}
