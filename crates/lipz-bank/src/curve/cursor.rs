//! The cursor of a curve: which key was needed last.

use super::Curve;
use super::CurveValue;
use crate::Time;
use lipz_types::Position;

/// Remembers where a curve was read last, so that the next picture finds its keys at once.
///
/// It is one number, borrows nothing, and gives what [`Curve::value_at`] gives, whatever it was used for before: the time may
/// jump, and the curve may be a different one. It only saves the search.
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

/// Keys that are looked at one by one before a search: a picture seldom passes more.
const STEPS: u32 = 4;

impl CurveCursor {
    /// A cursor that has not been used yet.
    pub const fn new() -> CurveCursor {
        CurveCursor { index: 0 }
    }

    /// The cursor as a number, to keep it where no cursor can be: in a struct of another language.
    pub const fn to_word(self) -> u32 {
        self.index
    }

    /// The cursor of [`CurveCursor::to_word`]. Any number is taken.
    pub const fn from_word(word: u32) -> CurveCursor {
        CurveCursor { index: word }
    }

    /// The value of the curve at the start of a frame.
    pub fn value(&mut self, curve: &Curve<'_>, frame: u32) -> CurveValue {
        self.value_of(curve, Position::of_frame(frame))
    }

    /// The value of the curve at `time`, as [`Curve::value_at`] gives it; `None` without a frame rate.
    pub fn value_at<T: Time>(&mut self, curve: &Curve<'_>, time: T) -> Option<CurveValue> {
        let fps = curve.fps?;
        Some(self.value_of(curve, time.position(fps)))
    }

    pub(super) fn value_of(&mut self, curve: &Curve<'_>, position: Position) -> CurveValue {
        self.index = self.index_at(curve, position.frame);
        curve.value_between(self.index, position)
    }

    /// The index of the last key at or before a frame; 0 if there is none.
    // Each picture asks for it.
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
