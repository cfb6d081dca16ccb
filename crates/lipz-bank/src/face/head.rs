//! The head: it moves a little while the mouth does.

use super::FaceProfile;
use super::chance::{Steps, Stream, WHOLE, draw, either_side, part, scaled};
use super::mouth::{Mouth, SPEAKING};

/// Angles in thousandths of a degree.
#[derive(Default)]
pub(super) struct Pose {
    pub(super) pitch: i32,
    pub(super) yaw: i32,
    pub(super) roll: i32,
}

/// The generated motion: a pose for each segment, each pause and, between those, each word of usual length.
///
/// Time is divided into slots, and in each the head begins to turn to another pose. Steps that overlap are added, so that
/// a pose is a mean of at most three.
pub(super) fn motion(profile: &FaceProfile<'_>, steps: Steps, mouth: &Mouth<'_>) -> Pose {
    let speaking = mouth.speaking(steps.ms);
    if speaking == 0 {
        return Pose::default();
    }
    let slot = steps.ms.checked_div(u64::from(profile.pose_ms())).unwrap_or(0);
    let (turned, turning) =
        (slot.checked_sub(1).map_or(0, |slot| eased(profile, steps, mouth, slot)), eased(profile, steps, mouth, slot));
    let angle = |stream: Stream, most: u32| {
        // The pose that the step of a slot leads to has a number one higher.
        let at = |number| either_side(most, draw(steps.seed, stream, 0, number));
        let (first, second, third) = (at(slot.saturating_sub(1)), at(slot), at(slot.wrapping_add(1)));
        let angle = first.wrapping_add(scaled(second.wrapping_sub(first), turned, WHOLE)).wrapping_add(scaled(
            third.wrapping_sub(second),
            turning,
            WHOLE,
        ));
        scaled(angle, speaking, SPEAKING)
    };
    let most = u32::from(profile.head_motion_thousandths());
    Pose {
        pitch: angle(Stream::Pitch, most.wrapping_mul(2) / 3),
        yaw: angle(Stream::Yaw, most),
        roll: angle(Stream::Roll, most / 2),
    }
}

/// How far the step of a slot has come, in 65,536ths. It takes half a slot, and starts and ends slowly: x² · (3 - 2x).
fn eased(profile: &FaceProfile<'_>, Steps { seed, ms }: Steps, mouth: &Mouth<'_>, slot: u64) -> u64 {
    let length = u64::from(profile.pose_ms());
    let slot_ms = slot.wrapping_mul(length);
    let start = mouth.change_ms(slot_ms, length).unwrap_or_else(|| {
        let late = part(u32::from(profile.pose_ms() / 2), draw(seed, Stream::PoseTime, 0, slot));
        slot_ms.wrapping_add(u64::from(late))
    });
    let passed = ms.saturating_sub(start) << 16;
    let part = passed.checked_div(length / 2).unwrap_or(WHOLE).min(WHOLE);
    (part.wrapping_mul(part) >> 16).wrapping_mul((3 * WHOLE).wrapping_sub(part.wrapping_mul(2))) >> 16
}
