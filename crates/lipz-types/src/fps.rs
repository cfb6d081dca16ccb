//! Frame rates as exact ratios, and the arithmetic from times to frame numbers.

use crate::Time;
use core::cmp::Ordering;
use core::fmt;

/// Microseconds in a second.
const MICROS_PER_SECOND: u64 = 1_000_000;

/// Microseconds of which the product with a rate of at most 1000 fits 64 bits. They are 571 years; no clip of
/// 2³² frames is as long.
pub(crate) const LATEST_US: u64 = 1 << 54;

/// A frame rate: an exact ratio of frames to seconds, from 1 to 1000 inclusive (Lipz specification,
/// element `fps`).
///
/// ```
/// use lipz_types::Fps;
/// const FILM: Fps = Fps::whole(24);
/// let ntsc = Fps::new(30_000, 1001).ok_or("out of range")?;
/// assert_eq!(Fps::new(48, 2), Some(FILM));
/// assert_eq!((ntsc.numerator(), ntsc.denominator()), (30_000, 1001));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Fps {
    numerator: u32,
    denominator: u32,
    /// ⌈2⁶⁴ · frames per microsecond⌉: lets `frame_at_micros` multiply instead of divide.
    frames_per_micro_q64: u64,
}

impl Fps {
    /// The rate of `numerator` frames in `denominator` seconds, in lowest terms; `None` outside
    /// 1 to 1000.
    #[allow(clippy::arithmetic_side_effects)] // 1000 · denominator fits 64 bits
    pub const fn new(numerator: u32, denominator: u32) -> Option<Fps> {
        if denominator == 0 || numerator < denominator || numerator as u64 > 1000 * denominator as u64 {
            return None;
        }
        let divisor = greatest_common_divisor(numerator, denominator);
        // No divisor is zero; checked division keeps a panic out of the machine code.
        match (numerator.checked_div(divisor), denominator.checked_div(divisor)) {
            (Some(numerator), Some(denominator)) => Fps::with_reciprocal(numerator, denominator),
            _ => None,
        }
    }

    /// A rate of whole frames per second, for constants.
    ///
    /// # Panics
    /// Outside 1 to 1000: in a `const`, that is a compile error.
    #[allow(clippy::panic)]
    pub const fn whole(frames_per_second: u16) -> Fps {
        match Fps::new(frames_per_second as u32, 1) {
            Some(fps) => fps,
            None => panic!("a frame rate lies between 1 and 1000"),
        }
    }

    #[allow(clippy::arithmetic_side_effects)] // numerator ≤ 1000 · denominator: fits 64 bits
    const fn with_reciprocal(numerator: u32, denominator: u32) -> Option<Fps> {
        let micros = denominator as u128 * MICROS_PER_SECOND as u128;
        match (((numerator as u128) << 64) + micros - 1).checked_div(micros) {
            Some(reciprocal) => Some(Fps { numerator, denominator, frames_per_micro_q64: reciprocal as u64 }),
            None => None,
        }
    }

    /// The rate of so many whole frames per second, at most 1000 and not checked: as [`Fps::new`] makes it,
    /// without a division of more than 32 bits.
    #[inline]
    #[allow(clippy::arithmetic_side_effects)] // 1000 rests of less than a million fit 32 bits
    pub const fn from_whole_unchecked(frames_per_second: u16) -> Fps {
        const QUOTIENT: u64 = ((1 << 64) / MICROS_PER_SECOND as u128) as u64;
        const REST: u32 = ((1 << 64) % MICROS_PER_SECOND as u128) as u32;
        let numerator = frames_per_second as u32;
        let rest = (numerator * REST + MICROS_PER_SECOND as u32 - 1) / MICROS_PER_SECOND as u32;
        Fps::from_parts_unchecked(numerator, 1, QUOTIENT.wrapping_mul(numerator as u64).wrapping_add(rest as u64))
    }

    /// The rate of these parts as a bank stores them, not checked: any query of a rate that is not
    /// [valid](Fps::is_valid) gives some number, and none panics.
    #[inline]
    pub const fn from_parts_unchecked(numerator: u32, denominator: u32, frames_per_micro_q64: u64) -> Fps {
        Fps { numerator, denominator, frames_per_micro_q64 }
    }

    /// Frames in [`Fps::denominator`] seconds.
    pub const fn numerator(self) -> u32 {
        self.numerator
    }

    /// Seconds in which [`Fps::numerator`] frames pass.
    pub const fn denominator(self) -> u32 {
        self.denominator
    }

    /// ⌈2⁶⁴ · frames per microsecond⌉, as stored in a bank.
    pub const fn frames_per_micro_q64(self) -> u64 {
        self.frames_per_micro_q64
    }

    /// The rate as the nearest floating-point number, for display.
    pub fn to_f64(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }

