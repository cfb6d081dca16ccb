//! The whole face at a time: generated motion, and the curves that override it (`docs/guides/faces.md`, "Generated
//! motion").

mod blink;
mod chance;
mod check;
mod emotions;
mod eyes;
mod head;
mod look;
mod mouth;
mod profile;
mod who;

pub(crate) use check::check;
pub use emotions::Emotions;
pub use lipz_types::{Emotion, FaceCurve};
pub use look::LookAt;
pub use profile::FaceProfile;
pub use who::Who;

use crate::curve::{Curve, CurveValue};
use crate::{Clip, ClipId, Time};
use chance::Steps;
use lipz_types::{Fps, Micros, Position};
use mouth::Mouth;
use who::farther;

/// The state of a face at a time, except mouth and emotions. Angles are in degrees: pitch is positive upwards, yaw to
/// the left of the character, roll towards the left shoulder.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub struct Face {
    /// How far the lids are closed, from 0 to 1.
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
    /// How far the brows are raised, from 0 to 1. Only curves raise them.
    pub brows: CurveValue,
    /// A shrug of the face, from 0 to 1. Only curves set it.
    pub shrug: CurveValue,
    /// How hard the character breathes, from 0 to 10. Only curves set it.
    pub breath: CurveValue,
}

/// Degrees of the head for one unit of the curves `nod` and `shake`.
const DEGREES_PER_UNIT: i32 = 2;
/// The neutral value of `nod` and `shake`, in thousandths.
const NEUTRAL: i32 = 5000;

impl Clip<'_> {
    /// Returns the face of the speaker or of another character at `time`, generated from `profile`, with the eyes on
    /// `look`. Curves of the clip override generated values.
    ///
    /// Other characters listen. They use the curves with their name in front, blink according to the strongest of their
    /// own emotions, and move their head only for these curves and for `look`.
    ///
    /// Nothing is kept from frame to frame: the face depends only on the time, the profile and the id of the clip, and
    /// is the same on every machine. Before the start, it is the same as at the start; after the end, it continues to
    /// blink.
    ///
    /// ```
    /// use lipz_bank::face::{LookAt, Who};
    /// use lipz_bank::{Bank, Micros};
    ///
    /// # let bytes: &[u8] = include_bytes!("../../examples/act1.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let profile = bank.default_face_profile(); // [face] of lipz.toml, or the default
    /// for clip in bank.clips() {
    ///     let face = clip.face_at(Micros(1_500_000), Who::Speaker, &profile, LookAt::AHEAD);
    ///     println!("lids {}, head {}°", face.blink, face.head_yaw);
    ///     let mara = clip.face_at(Micros(1_500_000), "mara", &profile, LookAt::AHEAD); // `mara nods` in the events
    ///     println!("head {}°", mara.head_pitch);
    /// }
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn face_at<'name, T: Time>(
        &self,
        time: T,
        who: impl Into<Who<'name>>,
        profile: &FaceProfile<'_>,
        look: LookAt,
    ) -> Face {
        let who = who.into();
        if profile.is_without_curves() {
            return self.generated(who, milliseconds(time), profile, look);
        }
        self.face_in(who, (milliseconds(time), self.position(time)), profile, look)
    }

    /// Returns the generated part of the face.
    fn generated(&self, who: Who<'_>, ms: u64, profile: &FaceProfile<'_>, look: LookAt) -> Face {
        let is_pose = |curve: &Curve<'_>| who.purpose(curve.name().bytes()) == Some(FaceCurve::Pose.name().as_bytes());
        let (seed, mouth) = self.moved(who, self.curves().filter(is_pose).fold(None, named_pose));
        let steps = Steps { seed, ms };
        let [pitch, yaw, roll] = mouth.map(|mouth| head::motion(profile, steps, &mouth)).unwrap_or_default();
        let eyes = eyes::target(profile, steps, look);
        let value = CurveValue::from_thousandths;
        Face {
            blink: value(blink::closed(profile, steps, |ms| self.strongest(who, ms))),
            head_pitch: value(pitch),
            head_yaw: value(yaw),
            head_roll: value(roll),
            eye_pitch: value(eyes.pitch),
            eye_yaw: value(eyes.yaw),
            ..Face::default()
        }
    }

    /// Returns the seed of a face, and the visemes that move its head, if it is the speaker's.
    fn moved<'m>(&'m self, who: Who<'_>, poses: Option<Curve<'m>>) -> (u64, Option<Mouth<'m>>) {
        match who {
            Who::Speaker | Who::SpeakerNamed(_) => (self.id().get(), Mouth::of(self, poses)),
            Who::Other(name) => (self.id().get() ^ ClipId::from_key(name).get(), None),
        }
    }

    /// Returns the leading emotion.
    fn strongest(&self, who: Who<'_>, ms: u64) -> Option<(Emotion, CurveValue)> {
        self.emotions_at(Micros(ms.wrapping_mul(1000) as i64), who).strongest()
    }

    /// Returns the face at a time in milliseconds and in frames.
    fn face_in(
        &self,
        who: Who<'_>,
        (ms, position): (u64, Option<Position>),
        profile: &FaceProfile<'_>,
        look: LookAt,
    ) -> Face {
        let mut curves = CurveValues::default();
        let mut poses = None;
        for curve in self.curves() {
            let known = who
                .purpose(curve.name().bytes())
                .and_then(|name| FaceCurve::ALL.iter().copied().find(|known| known.name().as_bytes() == name));
            match (known, position) {
                (Some(FaceCurve::Pose), _) => poses = named_pose(poses, curve),
                (Some(known), Some(position)) => curves.set(known, curve.value_in(position).thousandths()),
                _ => {}
            }
        }
        let (seed, mouth) = self.moved(who, poses);
        Moment { profile, steps: Steps { seed, ms }, mouth, curves }.face(look, |ms| self.strongest(who, ms))
    }
}

