//! The sums of the emotions in a file's curves, texts and events.

use super::faces::{MOST, sum, too_much};
use crate::check::curves::OfFile;
use crate::clip::{ClipData, Key};
use crate::project::options::Face;
use lipz_bank::face::Emotion;
use lipz_diagnostics::Diagnostic;
use std::collections::BTreeMap;

/// Reports for each character the first frame where the curves of the file and the generated curves add up to more than
/// a face can show.
pub(in crate::check) fn sums(of_file: &OfFile, clip: &ClipData, diagnostics: &mut Vec<Diagnostic>) {
    let mut by_character: BTreeMap<&str, Vec<(Emotion, &[Key])>> = BTreeMap::new();
    if of_file.emotions.is_empty() {
        return;
    }
    for (name, keys) in clip.curves.iter() {
        let (who, name) = name.rsplit_once('.').unwrap_or(("", name));
        if let Some(emotion) = Emotion::from_name(name) {
            by_character.entry(who).or_default().push((emotion, keys));
        }
    }
    let mut spans = BTreeMap::new();
    for (name, span) in &of_file.emotions {
        spans.entry(name.rsplit_once('.').map_or("", |(who, _)| who)).or_insert(*span);
    }
    for (who, curves) in by_character {
        let Some(span) = spans.get(who) else { continue };
        let over = first_over_the_top(&curves);
        diagnostics.extend(over.map(|(frame, face)| too_much(&face, clip, frame, *span)));
    }
}

/// Returns the first key at which emotions add up to more than the maximum, unless a single one exceeds it. Keys are
/// enough because a sum between two keys is never higher than at both of them.
fn first_over_the_top(curves: &[(Emotion, &[Key])]) -> Option<(u32, Face)> {
    let mut frames: Vec<u32> = curves.iter().flat_map(|(_, keys)| keys.iter().map(|(frame, _)| *frame)).collect();
    frames.sort_unstable();
    frames.dedup();
    let mut next = vec![0; curves.len()];
    frames.into_iter().find_map(|frame| {
        let mut face = Face::default();
        for ((emotion, keys), next) in curves.iter().zip(&mut next) {
            while keys.get(*next).is_some_and(|(at, _)| *at <= frame) {
                *next += 1;
            }
            face[*emotion as usize] = value_at(keys, *next, frame);
        }
        (sum(&face) > MOST && face.iter().all(|value| (0..=MOST).contains(value))).then_some((frame, face))
    })
}

/// Returns the value at a frame, in thousandths. `next` is the index of the first key after the frame.
fn value_at(keys: &[Key], next: usize, frame: u32) -> i32 {
    let before = next.checked_sub(1).and_then(|before| keys.get(before));
    match (before, keys.get(next)) {
        (Some((at, from)), Some((end, to))) => {
            from.towards(*to, u64::from(frame - at), u64::from(end - at)).thousandths()
        }
        (Some((_, value)), None) | (None, Some((_, value))) => value.thousandths(),
        (None, None) => 0,
    }
}
