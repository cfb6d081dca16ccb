//! Frame rates as exact ratios.

use crate::{StoredFps, Time};
use core::cmp::Ordering;
use core::fmt;

/// Microseconds in a second.
pub(crate) const MICROS_PER_SECOND: u64 = 1_000_000;

/// A frame rate: an exact ratio of frames to seconds, from 1 to 1000 inclusive (Lipz specification, element `fps`).
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
pub struct Fps(StoredFps);

impl Fps {
    /// Returns the rate of `numerator` frames in `denominator` seconds, in lowest terms; `None` outside 1 to 1000.
    #[allow(clippy::arithmetic_side_effects)] // 1000 · denominator fits 64 bits
    pub const fn new(numerator: u32, denominator: u32) -> Option<Fps> {
        if denominator == 0 || numerator < denominator || numerator as u64 > 1000 * denominator as u64 {
            return None;
        }
        let divisor = greatest_common_divisor(numerator, denominator);
        // No divisor is zero. Checked division keeps a panic out of the machine code.
        match (numerator.checked_div(divisor), denominator.checked_div(divisor)) {
            (Some(numerator), Some(denominator)) => Fps::with_reciprocal(numerator, denominator),
            _ => None,
        }
    }

    /// Returns a rate of whole frames per second, for constants.
    ///
    /// # Panics
    /// Outside 1 to 1000. In a `const`, that is a compile error.
    #[allow(clippy::panic)]
    pub const fn whole(frames_per_second: u16) -> Fps {
        match Fps::new(frames_per_second as u32, 1) {
            Some(fps) => fps,
            None => panic!("a frame rate must be from 1 to 1000"),
        }
    }

    #[allow(clippy::arithmetic_side_effects)] // numerator ≤ 1000 · denominator: fits 64 bits
    const fn with_reciprocal(numerator: u32, denominator: u32) -> Option<Fps> {
        let micros = denominator as u64 * MICROS_PER_SECOND;
        let reciprocal = match reciprocal(numerator, micros) {
            Some(reciprocal) => reciprocal,
            None => return None,
        };
        match StoredFps::from_parts(numerator, denominator, reciprocal) {
            Some(stored) => Some(Fps(stored)),
            None => None,
        }
    }

    /// Returns the rate from a value that [`StoredFps::checked`] has checked.
    pub(crate) const fn from_checked(stored: StoredFps) -> Fps {
        Fps(stored)
    }

    /// Returns the number of frames in [`Fps::denominator`] seconds.
    pub const fn numerator(self) -> u32 {
        self.0.numerator()
    }

    /// Returns the number of seconds in which [`Fps::numerator`] frames pass.
    pub const fn denominator(self) -> u32 {
        self.0.denominator()
    }

    /// Returns ⌈2⁶⁴ · frames per microsecond⌉, as stored in a bank.
    pub const fn frames_per_micro_q64(self) -> u64 {
        self.0.frames_per_micro_q64()
    }

    /// Returns the rate as the nearest floating-point number, for display.
    pub fn to_f64(self) -> f64 {
        f64::from(self.numerator()) / f64::from(self.denominator())
    }

    /// Returns the frame at `time`: ⌊time · rate⌋. `None` before 0, and from frame 2³² − 1 on.
    #[inline]
    pub fn frame_at<T: Time>(self, time: T) -> Option<u32> {
        time.frame(self, u32::MAX)
    }

    /// Returns the first microsecond of `frame`: ⌈frame / rate⌉ in exact arithmetic.
    pub fn start_of_frame_us(self, frame: u32) -> u64 {
        self.0.start_of_frame_us(frame)
    }
}

impl From<Fps> for StoredFps {
    fn from(fps: Fps) -> StoredFps {
        fps.0
    }
}

/// Orders slower rates first. Only the same ratios are equal, because both are in lowest terms.
impl Ord for Fps {
    fn cmp(&self, other: &Fps) -> Ordering {
        let product = |a: Fps, b: Fps| u64::from(a.numerator()).wrapping_mul(u64::from(b.denominator()));
        product(*self, *other).cmp(&product(*other, *self))
    }
}

impl PartialOrd for Fps {
    fn partial_cmp(&self, other: &Fps) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Returns ⌈2⁶⁴ · `frames` / `micros`⌉ for a quotient below 1; `None` if `micros` is 0. 32-bit processors do not check
/// this: callers pass a denominator that is not 0. Small processors cannot divide 128 bits.
const fn reciprocal(frames: u32, micros: u64) -> Option<u64> {
    if cfg!(target_pointer_width = "64") { divided(frames, micros) } else { Some(long_divided(frames, micros)) }
}

/// Returns the reciprocal by a division instruction.
#[allow(clippy::arithmetic_side_effects)] // the sum fits 128 bits
const fn divided(frames: u32, micros: u64) -> Option<u64> {
    match (((frames as u128) << 64) + micros as u128 - 1).checked_div(micros as u128) {
        Some(reciprocal) => Some(reciprocal as u64),
        None => None,
    }
}

/// Returns the reciprocal by long division, one bit at a time.
#[allow(clippy::arithmetic_side_effects)] // the rest is less than the divisor, which has 52 bits
const fn long_divided(frames: u32, micros: u64) -> u64 {
    let (mut reciprocal, mut rest, mut bit) = (0_u64, frames as u64, 0);
    while bit < 64 {
        rest *= 2;
        reciprocal <<= 1;
        if rest >= micros {
            rest -= micros;
            reciprocal |= 1;
        }
        bit += 1;
    }
    reciprocal + (rest != 0) as u64
}

#[allow(clippy::arithmetic_side_effects)] // the loop condition ensures that the divisor is not zero
pub(crate) const fn greatest_common_divisor(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        let rest = a % b;
        a = b;
        b = rest;
    }
    a
}

/// Prints the nearest decimal number, `29.97`.
impl fmt::Display for Fps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.to_f64(), f)
    }
}

impl fmt::Debug for Fps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Fps({}/{})", self.numerator(), self.denominator())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_divisions_agree() {
        for (numerator, denominator) in
            [(1_u32, 1_u32), (24, 1), (1000, 1), (30_000, 1001), (2997, 125), (u32::MAX, 4_294_968)]
        {
            let micros = u64::from(denominator) * MICROS_PER_SECOND;
            assert_eq!(divided(numerator, micros), Some(long_divided(numerator, micros)), "{numerator}/{denominator}");
        }
    }
}
