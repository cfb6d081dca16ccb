//! How far something is moved, in whole numbers.

/// How far something is moved, such as a mouth opened: 0 to 9900 ten-thousandths.
///
/// The digit *d* of a loop or of an `rms` clip stands for 0.11 · *d*; the product of two digits, one of a
/// loop and one of a power transfer, for 0.0121 of it. Both are whole numbers of ten-thousandths: 1100 · *d*, 121 · *d* · *e*.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Weight(u16);

/// Ten-thousandths that a digit stands for.
const PER_DIGIT: u16 = 1100;
/// Ten-thousandths of a product of two digits.
const PER_PRODUCT: u16 = 121;
/// Ten-thousandths in 1.
const ONE: f32 = 10_000.0;

impl Weight {
    /// The weight of a digit, `b'0'` to `b'9'`; of any other byte, 0.
    #[inline]
    pub const fn from_digit(code: u8) -> Weight {
        Weight(digit(code).wrapping_mul(PER_DIGIT))
    }

    /// The weight of the product of two digits; 0 if one is none.
    #[inline]
    pub const fn from_digits(one: u8, other: u8) -> Weight {
        Weight(digit(one).wrapping_mul(digit(other)).wrapping_mul(PER_PRODUCT))
    }

    /// The weight in ten-thousandths.
    pub const fn ten_thousandths(self) -> u16 {
        self.0
    }

    /// The weight as a fraction, 0 to 0.99.
    pub fn to_f32(self) -> f32 {
        f32::from(self.0) / ONE
    }
}

/// The value of a digit; 0 if it is none.
const fn digit(code: u8) -> u16 {
    if code.is_ascii_digit() { code.wrapping_sub(b'0') as u16 } else { 0 }
}
