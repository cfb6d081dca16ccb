//! The whole face at a time: what is generated, and the curves that win over it (`docs/FACE.md`, "Specials").

mod blink;
mod chance;
mod eyes;
mod head;
mod look;
mod profile;

pub use look::LookAt;
pub use profile::{FaceProfile, FaceProfiles};

use crate::{Clip, CurveValue, Emotion, Time};
use chance::Steps;
use lipz_types::{FaceCurve, Fps, Micros};

/// What a face does at a time, besides its mouth and its emotions. Angles are in degrees: pitch is positive upwards, yaw to
/// the left of the character, roll towards the left shoulder.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub struct Face {
    /// How far the lids are closed: 0 to 1.
    pub blink: CurveValue,
    /// How far the head is raised.
    pub head_pitch: CurveValue,
    /// How far the head is turned.
    pub head_yaw: CurveValue,
    /// How far the head is tilted.
    pub head_roll: CurveValue,
    /// How far the eyes are raised in the head.
    pub eye_pitch: CurveValue,
    /// How far the eyes are turned in the head.
    pub eye_yaw: CurveValue,
    /// How far the brows are raised: 0 to 1. Only curves raise them.
    pub brows: CurveValue,
    /// A shrug of the face, 0 to 1. Only curves make one.
    pub shrug: CurveValue,
    /// How hard somebody breathes: 0 to 10. Only curves say so.
    pub breath: CurveValue,
}

/// Degrees of the head for one unit of the curves `nod` and `shake`.
const DEGREES_PER_UNIT: i32 = 2;
/// Where `nod` and `shake` are neutral, in thousandths.
const NEUTRAL: i32 = 5000;

impl Clip<'_, '_> {
    /// The speaker's face at `time`, generated as `profile` says, with eyes that look at `look`. Curves of the clip win over
    /// what is generated.
    ///
    /// Nothing is kept between pictures: the face depends on the time, the profile and the id of the clip alone, and is the
    /// same on every machine. Before the start it is as at the start; after the end, it goes on blinking.
    ///
    /// ```
    /// use lipz_bank::{Bank, LookAt, Micros};
    ///
    /// # let bytes: &[u8] = include_bytes!("../../examples/act1.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let profile = bank.default_face_profile(); // [face] of lipz.toml, or what is usual
    /// for clip in bank.clips() {
    ///     let face = clip.face_at(Micros(1_500_000), &profile, LookAt::AHEAD);
    ///     println!("lids {}, head {}°", face.blink, face.head_yaw);
    /// }
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn face_at<T: Time>(&self, time: T, profile: &FaceProfile<'_>, look: LookAt) -> Face {
        let mut curves = Curves::default();
        for curve in self.curves() {
            if let (Some(known), Some(value)) = (FaceCurve::from_name(curve.name().as_str()), curve.value_at(time)) {
                curves.set(known, value.thousandths());
            }
        }
        let ms = milliseconds(time);
        let strongest = |ms: u64| self.emotions_at(Micros(ms.wrapping_mul(1000) as i64)).strongest();
        Moment { profile, seed: self.id().get(), ms, speaking: head::speaking(self, ms), curves }.face(look, strongest)
    }
}

impl FaceProfile<'_> {
    /// The face of somebody who says nothing: they blink and look. `time` counts from anywhere; `seed` tells them apart from
    /// others, so that not everybody blinks at once.
    ///
    /// ```
    /// use lipz_bank::{FaceProfile, LookAt, Seconds};
    /// let listening = FaceProfile::DEFAULT.idle_at(Seconds(12.5_f32), 7, LookAt::AHEAD);
    /// assert_eq!(listening.head_yaw.thousandths(), 0); // a head moves while its mouth does
    /// ```
    pub fn idle_at<T: Time>(&self, time: T, seed: u64, look: LookAt) -> Face {
        let moment = Moment { profile: self, seed, ms: milliseconds(time), speaking: 0, curves: Curves::default() };
        moment.face(look, |_| None)
    }
}

/// Whole milliseconds since the start; 0 before it, and as many as fit after 49 days.
fn milliseconds<T: Time>(time: T) -> u64 {
    match time.frame(Fps::whole(1000), u32::MAX) {
        Some(ms) => u64::from(ms),
        None if time.has_begun() => u64::from(u32::MAX),
        None => 0,
    }
}

/// The values of known curves, in thousandths.
#[derive(Clone, Copy, Default)]
struct Curves {
    values: [Option<i32>; FaceCurve::ALL.len()],
}

impl Curves {
    fn set(&mut self, curve: FaceCurve, thousandths: i32) {
        if let Some(place) = self.values.get_mut(curve as usize) {
            *place = Some(thousandths);
        }
    }

    fn get(&self, curve: FaceCurve) -> Option<i32> {
        self.values.get(curve as usize).copied().flatten()
    }

    /// The value, 0 without such a curve.
    fn or_zero(&self, curve: FaceCurve) -> i32 {
        self.get(curve).unwrap_or(0)
    }

    /// The degrees of a curve that is neutral at 5.
    fn swing(&self, curve: FaceCurve) -> i32 {
        self.get(curve).unwrap_or(NEUTRAL).saturating_sub(NEUTRAL).saturating_mul(DEGREES_PER_UNIT)
    }
}

/// What a face depends on.
struct Moment<'p> {
    profile: &'p FaceProfile<'p>,
    seed: u64,
    ms: u64,
    /// How much the mouth moves, in thousandths.
    speaking: u32,
    curves: Curves,
}

impl Moment<'_> {
    fn face(&self, look: LookAt, strongest: impl Fn(u64) -> Option<(Emotion, CurveValue)>) -> Face {
        let Moment { profile, seed, ms, curves, .. } = self;
        let value = CurveValue::from_thousandths;
        let blink = curves.get(FaceCurve::Blink).unwrap_or_else(|| blink::closed(profile, *seed, *ms, strongest));
        let head = head::motion(profile, Steps { seed: *seed, ms: *ms }, self.speaking);
        let eyes = eyes::target(profile, Steps { seed: *seed, ms: *ms }, look);
        let (eye_pitch, pitch) = profile.shared(
            curves.get(FaceCurve::EyePitch).unwrap_or(eyes.pitch).saturating_add(curves.or_zero(FaceCurve::LookPitch)),
        );
        let (eye_yaw, yaw) = profile.shared(
            curves.get(FaceCurve::EyeYaw).unwrap_or(eyes.yaw).saturating_add(curves.or_zero(FaceCurve::LookYaw)),
        );
        let turned = |whole: FaceCurve, generated: i32, more: i32, follows: i32| {
            let whole = curves.get(whole).unwrap_or(generated);
            value(whole.saturating_add(more).saturating_add(follows))
        };
        Face {
            blink: value(blink.max(curves.or_zero(FaceCurve::Lids))),
            head_pitch: turned(FaceCurve::HeadPitch, head.pitch, curves.swing(FaceCurve::Nod), pitch),
            head_yaw: turned(FaceCurve::HeadYaw, head.yaw, curves.swing(FaceCurve::Shake), yaw),
            head_roll: turned(FaceCurve::HeadRoll, head.roll, 0, 0),
            eye_pitch: value(eye_pitch),
            eye_yaw: value(eye_yaw),
            brows: value(curves.or_zero(FaceCurve::Brows)),
            shrug: value(curves.or_zero(FaceCurve::Shrug)),
            breath: value(curves.or_zero(FaceCurve::Breath)),
        }
    }
}
