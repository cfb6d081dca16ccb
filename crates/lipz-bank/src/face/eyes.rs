//! The eyes: they rest on the listener's eyes and mouth, and sometimes glance at the hands and body.

use super::chance::{Steps, Stream, WHOLE, draw, either_side, part, scaled};
use super::{FaceProfile, LookAt};

/// The direction of the eyes, in thousandths of a degree.
pub(super) struct GazeTarget {
    pub(super) pitch: i32,
    pub(super) yaw: i32,
}

/// The duration of a saccade, from one fixation to the next, in milliseconds.
const SACCADE_MS: u16 = 50;
/// Pitch and yaw of the left eye, the right eye and the mouth of a person one metre away. The eyes are 6.5 cm apart,
/// and the mouth is 7 cm below them.
const OF_A_FACE: [(i32, i32); 3] = [(0, 1900), (0, -1900), (-4000, 0)];
/// The smallest angle of a glance below the eyes, in thousandths of a degree.
const GLANCE_DOWN: i32 = 10_000;
/// The largest random addition to that angle.
const GLANCE_MORE: u32 = 8000;
/// The largest angle of a glance to the side.
const GLANCE_ASIDE: u32 = 12_000;

/// Returns the direction of the eyes, relative to the head at rest.
pub(super) fn target(profile: &FaceProfile<'_>, steps: Steps, look: LookAt) -> GazeTarget {
    let (pitch, yaw) = look.thousandths();
    if !look.is_person() {
        return GazeTarget { pitch, yaw };
    }
    let step = steps.step(Stream::FixationTime, profile.fixation_ms(), SACCADE_MS);
    let (before, now) = (fixation(profile, steps.seed, step.before), fixation(profile, steps.seed, step.now));
    let between = |before: i32, now: i32| before.wrapping_add(scaled(now.wrapping_sub(before), step.part, WHOLE));
    GazeTarget {
        pitch: pitch.saturating_add(between(before.0, now.0)),
        yaw: yaw.saturating_add(between(before.1, now.1)),
    }
}

/// Returns pitch and yaw of a fixation, relative to the other person's eyes.
fn fixation(profile: &FaceProfile<'_>, seed: u64, number: u64) -> (i32, i32) {
    let drawn = |stream| draw(seed, stream, 0, number);
    if part(100, drawn(Stream::Glance)) < u32::from(profile.glance_percent()) {
        let down = GLANCE_DOWN.wrapping_add(part(GLANCE_MORE, drawn(Stream::EyePitch)) as i32);
        return (down.wrapping_neg(), either_side(GLANCE_ASIDE, drawn(Stream::EyeYaw)));
    }
    let place = part(OF_A_FACE.len() as u32, drawn(Stream::Target)) as usize;
    OF_A_FACE.get(place).copied().unwrap_or_default()
}
