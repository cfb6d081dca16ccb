//! What the reader generates of a face, as keys of curves: by the code that a game runs.

use super::Keys;
use lipz_bank::{Clip, CurveValue, Face, FaceCurve, FaceProfile, LookAt, Micros};
use lipz_file::curve;

/// A curve that replaces what is generated.
pub(super) struct Generated {
    curve: FaceCurve,
    of: fn(&Face) -> CurveValue,
    /// How far keys may be from what is generated, in thousandths: less than anybody sees, so that there are few enough to edit.
    tolerance: i32,
    /// What the curve comes back to when the clip is over: it keeps its last value.
    at_rest: Option<CurveValue>,
}

const DEGREES: i32 = 50;
const LIDS: i32 = 20;

/// All of them.
pub(super) const ALL: [Generated; 6] = [
    Generated {
        curve: FaceCurve::Blink,
        of: |face| face.blink,
        tolerance: LIDS,
        at_rest: Some(CurveValue::from_thousandths(0)),
    },
    angle(FaceCurve::HeadPitch, |face| face.head_pitch),
    angle(FaceCurve::HeadYaw, |face| face.head_yaw),
    angle(FaceCurve::HeadRoll, |face| face.head_roll),
    angle(FaceCurve::EyePitch, |face| face.eye_pitch),
    angle(FaceCurve::EyeYaw, |face| face.eye_yaw),
];

const fn angle(curve: FaceCurve, of: fn(&Face) -> CurveValue) -> Generated {
    Generated { curve, of, tolerance: DEGREES, at_rest: None }
}

/// Whether there are faces of the frames of a clip: those without a frame rate have no times.
pub(super) fn is_possible(clip: &Clip<'_, '_>) -> bool {
    clip.fps().is_some() && clip.frame_count() > 0
}

impl Generated {
    pub(super) fn name(&self) -> &'static str {
        self.curve.name()
    }

    /// The keys for a clip; none without frames or without a frame rate.
    pub(super) fn keys(&self, clip: &Clip<'_, '_>, profile: &FaceProfile<'_>) -> Option<Keys> {
        let fps = clip.fps().filter(|_| is_possible(clip))?;
        let at = |frame: u32| {
            let time = Micros(i64::try_from(fps.start_of_frame_us(frame)).unwrap_or(i64::MAX));
            (self.of)(&clip.generated_at(time, profile, LookAt::AHEAD))
        };
        let mut samples: Vec<CurveValue> = (0..=clip.frame_count()).map(at).collect();
        if let (Some(last), Some(at_rest)) = (samples.last_mut(), self.at_rest) {
            *last = at_rest;
        }
        Some(curve::sampled(&samples, self.tolerance))
    }
}
