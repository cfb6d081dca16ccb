//! The conversion of gestures to keys of curves.

use super::gesture::Gesture;
use super::shapes::{Path, neutral};
use crate::clip::{ClipData, Key};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::FaceCurve;
use lipz_bank::{Fps, Micros};
use std::collections::BTreeMap;
use std::ops::Range;

/// A gesture with its room on a curve.
struct PlacedGesture {
    /// The maximum difference from the neutral value.
    amplitude: i32,
    path: Path,
    /// The frame in which the gesture ends.
    end: u32,
}

/// Gestures by their start frames.
type OfCurve = BTreeMap<u32, PlacedGesture>;

/// Returns the curves of gestures, and for each gesture whether it moves a curve. If gestures overlap on a curve, the
/// first one in `gestures` stays.
pub(super) fn keys(gestures: &[Gesture<'_>], fps: Fps, clip_end: u32) -> (BTreeMap<String, Vec<Key>>, Vec<bool>) {
    let mut placed: BTreeMap<String, (FaceCurve, OfCurve)> = BTreeMap::new();
    let mut moves = Vec::with_capacity(gestures.len());
    for gesture in gestures {
        let mut is_placed = false;
        for (curve, path) in gesture.kind.paths().iter().filter(|_| gesture.frame < clip_end) {
            let (_, of_curve) = placed.entry(gesture.name_of(*curve)).or_insert_with(|| (*curve, OfCurve::new()));
            let end = end_of(gesture, path, fps);
            if is_free(of_curve, gesture.frame..end) {
                let amplitude = gesture.kind.amplitude(gesture.strength);
                of_curve.insert(gesture.frame, PlacedGesture { amplitude, path, end });
                is_placed = true;
            }
        }
        moves.push(is_placed);
    }
    let keys =
        placed.into_iter().map(|(name, (curve, of_curve))| (name, curve, keys_of(curve, of_curve, fps, clip_end)));
    let moving = keys.filter(|(_, curve, keys)| keys.iter().any(|(_, value)| value.thousandths() != neutral(*curve)));
    (moving.map(|(name, _, keys)| (name, keys)).collect(), moves)
}

/// Returns the frame in which a gesture ends on a curve.
fn end_of(gesture: &Gesture<'_>, path: Path, fps: Fps) -> u32 {
    let length = path.iter().fold(0, |length, (ms, _)| frames(fps, *ms).max(length + 1));
    gesture.frame.saturating_add(length)
}

/// Whether the file has all curves of a gesture, and they are constant during the gesture.
pub(super) fn are_still(gesture: &Gesture<'_>, fps: Fps, clip: &ClipData) -> bool {
    gesture.kind.paths().iter().all(|(curve, path)| {
        let name = gesture.name_of(*curve);
        let of_file = clip.curves.iter().find(|(other, _)| *other == name);
        of_file.is_some_and(|(_, keys)| !moves_in(keys, gesture.frame..end_of(gesture, path, fps)))
    })
}

/// Whether a curve changes in these frames.
fn moves_in(keys: &[Key], frames: Range<u32>) -> bool {
    let first = keys.partition_point(|(frame, _)| *frame <= frames.start).saturating_sub(1);
    let pairs = keys.iter().zip(keys.iter().skip(1)).skip(first).take_while(|(from, _)| from.0 < frames.end);
    pairs.into_iter().any(|(from, to)| from.1 != to.1)
}

/// Whether these frames do not overlap a gesture.
fn is_free(of_curve: &OfCurve, frames: Range<u32>) -> bool {
    let before = of_curve.range(..=frames.start).next_back();
    before.is_none_or(|(start, last)| last.end <= frames.start && *start < frames.start)
        && of_curve.range(frames).next().is_none()
}

/// Returns the keys of consecutive gestures. `clip_end` is the number of frames in the clip.
fn keys_of(curve: FaceCurve, gestures: OfCurve, fps: Fps, clip_end: u32) -> Vec<Key> {
    let mut keys: Vec<Key> = Vec::new();
    let at_rest = CurveValue::from_thousandths(neutral(curve));
    for (start, PlacedGesture { amplitude, path, end }) in gestures {
        if keys.last().is_none_or(|(frame, _)| *frame < start) {
            keys.push((start, at_rest));
        }
        let mut before = start;
        for (ms, share) in path {
            before = start.saturating_add(frames(fps, *ms)).max(before + 1);
            let value = i64::from(neutral(curve)) + i64::from(amplitude) * i64::from(*share) / 1000;
            if before < end.min(clip_end) {
                keys.push((before, CurveValue::from_thousandths(value as i32)));
            }
        }
        // A gesture that is longer than the clip ends with it.
        keys.push((end.min(clip_end), at_rest));
    }
    keys
}

/// Returns the number of frames in a time, rounded to the nearest.
fn frames(fps: Fps, ms: u32) -> u32 {
    let half_us = fps.start_of_frame_us(1) / 2;
    fps.frame_at(Micros((u64::from(ms) * 1000 + half_us) as i64)).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::super::shapes::GestureKind;
    use super::*;

    /// Returns the keys of nods in a clip of 40 frames at 20 frames per second.
    fn nods(gestures: &[(u32, i32)]) -> Vec<String> {
        let nod = |(frame, strength): &(u32, i32)| Gesture::new(GestureKind::Nod, *frame, *strength);
        let gestures: Vec<Gesture<'_>> = gestures.iter().map(nod).collect();
        let (curves, _) = keys(&gestures, Fps::whole(20), 40);
        curves.into_values().flatten().map(|(frame, value)| format!("{frame}:{value}")).collect()
    }

    #[test]
    fn a_curve_moves_between_keys_that_differ() {
        let keys = [(2, 0), (5, 1), (9, 1), (12, 0)].map(|(frame, value)| (frame, CurveValue::from_thousandths(value)));
        let moving = [(0..2, false), (0..3, true), (4..5, true), (5..9, false), (8..10, true), (12..99, false)];
        for (frames, moves) in moving {
            assert_eq!(moves_in(&keys, frames.clone()), moves, "{frames:?}");
        }
        assert!(!moves_in(&keys[..1], 0..9) && !moves_in(&[], 0..9));
    }

    #[test]
    fn swings_decrease_and_stay_in_the_clip() {
        assert_eq!(nods(&[(2, 4000)]), ["2:5", "5:3", "8:6", "11:4.5", "14:5"]);
        assert_eq!(nods(&[(0, 10_000)])[1], "3:0", "at the end of the curve");
        assert_eq!(nods(&[(2, 4000), (14, 4000)])[4..], ["14:5", "17:3", "20:6", "23:4.5", "26:5"]);
        assert_eq!(nods(&[(2, 4000), (13, 4000), (0, 1000)]).len(), 5, "the first one stays");
        assert_eq!(nods(&[(34, 4000)]), ["34:5", "37:3", "40:5"]);
        assert_eq!(nods(&[(39, 4000), (40, 4000), (99, 4000)]), [""; 0]);
        assert_eq!(nods(&[(2, 0)]), [""; 0], "nothing moves");
    }
}
