//! The amount of a movement, in whole numbers.

/// The amount of a movement, such as opening the mouth: 0 to 9900 ten-thousandths.
///
/// The digit *d* of a loop or of an `rms` clip stands for 0.11 · *d*. The product of two digits *d* and *e*, one of a
/// loop and one of a power transfer, stands for 0.0121 · *d* · *e*. Both are whole numbers of ten-thousandths: 1100 ·
/// *d*, 121 · *d* · *e*.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Weight(u16);

/// The weight of a digit of 1, in ten-thousandths.
const PER_DIGIT: u16 = 1100;
/// The weight of a product of 1, in ten-thousandths.
const PER_PRODUCT: u16 = 121;
/// The number of ten-thousandths in 1.
const ONE: f32 = 10_000.0;

impl Weight {
    /// Returns the weight of a digit, `b'0'` to `b'9'`; 0 for any other byte.
    #[inline]
    pub const fn from_digit(code: u8) -> Weight {
        Weight(digit(code).wrapping_mul(PER_DIGIT))
    }

    /// Returns the weight of the product of two digits; 0 if one of them is not a digit.
    #[inline]
    pub const fn from_digits(one: u8, other: u8) -> Weight {
        Weight(digit(one).wrapping_mul(digit(other)).wrapping_mul(PER_PRODUCT))
    }

    /// Returns the weight in ten-thousandths.
    pub const fn ten_thousandths(self) -> u16 {
        self.0
    }

    /// Returns the weight as a fraction, from 0 to 0.99.
    pub fn to_f32(self) -> f32 {
        f32::from(self.0) / ONE
    }
}

/// Returns the value of a digit; 0 for any other byte.
const fn digit(code: u8) -> u16 {
    if code.is_ascii_digit() { code.wrapping_sub(b'0') as u16 } else { 0 }
}
