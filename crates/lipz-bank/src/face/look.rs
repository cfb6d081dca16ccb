//! The target of the eyes.

use super::FaceProfile;
use crate::curve::CurveValue;

/// The target of a character's eyes, as a direction from the head at rest. A program computes it from the positions of
/// both.
///
/// ```
/// use lipz_bank::Micros;
/// use lipz_bank::curve::CurveValue;
/// use lipz_bank::face::{FaceProfile, LookAt};
/// let degrees = |degrees: i32| CurveValue::from_thousandths(1000 * degrees);
/// // A door, 50 degrees to the left: the eyes turn by 20, the head by the rest.
/// let door = LookAt::point(degrees(0), degrees(50));
/// let face = FaceProfile::DEFAULT.idle_at(Micros(0), 1, door);
/// assert_eq!((face.eye_yaw, face.head_yaw), (degrees(20), degrees(30)));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct LookAt {
    pitch: CurveValue,
    yaw: CurveValue,
    is_person: bool,
}

/// The greatest turn of the head, in thousandths of a degree.
const HEAD_MOST: i32 = 60_000;

impl LookAt {
    /// A person straight ahead.
    pub const AHEAD: LookAt =
        LookAt { pitch: CurveValue::from_thousandths(0), yaw: CurveValue::from_thousandths(0), is_person: true };

    /// Returns a person with eyes in this direction, in degrees. The character looks at their eyes and mouth, and
    /// sometimes at their hands and body.
    pub const fn person(pitch: CurveValue, yaw: CurveValue) -> LookAt {
        LookAt { pitch, yaw, is_person: true }
    }

    /// Returns a target in this direction, in degrees, at which the eyes stay: for `sees` and `stares`.
    pub const fn point(pitch: CurveValue, yaw: CurveValue) -> LookAt {
        LookAt { pitch, yaw, is_person: false }
    }

    pub(super) const fn is_person(self) -> bool {
        self.is_person
    }

    /// Returns pitch and yaw, in thousandths of a degree.
    pub(super) const fn thousandths(self) -> (i32, i32) {
        (self.pitch.thousandths(), self.yaw.thousandths())
    }
}

impl FaceProfile<'_> {
    /// Divides an angle between eyes and head: the eyes turn as far as the profile allows, and the head turns the rest.
    pub(super) fn shared(&self, angle: i32) -> (i32, i32) {
        let most = i32::from(self.head_follows_thousandths());
        let eyes = angle.clamp(most.wrapping_neg(), most);
        (eyes, angle.saturating_sub(eyes).clamp(-HEAD_MOST, HEAD_MOST))
    }
}
