//! Generated movement of a face as keys of curves, computed by the same code that games run.

use super::curves::Keys;
use crate::shared::characters::in_events;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Face, FaceCurve, FaceProfile, LookAt, Who};
use lipz_bank::{Clip, Micros};
use lipz_file::curve;

/// A curve that replaces generated movement.
struct GeneratedCurve {
    curve: FaceCurve,
    of: fn(&Face) -> CurveValue,
    /// How far keys may differ from the generated values, in thousandths: too little to see, but enough to leave few
    /// keys to edit.
    tolerance: i32,
    /// The value to return to at the end of the clip, because a curve keeps its last value.
    at_rest: Option<CurveValue>,
}

const DEGREES: i32 = 50;
const LIDS: i32 = 20;

/// All generated curves.
const ALL: [GeneratedCurve; 6] = [
    GeneratedCurve {
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

const fn angle(curve: FaceCurve, of: fn(&Face) -> CurveValue) -> GeneratedCurve {
    GeneratedCurve { curve, of, tolerance: DEGREES, at_rest: None }
}

/// Returns the names of the generated curves of a clip: of the speaker, and with a prefix of each character in its
/// events.
pub(super) fn names(clip: &Clip<'_>) -> Vec<String> {
    if !is_possible(clip) {
        return Vec::new();
    }
    let others = in_events(clip);
    let of_other = |who: &&str| {
        ALL.iter().filter(|it| it.is_of_all()).map(|it| format!("{who}.{}", it.curve.name())).collect::<Vec<_>>()
    };
    ALL.iter().map(|it| it.curve.name().to_owned()).chain(others.iter().flat_map(of_other)).collect()
}

/// Returns the keys of the generated curve with this name.
pub(super) fn keys(name: &str, clip: &Clip<'_>, profile: &FaceProfile<'_>) -> Option<Keys> {
    let (who, what) = match name.rsplit_once('.') {
        // This uses the bank's own spelling, which lives as long as the clip. A name may contain dots.
        Some((who, what)) => (Some(in_events(clip).into_iter().find(|other| *other == who)?), what),
        None => (None, name),
    };
    let generated = ALL.iter().find(|it| it.curve.name() == what && (who.is_none() || it.is_of_all()))?;
    generated.keys(clip, who.map_or(Who::Speaker, Who::Other), profile)
}

/// Whether faces can be computed for the frames of a clip. Without a frame rate, frames have no times.
fn is_possible(clip: &Clip<'_>) -> bool {
    clip.fps().is_some() && clip.frame_count() > 0
}

impl GeneratedCurve {
    /// Whether it is also generated for listeners. Their heads rest.
    fn is_of_all(&self) -> bool {
        !matches!(self.curve, FaceCurve::HeadPitch | FaceCurve::HeadYaw | FaceCurve::HeadRoll)
    }

    /// Returns the keys for a character in a clip, or `None` without frames or a frame rate.
    fn keys(&self, clip: &Clip<'_>, who: Who<'_>, profile: &FaceProfile<'_>) -> Option<Keys> {
        let fps = clip.fps().filter(|_| is_possible(clip))?;
        let profile = profile.without_curves();
        let at = |frame: u32| {
            let time = Micros(i64::try_from(fps.start_of_frame_us(frame)).unwrap_or(i64::MAX));
            (self.of)(&clip.face_at(time, who, &profile, LookAt::AHEAD))
        };
        let mut samples: Vec<CurveValue> = (0..=clip.frame_count()).map(at).collect();
        if let (Some(last), Some(at_rest)) = (samples.last_mut(), self.at_rest) {
            *last = at_rest;
        }
        Some(curve::sampled(&samples, self.tolerance))
    }
}
