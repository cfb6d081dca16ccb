//! The conversion of face changes to keys of curves.

use super::faces::Changes;
pub(super) use crate::clip::Key;
use crate::project::options::Face;
use lipz_bank::curve::CurveValue;
use lipz_bank::face::Emotion;
use std::collections::BTreeMap;

/// A change of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlendChange {
    /// The first frame of the change.
    pub(super) frame: u32,
    /// The face at the end of the change.
    pub(super) face: Face,
    /// The length of the change in frames; 0 for an immediate change.
    pub(super) over: u32,
}

/// Returns the curves of all characters. `end` is the number of frames in the clip.
pub(super) fn curves(changes: Changes, end: u32) -> BTreeMap<String, Vec<Key>> {
    let mut all = BTreeMap::new();
    for (character, mut changes) in changes {
        changes.retain(|change| change.frame < end);
        // The last of several changes at one frame wins.
        changes.sort_by_key(|change| change.frame);
        changes.reverse();
        changes.dedup_by_key(|change| change.frame);
        changes.reverse();
        for emotion in Emotion::ALL {
            let keys = keys_of(emotion, &changes, end);
            if keys.iter().any(|(_, value)| *value != CurveValue::default()) {
                let name = emotion.name();
                all.insert(character.as_ref().map_or(name.to_owned(), |who| format!("{who}.{name}")), keys);
            }
        }
    }
    all
}

/// Returns the keys of one attribute. `end` is the number of frames in the clip.
fn keys_of(emotion: Emotion, changes: &[BlendChange], end: u32) -> Vec<Key> {
    let mut keys: Vec<Key> = Vec::new();
    let mut push = |frame: u32, value: CurveValue| match keys.last_mut() {
        Some(last) if last.0 == frame => last.1 = value,
        _ => keys.push((frame, value)),
    };
    let mut value = CurveValue::default();
    for (index, change) in changes.iter().enumerate() {
        let target = CurveValue::from_thousandths(change.face[emotion as usize]);
        if target == value {
            continue;
        }
        if change.over == 0 {
            if let Some(before) = change.frame.checked_sub(1) {
                push(before, value);
            }
            push(change.frame, target);
            value = target;
            continue;
        }
        let next = changes.get(index + 1).map_or(end, |next| next.frame);
        let reached_at = change.frame.saturating_add(change.over).min(next);
        let done = reached_at - change.frame;
        push(change.frame, value);
        // The next change starts from the current face. After the end nothing follows, so the face reaches its target
        // in time.
        value = if done < change.over && reached_at < end {
            value.towards(target, done.into(), change.over.into())
        } else {
            target
        };
        push(reached_at, value);
    }
    keys
}

#[cfg(test)]
mod tests {
    use super::*;

    fn anger(changes: &[(u32, i32, u32)], end: u32) -> Vec<(u32, i32)> {
        let change = |&(frame, value, over): &(u32, i32, u32)| {
            let mut face = Face::default();
            face[Emotion::Anger as usize] = value;
            BlendChange { frame, face, over }
        };
        let changes: Vec<BlendChange> = changes.iter().map(change).collect();
        keys_of(Emotion::Anger, &changes, end).iter().map(|(frame, value)| (*frame, value.thousandths())).collect()
    }

    #[test]
    fn ramps_steps_and_ramps_that_are_cut_short() {
        assert_eq!(anger(&[(0, 2200, 10), (20, 0, 10)], 40), [(0, 0), (10, 2200), (20, 2200), (30, 0)]);
        assert_eq!(anger(&[(0, 2000, 0), (20, 500, 0)], 40), [(0, 2000), (19, 2000), (20, 500)]);
        assert_eq!(anger(&[(0, 4000, 20), (10, 0, 5)], 40), [(0, 0), (10, 2000), (15, 0)]);
        assert_eq!(anger(&[(30, 4000, 20)], 40), [(30, 0), (40, 4000)], "the clip ends");
        assert_eq!(anger(&[(0, 1000, 5), (10, 1000, 5)], 40), [(0, 0), (5, 1000)], "nothing changes");
        assert_eq!(anger(&[(0, 0, 5)], 40), []);
    }
}
