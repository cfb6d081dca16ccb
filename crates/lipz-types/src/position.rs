//! Points in time between frames.

/// A point in time in frames: ⌊time · fps · 2¹⁶⌋ in exact arithmetic.
#[doc(hidden)]
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Position {
    /// The whole frames.
    pub frame: u32,
    /// The part of the next frame that has passed, in 65,536ths.
    pub sixteen_bits: u16,
}

impl Position {
    /// The start of the first frame.
    pub(crate) const START: Position = Position::of_frame(0);
    /// The last possible position.
    pub(crate) const LAST: Position = Position { frame: u32::MAX, sixteen_bits: u16::MAX };

    /// Returns the start of a frame.
    pub const fn of_frame(frame: u32) -> Position {
        Position { frame, sixteen_bits: 0 }
    }
}

/// Returns ⌊2¹⁶ · `part` / `whole`⌋ for a part less than the whole, by long division.
pub(crate) fn sixteen_bits(mut part: u64, whole: u64) -> u16 {
    let mut bits = 0_u16;
    for _ in 0..16 {
        let missing = whole.wrapping_sub(part);
        bits = bits.wrapping_mul(2);
        // Twice the part may overflow.
        part = if part >= missing {
            bits = bits.wrapping_add(1);
            part.wrapping_sub(missing)
        } else {
            part.wrapping_mul(2)
        };
    }
    bits
}
