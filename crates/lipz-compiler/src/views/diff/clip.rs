//! The differences of one clip.

use super::Change;
use super::locale_pair::LocalePair;
use crate::clip::ClipPhones;
use lipz_bank::{Clip, Fps, Locale, Recording, Segment, VisemeType};
use std::collections::{BTreeMap, BTreeSet};

/// The differences of a clip, of which there is at least one.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct ClipChange<'d> {
    /// The key.
    pub key: &'d str,
    /// The frame rates; `None` inside for unspecified ones.
    #[cfg_attr(feature = "json", serde(serialize_with = "super::json_fields::fps"))]
    pub fps: Option<Change<Option<Fps>>>,
    /// The viseme types; `None` inside for unspecified ones.
    #[cfg_attr(feature = "json", serde(serialize_with = "super::json_fields::viseme_type"))]
    pub viseme_type: Option<Change<Option<VisemeType>>>,
    /// The visemes.
    pub frames: Option<FramesChange>,
    /// The first frame of every segment, if the boundaries or the number of segments differ.
    pub segment_starts: Option<Change<Vec<u32>>>,
    /// Display texts, sorted by locale and segment.
    pub texts: Vec<TextChange<'d>>,
    /// Event strings, sorted by segment.
    pub events: Vec<EventChange<'d>>,
    /// Curves, sorted by name.
    pub curves: Vec<CurveChange<'d>>,
    /// The phones as in a Lipz file; `None` inside for a clip without phones.
    pub phones: Option<Change<Option<String>>>,
    /// Data about the recording in the banks; `None` inside for no data.
    #[cfg_attr(feature = "json", serde(serialize_with = "super::json_fields::recording"))]
    pub recording: Option<Change<Option<Recording>>>,
}

/// A difference in the visemes of a clip.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct FramesChange {
    /// Numbers of frames; `None` for a clip without visemes.
    pub counts: Change<Option<u32>>,
    /// The number of frames with different codes, including those that only one of the clips has.
    pub differing: u32,
    /// The first of them.
    pub first: Option<u32>,
}

/// A difference in the display text of a segment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct TextChange<'d> {
    /// The locale.
    pub locale: &'d str,
    /// The segment, from 0.
    pub segment: u32,
    /// The texts; `None` for a clip without a text of its own in the locale, or without the segment.
    #[cfg_attr(feature = "json", serde(flatten))]
    pub text: Change<Option<&'d str>>,
    /// Whether both are texts of another locale, shown instead of a missing one. Such differences are reported only for
    /// clips whose own texts are equal, and for locales that both banks have.
    pub is_fallback: bool,
}

/// A difference in the event string of a segment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct EventChange<'d> {
    /// The segment, from 0.
    pub segment: u32,
    /// The events; `None` for a clip without `events`, or without the segment.
    #[cfg_attr(feature = "json", serde(flatten))]
    pub event: Change<Option<&'d str>>,
}

/// A difference in a curve.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct CurveChange<'d> {
    /// The name.
    pub name: &'d str,
    /// The keys as in a Lipz file, `0:0 12:2.2`; `None` for a clip without a curve of this name.
    #[cfg_attr(feature = "json", serde(flatten))]
    pub keys: Change<Option<String>>,
}

