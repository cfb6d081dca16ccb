//! The head: it moves a little while the mouth does.

use super::FaceProfile;
use super::chance::{Steps, Stream, WHOLE, draw, either_side, part, scaled};
use super::mouth::{Mouth, SPEAKING};
use crate::curve::{Curve, CurveKey};

/// A pose: the number that its angles are drawn with, and its share of the full angles, in thousandths.
#[derive(Clone, Copy)]
struct HeadPose {
    number: u64,
    share: u32,
}

/// The poses that a head turns between: the progress from the first to the second, and from the result to the third, in
/// 65,536ths.
struct Turn {
    targets: [HeadPose; 3],
    parts: [u64; 2],
}

/// Returns the generated motion as pitch, yaw and roll, in thousandths of a degree.
///
/// There is one pose for each key of the curve `pose`. Without the curve, there is one for each segment, each pause
/// and, between those, each word of average length.
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
pub(super) fn motion(profile: &FaceProfile<'_>, steps: Steps, mouth: &Mouth<'_>) -> [i32; 3] {
    let speaking = mouth.speaking(steps.ms);
    if speaking == 0 {
        return [0; 3];
    }
    let Turn { targets, parts } = match mouth.poses.as_ref().and_then(|poses| at_keys(profile, steps, mouth, poses)) {
        Some(turn) => turn,
        None => in_slots(profile, steps, mouth),
    };
    let most = u32::from(profile.head_motion_thousandths());
    [(Stream::Pitch, most.wrapping_mul(2) / 3), (Stream::Yaw, most), (Stream::Roll, most / 2)].map(|(stream, most)| {
        let [first, second, third] = targets.map(|target| {
            either_side(most.wrapping_mul(target.share) / 1000, draw(steps.seed, stream, 0, target.number))
        });
        let angle = first.wrapping_add(scaled(second.wrapping_sub(first), parts[0], WHOLE)).wrapping_add(scaled(
            third.wrapping_sub(second),
            parts[1],
            WHOLE,
        ));
        scaled(angle, speaking, SPEAKING)
    })
}

/// Turns from the pose of one key to that of the next, in half of `pose_ms` or until the key after that.
fn at_keys(profile: &FaceProfile<'_>, steps: Steps, mouth: &Mouth<'_>, poses: &Curve<'_>) -> Option<Turn> {
    let index = poses.index_at(mouth.frame_at(steps.ms.wrapping_mul(1000)) as u32);
    let key = poses.key(index)?;
    let before = poses.key(index.saturating_sub(1)).unwrap_or(key);
    let start = mouth.start_ms(key.frame);
    let usual = u64::from(profile.pose_ms() / 2);
    let next = poses.key(index.wrapping_add(1)).map(|next| mouth.start_ms(next.frame).saturating_sub(start));
    let target =
        |key: CurveKey| HeadPose { number: u64::from(key.frame), share: key.value.thousandths().clamp(0, 1000) as u32 };
    Some(Turn {
        targets: [target(before), target(before), target(key)],
        parts: [0, eased(steps.ms.saturating_sub(start), next.unwrap_or(usual).min(usual))],
    })
}

/// Divides time into slots. In each slot, the head begins to turn to a new pose. Overlapping steps are added, so that a
/// pose is a mean of at most three.
fn in_slots(profile: &FaceProfile<'_>, steps: Steps, mouth: &Mouth<'_>) -> Turn {
    let slot = steps.ms.checked_div(u64::from(profile.pose_ms())).unwrap_or(0);
    // The step of a slot leads to the pose with the slot's number plus one.
    let target = |number| HeadPose { number, share: 1000 };
    Turn {
        targets: [target(slot.saturating_sub(1)), target(slot), target(slot.wrapping_add(1))],
        parts: [
            slot.checked_sub(1).map_or(0, |slot| in_slot(profile, steps, mouth, slot)),
            in_slot(profile, steps, mouth, slot),
        ],
    }
}

/// Returns the progress of a slot's step, which takes half a slot.
fn in_slot(profile: &FaceProfile<'_>, Steps { seed, ms }: Steps, mouth: &Mouth<'_>, slot: u64) -> u64 {
    let length = u64::from(profile.pose_ms());
    let slot_ms = slot.wrapping_mul(length);
    let start = mouth.change_ms(slot_ms, length).unwrap_or_else(|| {
        let late = part(u32::from(profile.pose_ms() / 2), draw(seed, Stream::PoseTime, 0, slot));
        slot_ms.wrapping_add(u64::from(late))
    });
    eased(ms.saturating_sub(start), length / 2)
}

/// Returns the progress of a step after `passed_ms`, in 65,536ths. It starts and ends slowly: x² · (3 - 2x).
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
fn eased(passed_ms: u64, length_ms: u64) -> u64 {
    let part = (passed_ms << 16).checked_div(length_ms).unwrap_or(WHOLE).min(WHOLE);
    (part.wrapping_mul(part) >> 16).wrapping_mul((3 * WHOLE).wrapping_sub(part.wrapping_mul(2))) >> 16
}
