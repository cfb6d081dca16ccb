//! Frame rates as stored in banks, and the conversion of times to frame numbers.

use crate::Fps;
use crate::fps::{MICROS_PER_SECOND, greatest_common_divisor};
use core::num::NonZeroU32;

/// The limit of microseconds, below which the product with a rate of at most 1000 fits 64 bits. That is 571 years,
/// longer than any clip of 2³² frames at such a rate.
pub(crate) const LATEST_US: u64 = 1 << 54;

/// A frame rate as stored in a bank. It is not checked, so that queries need not check it for every rendered frame.
/// Every method returns some value, and none panics.
///
/// This is for readers of banks. Programs get an [`Fps`], which is always valid.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct StoredFps {
    numerator: NonZeroU32,
    denominator: u32,
    /// ⌈2⁶⁴ · frames per microsecond⌉: lets `frame_at_micros` multiply instead of divide.
    frames_per_micro_q64: u64,
}

impl StoredFps {
    /// Returns the rate of these parts; `None` if there are no frames.
    #[inline]
    pub const fn from_parts(numerator: u32, denominator: u32, frames_per_micro_q64: u64) -> Option<StoredFps> {
        match NonZeroU32::new(numerator) {
            Some(numerator) => Some(StoredFps { numerator, denominator, frames_per_micro_q64 }),
            None => None,
        }
    }

    /// Returns a rate of whole frames per second, at most 1000, without a division of more than 32 bits; `None` for 0.
    #[inline]
    #[allow(clippy::arithmetic_side_effects)] // 1000 rests of less than a million fit 32 bits
    pub const fn from_whole(frames_per_second: u16) -> Option<StoredFps> {
        const QUOTIENT: u64 = ((1 << 64) / MICROS_PER_SECOND as u128) as u64;
        const REST: u32 = ((1 << 64) % MICROS_PER_SECOND as u128) as u32;
        let numerator = frames_per_second as u32;
        let rest = (numerator.wrapping_mul(REST).wrapping_add(MICROS_PER_SECOND as u32 - 1)) / MICROS_PER_SECOND as u32;
        StoredFps::from_parts(numerator, 1, QUOTIENT.wrapping_mul(numerator as u64).wrapping_add(rest as u64))
    }

    /// Returns a valid rate, or `None` unless it is between 1 and 1000, in lowest terms, with the correct reciprocal.
    /// Needs no division of more than 32 bits.
    pub fn checked(self) -> Option<Fps> {
        let (numerator, denominator) = (u64::from(self.numerator.get()), u64::from(self.denominator));
        if denominator == 0
            || numerator < denominator
            || numerator > denominator.wrapping_mul(1000)
            || greatest_common_divisor(self.numerator.get(), self.denominator) != 1
        {
            return None;
        }
        // reciprocal = ⌈n · 2⁶⁴ / d⌉ exactly if 0 ≤ reciprocal · d − n · 2⁶⁴ < d; d < 2⁵².
        let micros = u128::from(denominator).wrapping_mul(u128::from(MICROS_PER_SECOND));
        let product = u128::from(self.frames_per_micro_q64).wrapping_mul(micros);
        let is_right = product.wrapping_sub(u128::from(numerator) << 64) < micros;
        if is_right { Some(Fps::from_checked(self)) } else { None }
    }

    #[inline]
    pub(crate) const fn numerator(self) -> u32 {
        self.numerator.get()
    }

    #[inline]
    pub(crate) const fn denominator(self) -> u32 {
        self.denominator
    }

    pub(crate) const fn frames_per_micro_q64(self) -> u64 {
        self.frames_per_micro_q64
    }

    /// Returns the frame at `time_us` microseconds, before [`LATEST_US`]: ⌊time · rate⌋ in exact arithmetic.
    ///
    /// The rounded-up reciprocal leads to that number or one more, because its error is below one for any 64-bit time.
    /// The sign of the remainder decides. The remainder's absolute value is less than 2⁵², so arithmetic modulo 2⁶⁴
    /// suffices.
    #[inline]
    pub(crate) fn frame_at_micros(self, time_us: u64) -> u64 {
        if cfg!(target_pointer_width = "64") && self.denominator() == 1 {
            return time_us.wrapping_mul(u64::from(self.numerator())) / MICROS_PER_SECOND;
        }
        seldom();
        let wide = u128::from(time_us).wrapping_mul(u128::from(self.frames_per_micro_q64));
        let estimate = (wide >> 64) as u64;
        let micros = u64::from(self.denominator()).wrapping_mul(MICROS_PER_SECOND);
        let remainder = time_us.wrapping_mul(u64::from(self.numerator())).wrapping_sub(estimate.wrapping_mul(micros));
        estimate.wrapping_sub(remainder >> 63)
    }

    /// Returns ⌊`time` · rate / `units_per_second`⌋, or `None` from `frame_count` on.
    ///
    /// `time` is below 2⁹⁴, `units_per_second` below 2³². 64-bit processors use a division instruction for times that
    /// fit it: hours. Other processors and longer times use a long division whose quotient has only as many bits as
    /// `frame_count`: a dozen steps for a clip.
    pub(crate) fn frame_at_units(self, time: u128, units_per_second: u32, frame_count: u32) -> Option<u32> {
        let mut rest = time.wrapping_mul(u128::from(self.numerator()));
        let divisor = u128::from(u64::from(self.denominator()).wrapping_mul(u64::from(units_per_second)));
        if cfg!(target_pointer_width = "64") && rest <= u128::from(u64::MAX) && divisor <= u128::from(u64::MAX) {
            return one_of(u128::from((rest as u64).checked_div(divisor as u64)?), frame_count);
        }
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

    /// Returns the first microsecond of `frame`: ⌈frame / rate⌉ in exact arithmetic.
    ///
    /// Saturates at `u64::MAX` only for rates that no valid bank has.
    // Not inlined where memory is scarce, because several places need it.
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub fn start_of_frame_us(self, frame: u32) -> u64 {
        let numerator = core::num::NonZeroU64::from(self.numerator);
        let parts = u64::from(frame).wrapping_mul(u64::from(self.denominator()));
        // Whole seconds and the rest: 128 bits are not needed, which no processor divides at once.
        let (seconds, rest) = (parts / numerator, parts % numerator);
        let micros = rest.wrapping_mul(MICROS_PER_SECOND);
        let rounded_up = micros.wrapping_add(numerator.get().wrapping_sub(1)) / numerator;
        seconds.checked_mul(MICROS_PER_SECOND).and_then(|us| us.checked_add(rounded_up)).unwrap_or(u64::MAX)
    }
}

/// Marks a rare path, because few rates are not whole numbers. Its code is placed after the others, and is just as
/// fast.
#[cold]
const fn seldom() {}

/// Returns the frame, if it is one of the first `frame_count`.
#[inline]
pub(crate) fn one_of(frame: u128, frame_count: u32) -> Option<u32> {
    if frame < u128::from(frame_count) { Some(frame as u32) } else { None }
}