impl FaceProfile<'_> {
    /// Returns the face of a silent character, who blinks and looks. `time` may start anywhere. Give each character a
    /// different `seed`, so that they do not blink at the same time.
    ///
    /// ```
    /// use lipz_bank::Seconds;
    /// use lipz_bank::face::{FaceProfile, LookAt};
    /// let listening = FaceProfile::DEFAULT.idle_at(Seconds(12.5_f32), 7, LookAt::AHEAD);
    /// assert_eq!(listening.head_yaw.thousandths(), 0); // a head moves while its mouth does
    /// ```
    pub fn idle_at<T: Time>(&self, time: T, seed: u64, look: LookAt) -> Face {
        let steps = Steps { seed, ms: milliseconds(time) };
        let moment = Moment { profile: self, steps, mouth: None, curves: CurveValues::default() };
        moment.face(look, |_| None)
    }
}

/// Selects the one of two curves of poses that has the character's name in front.
fn named_pose<'m>(before: Option<Curve<'m>>, curve: Curve<'m>) -> Option<Curve<'m>> {
    match before {
        Some(before) if before.name().bytes().len() > curve.name().bytes().len() => Some(before),
        _ => Some(curve),
    }
}

/// Returns the whole milliseconds since the start, or 0 before it. Saturates after 49 days.
#[cfg_attr(not(target_pointer_width = "64"), inline(never))] // needed twice
fn milliseconds<T: Time>(time: T) -> u64 {
    const MILLISECONDS: Fps = Fps::whole(1000);
    match time.frame(MILLISECONDS, u32::MAX) {
        Some(ms) => u64::from(ms),
        None if time.has_begun() => u64::from(u32::MAX),
        None => 0,
    }
}

/// The values of known curves, in thousandths.
#[derive(Clone, Copy, Default)]
struct CurveValues {
    values: [Option<i32>; FaceCurve::ALL.len()],
}

impl CurveValues {
    fn set(&mut self, curve: FaceCurve, thousandths: i32) {
        let neutral = if matches!(curve, FaceCurve::Nod | FaceCurve::Shake) { NEUTRAL } else { 0 };
        if let Some(place) = self.values.get_mut(curve as usize) {
            *place = Some(place.map_or(thousandths, |before| farther(before, thousandths, neutral)));
        }
    }

    fn get(&self, curve: FaceCurve) -> Option<i32> {
        self.values.get(curve as usize).copied().flatten()
    }

    /// Returns the value, or 0 without such a curve.
    fn or_zero(&self, curve: FaceCurve) -> i32 {
        self.get(curve).unwrap_or(0)
    }

    /// Returns the degrees of a curve that is neutral at 5.
    fn swing(&self, curve: FaceCurve) -> i32 {
        self.get(curve).unwrap_or(NEUTRAL).saturating_sub(NEUTRAL).saturating_mul(DEGREES_PER_UNIT)
    }
}

/// The inputs of a face.
struct Moment<'m> {
    profile: &'m FaceProfile<'m>,
    steps: Steps,
    /// The visemes being spoken; `None` for a silent character.
    mouth: Option<Mouth<'m>>,
    curves: CurveValues,
}

impl Moment<'_> {
    fn face(&self, look: LookAt, strongest: impl Fn(u64) -> Option<(Emotion, CurveValue)>) -> Face {
        let Moment { profile, steps, mouth, curves } = self;
        let value = CurveValue::from_thousandths;
        let blink = curves.get(FaceCurve::Blink).unwrap_or_else(|| blink::closed(profile, *steps, strongest));
        let [head_pitch, head_yaw, head_roll] =
            mouth.as_ref().map(|mouth| head::motion(profile, *steps, mouth)).unwrap_or_default();
        let eyes = eyes::target(profile, *steps, look);
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
            head_pitch: turned(FaceCurve::HeadPitch, head_pitch, curves.swing(FaceCurve::Nod), pitch),
            head_yaw: turned(FaceCurve::HeadYaw, head_yaw, curves.swing(FaceCurve::Shake), yaw),
            head_roll: turned(FaceCurve::HeadRoll, head_roll, 0, 0),
            eye_pitch: value(eye_pitch),
            eye_yaw: value(eye_yaw),
            brows: value(curves.or_zero(FaceCurve::Brows)),
            shrug: value(curves.or_zero(FaceCurve::Shrug)),
            breath: value(curves.or_zero(FaceCurve::Breath)),
        }
    }
}
