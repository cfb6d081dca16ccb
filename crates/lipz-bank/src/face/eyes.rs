//! The eyes: they rest on eyes and mouth of the other, and now and then glance at hands and body.

use super::chance::{Steps, Stream, WHOLE, draw, either_side, part, scaled};
use super::{FaceProfile, LookAt};

/// Where eyes look, in thousandths of a degree.
pub(super) struct Target {
    pub(super) pitch: i32,
    pub(super) yaw: i32,
}

/// Milliseconds that eyes take from one place to the next.
const SACCADE_MS: u16 = 50;
/// Eyes, 6.5 cm apart, and the mouth, 7 cm below them, of somebody who is a metre away: left, right, mouth.
const OF_A_FACE: [(i32, i32); 3] = [(0, 1900), (0, -1900), (-4000, 0)];
/// Hands and body are so far below the eyes at least,
const GLANCE_DOWN: i32 = 10_000;
/// so much farther at most,
const GLANCE_MORE: u32 = 8000;
/// and so far to a side.
const GLANCE_ASIDE: u32 = 12_000;

/// Where the eyes look, as seen from the head at rest.
pub(super) fn target(profile: &FaceProfile<'_>, steps: Steps, look: LookAt) -> Target {
    let (pitch, yaw) = look.thousandths();
    if !look.is_person() {
        return Target { pitch, yaw };
    }
    let step = steps.step(Stream::FixationTime, profile.fixation_ms(), SACCADE_MS);
    let (before, now) = (fixation(profile, steps.seed, step.before), fixation(profile, steps.seed, step.now));
    let between = |before: i32, now: i32| before.wrapping_add(scaled(now.wrapping_sub(before), step.part, WHOLE));
    Target { pitch: pitch.saturating_add(between(before.0, now.0)), yaw: yaw.saturating_add(between(before.1, now.1)) }
}

/// Pitch and yaw of a fixation, from the eyes of the other.
fn fixation(profile: &FaceProfile<'_>, seed: u64, number: u64) -> (i32, i32) {
    let drawn = |stream| draw(seed, stream, 0, number);
    if part(100, drawn(Stream::Glance)) < u32::from(profile.glance_percent()) {
        let down = GLANCE_DOWN.wrapping_add(part(GLANCE_MORE, drawn(Stream::EyePitch)) as i32);
        return (down.wrapping_neg(), either_side(GLANCE_ASIDE, drawn(Stream::EyeYaw)));
    }
    let place = part(OF_A_FACE.len() as u32, drawn(Stream::Target)) as usize;
    OF_A_FACE.get(place).copied().unwrap_or_default()
}