    /// Whether the ratio lies between 1 and 1000, is in lowest terms and has the right reciprocal.
    /// Needs no division of more than 32 bits.
    pub fn is_valid(self) -> bool {
        let (numerator, denominator) = (u64::from(self.numerator), u64::from(self.denominator));
        if denominator == 0
            || numerator < denominator
            || numerator > denominator.wrapping_mul(1000)
            || greatest_common_divisor(self.numerator, self.denominator) != 1
        {
            return false;
        }
        // reciprocal = ⌈n · 2⁶⁴ / d⌉ exactly if 0 ≤ reciprocal · d − n · 2⁶⁴ < d; d < 2⁵².
        let micros = u128::from(denominator).wrapping_mul(u128::from(MICROS_PER_SECOND));
        let product = u128::from(self.frames_per_micro_q64).wrapping_mul(micros);
        product.wrapping_sub(u128::from(numerator) << 64) < micros
    }

    /// The frame that shows at `time_us` microseconds, before [`LATEST_US`]: ⌊time · rate⌋ in exact arithmetic.
    ///
    /// The rounded-up reciprocal gives that number or one more (its error is below one for any
    /// 64-bit time); the sign of the remainder says which. The remainder is less than 2⁵² in
    /// size, so arithmetic modulo 2⁶⁴ suffices for it.
    #[inline]
    pub(crate) fn frame_at_micros(self, time_us: u64) -> u64 {
        if cfg!(target_pointer_width = "64") && self.denominator == 1 {
            return time_us.wrapping_mul(u64::from(self.numerator)) / MICROS_PER_SECOND;
        }
        let wide = u128::from(time_us).wrapping_mul(u128::from(self.frames_per_micro_q64));
        let estimate = (wide >> 64) as u64;
        let micros = u64::from(self.denominator).wrapping_mul(MICROS_PER_SECOND);
        let remainder = time_us.wrapping_mul(u64::from(self.numerator)).wrapping_sub(estimate.wrapping_mul(micros));
        estimate.wrapping_sub(remainder >> 63)
    }

    /// ⌊`time` · rate / `units_per_second`⌋, or `None` from `frame_count` on.
    ///
    /// `time` is below 2⁹⁴, `units_per_second` below 2³². A long division whose quotient has only
    /// as many bits as `frame_count`: a dozen steps for a clip, and no division instruction.
    pub(crate) fn frame_at_units(self, time: u128, units_per_second: u32, frame_count: u32) -> Option<u32> {
        let mut rest = time.wrapping_mul(u128::from(self.numerator));
        let divisor = u128::from(u64::from(self.denominator).wrapping_mul(u64::from(units_per_second)));
        if rest >= divisor.wrapping_mul(u128::from(frame_count)) {
            return None;
        }
        let mut frame = 0;
        let mut bit = 32_u32.wrapping_sub(frame_count.leading_zeros());
        while bit > 0 {
            bit = bit.wrapping_sub(1);
            let part = divisor << bit;
            if rest >= part {
                rest = rest.wrapping_sub(part);
                frame |= 1 << bit;
            }
        }
        Some(frame)
    }

    /// The frame that shows at `time`: ⌊time · rate⌋. `None` before 0, and from frame 2³² − 1 on.
    #[inline]
    pub fn frame_at<T: Time>(self, time: T) -> Option<u32> {
        time.frame(self, u32::MAX)
    }

    /// The first microsecond at which `frame` shows: ⌈frame / rate⌉ in exact arithmetic.
    ///
    /// Saturates at `u64::MAX` only for rates that no valid bank has.
    #[allow(clippy::arithmetic_side_effects)] // the divisor is not zero: `max(1)`
    pub fn start_of_frame_us(self, frame: u32) -> u64 {
        let numerator = u128::from(self.numerator.max(1));
        let micros =
            u128::from(frame).wrapping_mul(u128::from(self.denominator)).wrapping_mul(u128::from(MICROS_PER_SECOND));
        u64::try_from(micros.wrapping_add(numerator.wrapping_sub(1)) / numerator).unwrap_or(u64::MAX)
    }
}

/// The slower rate first. Equal are only the same ratios: both are in lowest terms.
impl Ord for Fps {
    fn cmp(&self, other: &Fps) -> Ordering {
        let product = |a: Fps, b: Fps| u64::from(a.numerator).wrapping_mul(u64::from(b.denominator));
        product(*self, *other)
            .cmp(&product(*other, *self))
            .then(self.frames_per_micro_q64.cmp(&other.frames_per_micro_q64))
    }
}

impl PartialOrd for Fps {
    fn partial_cmp(&self, other: &Fps) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[allow(clippy::arithmetic_side_effects)] // the divisor is not zero: it is the loop's condition
const fn greatest_common_divisor(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        let rest = a % b;
        a = b;
        b = rest;
    }
    a
}

/// The nearest decimal number, `29.97`.
impl fmt::Display for Fps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.to_f64(), f)
    }
}

impl fmt::Debug for Fps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Fps({}/{})", self.numerator, self.denominator)
    }
}