impl<'d> ClipChange<'d> {
    /// Returns the differences of the clips, apart from their keys; `None` if there are none.
    pub(super) fn between(old: &Clip<'d>, new: &Clip<'d>, locales: &[LocalePair<'d>]) -> Option<ClipChange<'d>> {
        let change = ClipChange {
            key: new.key(),
            fps: Change::between(old.fps(), new.fps()),
            viseme_type: Change::between(old.viseme_type(), new.viseme_type()),
            frames: frames(old, new),
            segment_starts: Change::between(starts(old), starts(new)),
            texts: texts(old, new, locales),
            events: events(old, new),
            curves: curves(old, new),
            phones: Change::between(phones(old), phones(new)),
            recording: Change::between(old.recording(), new.recording()),
        };
        let same = ClipChange { key: new.key(), ..ClipChange::default() };
        (change != same).then_some(change)
    }
}

/// Returns the phones of a clip as in a Lipz file.
fn phones(clip: &Clip<'_>) -> Option<String> {
    let mut phones = ClipPhones::default();
    phones.recall(clip);
    phones.text()
}

/// Returns the curves with different keys.
fn curves<'d>(old: &Clip<'d>, new: &Clip<'d>) -> Vec<CurveChange<'d>> {
    let of = |clip: &Clip<'d>| -> BTreeMap<&'d str, String> {
        clip.curves().map(|curve| (curve.name().as_str(), curve.to_string())).collect()
    };
    let (old, new) = (of(old), of(new));
    let names: BTreeSet<&'d str> = old.keys().chain(new.keys()).copied().collect();
    let change =
        |name| Some(CurveChange { name, keys: Change::between(old.get(name).cloned(), new.get(name).cloned())? });
    names.into_iter().filter_map(change).collect()
}

fn frames(old: &Clip<'_>, new: &Clip<'_>) -> Option<FramesChange> {
    let count = |clip: &Clip<'_>| clip.has_visemes().then(|| clip.frame_count());
    let counts = Change { old: count(old), new: count(new) };
    let (old, new) = (old.frames(), new.frames());
    if old == new && counts.old == counts.new {
        return None;
    }
    let in_both = old.iter().zip(new);
    let first = in_both.clone().position(|(old, new)| old != new);
    let first = first.or_else(|| (old.len() != new.len()).then(|| old.len().min(new.len())));
    let differing = in_both.filter(|(old, new)| old != new).count() + old.len().abs_diff(new.len());
    Some(FramesChange { counts, differing: differing as u32, first: first.map(|first| first as u32) })
}

fn starts(clip: &Clip<'_>) -> Vec<u32> {
    clip.segments().map(|segment| segment.start_frame()).collect()
}

/// Calls `look` with the number of each segment that one of the clips has, and with the segments.
fn each_segment<'d>(old: &Clip<'d>, new: &Clip<'d>, mut look: impl FnMut(u32, Change<Option<Segment<'d>>>)) {
    for segment in 0..old.segment_count().max(new.segment_count()) {
        look(segment, Change { old: old.segment(segment), new: new.segment(segment) });
    }
}

/// Returns the different own texts, or else the different borrowed ones.
fn texts<'d>(old: &Clip<'d>, new: &Clip<'d>, locales: &[LocalePair<'d>]) -> Vec<TextChange<'d>> {
    let own = texts_that(old, new, locales, false);
    if own.is_empty() { texts_that(old, new, locales, true) } else { own }
}

fn texts_that<'d>(
    old: &Clip<'d>,
    new: &Clip<'d>,
    locales: &[LocalePair<'d>],
    is_fallback: bool,
) -> Vec<TextChange<'d>> {
    let text = |segment: Option<Segment<'d>>, locale: Option<Locale>| {
        let text = segment?.text(locale?)?;
        (text.is_fallback() == is_fallback).then_some(text.as_str())
    };
    let mut found = Vec::new();
    // If one bank lacks a locale, its clips cannot borrow from it.
    let has_both = |pair: &&LocalePair<'d>| pair.old.is_some() && pair.new.is_some();
    for pair in locales.iter().filter(|pair| !is_fallback || has_both(pair)) {
        each_segment(old, new, |segment, both| {
            if let Some(change) = Change::between(text(both.old, pair.old), text(both.new, pair.new)) {
                found.push(TextChange { locale: pair.tag, segment, text: change, is_fallback });
            }
        });
    }
    found
}

fn events<'d>(old: &Clip<'d>, new: &Clip<'d>) -> Vec<EventChange<'d>> {
    let event = |segment: Option<Segment<'d>>| segment?.event();
    let mut found = Vec::new();
    each_segment(old, new, |segment, both| {
        found.extend(Change::between(event(both.old), event(both.new)).map(|event| EventChange { segment, event }));
    });
    found
}
