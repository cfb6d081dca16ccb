//! The head: it moves a little while the mouth does.

use super::FaceProfile;
use super::chance::{Steps, Stream, WHOLE, draw, either_side, scaled};
use crate::{Clip, Micros, Time, Viseme};

/// Angles in thousandths of a degree.
pub(super) struct Pose {
    pub(super) pitch: i32,
    pub(super) yaw: i32,
    pub(super) roll: i32,
}

/// Microseconds in which a head comes to rest when the mouth has, and before it begins.
const NEAR_US: u64 = 250_000;
/// A mouth that moves.
const SPEAKING: u64 = 1000;

/// The generated motion, while the mouth moves so much: a pose for every word of usual length.
pub(super) fn motion(profile: &FaceProfile<'_>, steps: Steps, speaking: u32) -> Pose {
    let step = steps.step(Stream::PoseTime, profile.pose_ms(), profile.pose_ms() / 2);
    // Starts and ends slowly: x² · (3 - 2x).
    let square = step.part.wrapping_mul(step.part) >> 16;
    let eased = square.wrapping_mul((3 * WHOLE).wrapping_sub(step.part.wrapping_mul(2))) >> 16;
    let angle = |stream: Stream, most: u32| {
        let at = |number| either_side(most, draw(steps.seed, stream, 0, number));
        let (before, now) = (at(step.before), at(step.now));
        let angle = before.wrapping_add(scaled(now.wrapping_sub(before), eased, WHOLE));
        scaled(angle, u64::from(speaking), SPEAKING)
    };
    let most = u32::from(profile.head_motion_thousandths());
    Pose {
        pitch: angle(Stream::Pitch, most.wrapping_mul(2) / 3),
        yaw: angle(Stream::Yaw, most),
        roll: angle(Stream::Roll, most / 2),
    }
}

/// How much the mouth moves, in thousandths: fully in a frame that is not at rest, less the farther away the nearest is.
pub(super) fn speaking(clip: &Clip<'_, '_>, ms: u64) -> u32 {
    let fps = match clip.stored_fps().filter(|fps| fps.checked().is_some()) {
        Some(fps) => fps,
        None => return 0,
    };
    let now_us = ms.wrapping_mul(1000);
    let frame_at = |us: u64| Micros(us as i64).frame(fps, u32::MAX).unwrap_or(u32::MAX) as usize;
    let frames = clip.frames();
    let now = frame_at(now_us);
    let within = |start: usize, end: usize| frames.get(start.min(frames.len())..end.min(frames.len())).unwrap_or(&[]);
    let moves = |code: &u8| !Viseme::from_code(*code).is_rest();
    let first = frame_at(now_us.saturating_sub(NEAR_US));
    let behind = within(first, now.saturating_add(1)).iter().rposition(moves).map(|index| {
        let end = first.wrapping_add(index).wrapping_add(1);
        now_us.saturating_sub(fps.start_of_frame_us(end as u32))
    });
    let next = now.saturating_add(1);
    let ahead = within(next, frame_at(now_us.wrapping_add(NEAR_US)).saturating_add(1)).iter().position(moves);
    let ahead = ahead.map(|index| fps.start_of_frame_us(next.wrapping_add(index) as u32).saturating_sub(now_us));
    let nearest = behind.unwrap_or(NEAR_US).min(ahead.unwrap_or(NEAR_US)).min(NEAR_US);
    (NEAR_US.wrapping_sub(nearest).wrapping_mul(SPEAKING) / NEAR_US) as u32
}
