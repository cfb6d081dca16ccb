//! The value of a curve: a number in thousandths.

use core::fmt;

/// The value of a curve, in whole thousandths: 2.2 is 2200.
///
/// ```
/// use lipz_types::CurveValue;
/// let sneer = CurveValue::from_thousandths(2200);
/// assert_eq!((sneer.thousandths(), sneer.to_string()), (2200, "2.2".to_owned()));
/// assert_eq!(CurveValue::from_thousandths(-50).to_f32(), -0.05);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[repr(transparent)] // the weights of a rig are numbers of 32 bits in C
pub struct CurveValue(i32);

/// The number of thousandths in 1.
const ONE: u32 = 1000;

impl CurveValue {
    /// Returns the value of this many thousandths.
    pub const fn from_thousandths(thousandths: i32) -> CurveValue {
        CurveValue(thousandths)
    }

    /// Returns the value in thousandths.
    pub const fn thousandths(self) -> i32 {
        self.0
    }

    /// Returns the value as a number: for values of at most seven digits, the nearest one.
    pub fn to_f32(self) -> f32 {
        self.0 as f32 / ONE as f32
    }

    /// Returns the value on the way from `self` to `to`, after `done` of `whole` steps, of which there are less than
    /// 2⁶². The value is computed exactly, then rounded to the nearest thousandth, a half away from `self`.
    ///
    /// ```
    /// # use lipz_types::CurveValue;
    /// let (zero, three) = (CurveValue::default(), CurveValue::from_thousandths(3));
    /// assert_eq!([0, 1, 2].map(|done| zero.towards(three, done, 2).thousandths()), [0, 2, 3]);
    /// assert_eq!([0, 1, 2].map(|done| three.towards(zero, done, 2).thousandths()), [3, 1, 0]);
    /// ```
    #[must_use]
    pub fn towards(self, to: CurveValue, done: u64, whole: u64) -> CurveValue {
        let distance = i64::from(to.0).wrapping_sub(i64::from(self.0));
        let part = i64::from(share(distance.unsigned_abs() as u32, done, whole));
        CurveValue(i64::from(self.0).wrapping_add(if distance < 0 { part.wrapping_neg() } else { part }) as i32)
    }
}

/// Returns `distance` · `done` / `whole`, rounded to the nearest, a half upwards. `done` must be less than `whole`, and
/// both below 2⁶².
///
/// Uses a division instruction if there is one for 64 bits and the product fits it. Otherwise uses a long division,
/// with one step for each bit of the distance: a dozen for most curves.
fn share(distance: u32, done: u64, whole: u64) -> u32 {
    if cfg!(target_pointer_width = "64") {
        let product = u64::from(distance).checked_mul(done).and_then(|product| product.checked_mul(2));
        if let Some(twice) = product.and_then(|product| product.checked_add(whole)) {
            return twice.checked_div(whole.wrapping_mul(2)).unwrap_or(0) as u32;
        }
    }
    long_share(distance, done, whole)
}

/// The same by long division.
fn long_share(distance: u32, done: u64, whole: u64) -> u32 {
    let (mut quotient, mut rest) = (0_u32, 0_u64);
    let mut bit = 32_u32.wrapping_sub(distance.leading_zeros());
    while bit > 0 {
        bit = bit.wrapping_sub(1);
        rest = rest.wrapping_mul(2).wrapping_add(if distance >> bit & 1 == 1 { done } else { 0 });
        quotient = quotient.wrapping_mul(2);
        // The rest and `done` are both less than the whole, so the sum is less than three wholes.
        for _ in 0..2 {
            if rest >= whole {
                rest = rest.wrapping_sub(whole);
                quotient = quotient.wrapping_add(1);
            }
        }
    }
    if rest.wrapping_mul(2) >= whole { quotient.wrapping_add(1) } else { quotient }
}

/// Prints the value as in Lipz files, without trailing zeros: `-0.05`.
impl fmt::Display for CurveValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.unsigned_abs();
        let (whole, thousandths) = (size / ONE, size % ONE);
        f.write_str(if self.0 < 0 { "-" } else { "" })?;
        match (thousandths % 10, thousandths % 100) {
            _ if thousandths == 0 => write!(f, "{whole}"),
            (_, 0) => write!(f, "{}.{}", whole, thousandths / 100),
            (0, _) => write!(f, "{}.{:02}", whole, thousandths / 10),
            _ => write!(f, "{whole}.{thousandths:03}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_divisions_agree() {
        for distance in [0, 1, 2, 999, 10_000, 65_535] {
            for (done, whole) in
                [(0, 2), (1, 2), (1, 3), (2, 3), (1 << 16, 12 << 16), (786_431, 786_432), (5 << 20, 7 << 30)]
            {
                assert_eq!(
                    share(distance, done, whole),
                    long_share(distance, done, whole),
                    "{distance} {done} {whole}"
                );
            }
        }
        assert_eq!(long_share(u32::MAX, (1 << 48) - 1, 1 << 48), u32::MAX);
    }
}
