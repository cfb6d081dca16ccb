//! The cursor of a curve, which stores the last key that was used.

use super::Curve;
use super::CurveValue;
use crate::Time;
use lipz_types::Position;

/// Stores the position of the last read in a curve, so that the next rendered frame finds its keys at once.
///
/// It is one number and borrows nothing. It always returns the same values as [`Curve::value_at`]: the time may jump,
/// and the curve may be a different one. It only saves the search.
///
/// ```
/// # use lipz_bank::{Clip, Micros};
/// # use lipz_bank::curve::CurveCursor;
/// # fn draw(clip: &Clip<'_>, jaw_cursor: &mut CurveCursor, now: Micros) -> Option<f32> {
/// let jaw = clip.curve("jawOpen")?;
/// Some(jaw_cursor.value_at(&jaw, now)?.to_f32())
/// # }
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct CurveCursor {
    index: u32,
}

/// Keys to step through before a search. A rendered frame seldom passes more.
const STEPS: u32 = 4;

impl CurveCursor {
    /// Returns an unused cursor.
    pub const fn new() -> CurveCursor {
        CurveCursor { index: 0 }
    }

    /// Returns the cursor as a number, for storage outside of Rust.
    pub const fn to_word(self) -> u32 {
        self.index
    }

    /// Returns the cursor of [`CurveCursor::to_word`]. Any number is valid.
    pub const fn from_word(word: u32) -> CurveCursor {
        CurveCursor { index: word }
    }

    /// Returns the value of the curve at the start of a frame.
    pub fn value(&mut self, curve: &Curve<'_>, frame: u32) -> CurveValue {
        self.value_of(curve, Position::of_frame(frame))
    }

    /// Returns the value of the curve at `time`, like [`Curve::value_at`]; `None` without a frame rate.
    pub fn value_at<T: Time>(&mut self, curve: &Curve<'_>, time: T) -> Option<CurveValue> {
        let fps = curve.fps?;
        Some(self.value_of(curve, time.position(fps)))
    }

    pub(super) fn value_of(&mut self, curve: &Curve<'_>, position: Position) -> CurveValue {
        self.index = self.index_at(curve, position.frame);
        curve.value_between(self.index, position)
    }

    /// Returns the index of the last key at or before a frame, or 0.
    // Each rendered frame calls it.
    #[cfg_attr(target_pointer_width = "64", inline(always))]
    pub(super) fn index_at(&self, curve: &Curve<'_>, frame: u32) -> u32 {
        let has_come = |index: u32| curve.keys.get(index).map_or(false, |key| key.frame <= frame);
        let mut index = self.index;
        if !has_come(index) && index == 0 {
            return 0;
        }
        if has_come(index) {
            for _ in 0..STEPS {
                if !has_come(index.wrapping_add(1)) {
                    return index;
                }
                index = index.wrapping_add(1);
            }
        }
        let (mut first, mut end) = (0, curve.keys.count());
        while first < end {
            let middle = first.wrapping_add(end.wrapping_sub(first) / 2);
            if has_come(middle) {
                first = middle.wrapping_add(1);
            } else {
                end = middle;
            }
        }
        first.saturating_sub(1)
    }
}
