//! What eyes look at.

use super::FaceProfile;
use crate::curve::CurveValue;

/// What somebody looks at, as a direction from the head at rest. A program computes it from where both are.
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

/// How far a head turns, in thousandths of a degree.
const HEAD_MOST: i32 = 60_000;

impl LookAt {
    /// Somebody straight ahead.
    pub const AHEAD: LookAt =
        LookAt { pitch: CurveValue::from_thousandths(0), yaw: CurveValue::from_thousandths(0), is_person: true };

    /// Somebody whose eyes are in this direction, in degrees: the eyes go over their eyes and mouth, and now and then over
    /// hands and body.
    pub const fn person(pitch: CurveValue, yaw: CurveValue) -> LookAt {
        LookAt { pitch, yaw, is_person: true }
    }

    /// Something in this direction, in degrees, that eyes stay on: what a character `sees` or `stares` at.
    pub const fn point(pitch: CurveValue, yaw: CurveValue) -> LookAt {
        LookAt { pitch, yaw, is_person: false }
    }

    pub(super) const fn is_person(self) -> bool {
        self.is_person
    }

    /// Pitch and yaw.
    pub(super) const fn thousandths(self) -> (i32, i32) {
        (self.pitch.thousandths(), self.yaw.thousandths())
    }
}

impl FaceProfile<'_> {
    /// An angle, shared between eyes and head: the eyes turn as far as they may, the head by the rest.
    pub(super) fn shared(&self, angle: i32) -> (i32, i32) {
        let most = i32::from(self.head_follows_thousandths());
        let eyes = angle.clamp(most.wrapping_neg(), most);
        (eyes, angle.saturating_sub(eyes).clamp(-HEAD_MOST, HEAD_MOST))
    }
}
