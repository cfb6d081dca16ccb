//! The times at which a mouth moves, and at which words may begin: pauses and segments, which are in the bank.

use crate::curve::Curve;
use crate::{Clip, Micros, Time, Viseme, segment};
use lipz_types::StoredFps;

/// The visemes of a clip with a frame rate.
pub(super) struct Mouth<'m> {
    clip: &'m Clip<'m>,
    frames: &'m [u8],
    fps: StoredFps,
    /// The curve `pose`.
    pub(super) poses: Option<Curve<'m>>,
}

/// The microseconds in which a head comes to rest after the mouth stops, and starts before the mouth moves.
const NEAR_US: u64 = 250_000;
/// The value for a moving mouth.
pub(super) const SPEAKING: u64 = 1000;
/// The part of a slot of poses that is searched for changes, in milliseconds. It limits the work for long poses.
const LOOKED_AT_MS: u64 = 1000;

impl<'m> Mouth<'m> {
    /// Returns the visemes of a clip, with the curve `poses` for its head; `None` without a frame rate.
    pub(super) fn of(clip: &'m Clip<'_>, poses: Option<Curve<'m>>) -> Option<Mouth<'m>> {
        let fps = clip.stored_fps().filter(|fps| fps.checked().is_some())?;
        Some(Mouth { clip, frames: clip.frames(), fps, poses })
    }

    /// Returns the start of a frame, in milliseconds.
    pub(super) fn start_ms(&self, frame: u32) -> u64 {
        self.fps.start_of_frame_us(frame) / 1000
    }

    /// Returns the frame at a time, or the last one after the end of the clip.
    pub(super) fn frame_at(&self, us: u64) -> usize {
        Micros(us as i64).frame(self.fps, u32::MAX).unwrap_or(u32::MAX) as usize
    }

    fn within(&self, start: usize, end: usize) -> &'m [u8] {
        self.frames.get(start.min(self.frames.len())..end.min(self.frames.len())).unwrap_or(&[])
    }

    /// Returns how much the mouth moves, in thousandths: fully in a frame that is not at rest, and less with the
    /// distance to the nearest such frame.
    pub(super) fn speaking(&self, ms: u64) -> u64 {
        let now_us = ms.wrapping_mul(1000);
        let now = self.frame_at(now_us);
        let first = self.frame_at(now_us.saturating_sub(NEAR_US));
        let behind = self.within(first, now.saturating_add(1)).iter().rposition(moves).map(|index| {
            let end = first.wrapping_add(index).wrapping_add(1);
            now_us.saturating_sub(self.fps.start_of_frame_us(end as u32))
        });
        let next = now.saturating_add(1);
        let last = self.frame_at(now_us.wrapping_add(NEAR_US));
        let ahead = self.within(next, last.saturating_add(1)).iter().position(moves);
        let ahead =
            ahead.map(|index| self.fps.start_of_frame_us(next.wrapping_add(index) as u32).saturating_sub(now_us));
        let nearest = behind.unwrap_or(NEAR_US).min(ahead.unwrap_or(NEAR_US)).min(NEAR_US);
        NEAR_US.wrapping_sub(nearest).wrapping_mul(SPEAKING) / NEAR_US
    }

    /// Returns the time of a change in the slot of this length: the start of the last segment that starts in it, or
    /// else of the first pause that begins or ends there. `None` if the mouth continues to move, or to rest.
    pub(super) fn change_ms(&self, slot_ms: u64, length_ms: u64) -> Option<u64> {
        let start_us = slot_ms.wrapping_mul(1000);
        let end_us = start_us.wrapping_add(length_ms.min(LOOKED_AT_MS).wrapping_mul(1000));
        // The frames that start in the slot. The first frame of the clip is never a change.
        let before = self.frame_at(start_us.saturating_sub(1));
        let codes = self.within(before, self.frame_at(end_us.saturating_sub(1)).saturating_add(1));
        let last = before.wrapping_add(codes.len()).checked_sub(1)?;
        let segment = segment::index_of_frame(self.clip, last as u32).and_then(|index| self.clip.segment(index));
        let starts = segment.map(|segment| segment.start_frame() as usize).filter(|start| *start > before);
        let turns = || codes.windows(2).position(|pair| matches!(pair, [one, other] if moves(one) != moves(other)));
        let frame = starts.or_else(|| turns().map(|index| before.wrapping_add(index).wrapping_add(1)))?;
        Some(self.start_ms(frame as u32))
    }
}

fn moves(code: &u8) -> bool {
    !Viseme::from_code(*code).is_rest()
}
