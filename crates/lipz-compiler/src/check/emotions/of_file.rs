//! Emotions in the curves of a file, together with those of its texts and events.

use super::MOST;
use super::faces::{sum, too_much};
use crate::check::curves::OfFile;
use crate::clip::{ClipData, Key};
use crate::options::Face;
use lipz_bank::face::Emotion;
use lipz_diagnostics::Diagnostic;
use std::collections::BTreeMap;

/// Reports the first place where curves that a file has, with those that were made, add up to more than a face can show; once for
/// each character.
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

/// The first key at which emotions add up to too much, unless one of them does so alone: between keys, a sum is never higher than
/// at both.
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

/// The value at a frame, in thousandths; the key with the number `next` is the first one behind it.
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
