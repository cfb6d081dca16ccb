//! What `lipz diff --json` prints. Fields are only ever added (docs/VERSIONING.md).

use crate::shared::babble_json::BabbleJson;
use lipz_bank::{Fps, VisemeType};
use lipz_compiler::diff::{BabbleChange, Change, ClipChange, Difference, FallbackChange, FramesChange};
use serde::Serialize;
use std::collections::BTreeSet;

#[derive(Serialize)]
pub(super) struct DifferenceJson<'d> {
    is_same: bool,
    added_locales: &'d [&'d str],
    removed_locales: &'d [&'d str],
    default_locale: Option<ChangeJson<Option<&'d str>>>,
    fallbacks: Vec<FallbackJson<'d>>,
    babble: Vec<BabbleChangeJson<'d>>,
    added: &'d [&'d str],
    removed: &'d [&'d str],
    renamed: Vec<ChangeJson<&'d str>>,
    changed: Vec<ClipJson<'d>>,
    same: usize,
}

#[derive(Serialize)]
struct ChangeJson<T> {
    old: T,
    new: T,
}

impl<T> ChangeJson<T> {
    /// The change with both values in their JSON form.
    fn of<V>(change: Change<V>, json: impl Fn(V) -> T) -> ChangeJson<T> {
        ChangeJson { old: json(change.old), new: json(change.new) }
    }
}

/// A locale whose clips borrow texts from others than before.
#[derive(Serialize)]
struct FallbackJson<'d> {
    locale: &'d str,
    old: &'d BTreeSet<String>,
    new: &'d BTreeSet<String>,
}

/// A babble profile; `null` stands for none.
#[derive(Serialize)]
struct BabbleChangeJson<'d> {
    name: &'d str,
    old: Option<BabbleJson<'d>>,
    new: Option<BabbleJson<'d>>,
}

/// A changed clip; `null` and empty lists stand for what did not change.
#[derive(Serialize)]
struct ClipJson<'d> {
    key: &'d str,
    fps: Option<ChangeJson<Option<[u32; 2]>>>,
    viseme_type: Option<ChangeJson<Option<&'static str>>>,
    frames: Option<FramesJson>,
    segment_starts: Option<ChangeJson<Vec<u32>>>,
    texts: Vec<TextJson<'d>>,
    events: Vec<EventJson<'d>>,
}

#[derive(Serialize)]
struct FramesJson {
    /// Numbers of frames; `null` for a clip without mouth shapes.
    counts: ChangeJson<Option<u32>>,
    differing: u32,
    first: Option<u32>,
}

#[derive(Serialize)]
struct TextJson<'d> {
    locale: &'d str,
    segment: u32,
    old: Option<&'d str>,
    new: Option<&'d str>,
    is_fallback: bool,
}

#[derive(Serialize)]
struct EventJson<'d> {
    segment: u32,
    old: Option<&'d str>,
    new: Option<&'d str>,
}

impl<'d> DifferenceJson<'d> {
    pub(super) fn of(difference: &'d Difference<'d>) -> Self {
        let renamed = difference.renamed.iter().map(|pair| ChangeJson { old: pair.old, new: pair.new });
        DifferenceJson {
            is_same: difference.is_empty(),
            added_locales: &difference.added_locales,
            removed_locales: &difference.removed_locales,
            default_locale: difference.default_locale.map(|change| ChangeJson::of(change, |tag| tag)),
            fallbacks: difference.fallbacks.iter().map(FallbackJson::of).collect(),
            babble: difference.babble.iter().map(BabbleChangeJson::of).collect(),
            added: &difference.added,
            removed: &difference.removed,
            renamed: renamed.collect(),
            changed: difference.changed.iter().map(ClipJson::of).collect(),
            same: difference.same,
        }
    }
}

impl<'d> FallbackJson<'d> {
    fn of(change: &'d FallbackChange<'d>) -> Self {
        FallbackJson { locale: change.locale, old: &change.from.old, new: &change.from.new }
    }
}

impl<'d> BabbleChangeJson<'d> {
    fn of(change: &BabbleChange<'d>) -> Self {
        let Change { old, new } = change.profile;
        BabbleChangeJson { name: change.name, old: old.map(BabbleJson::of), new: new.map(BabbleJson::of) }
    }
}

impl<'d> ClipJson<'d> {
    fn of(clip: &ClipChange<'d>) -> Self {
        let fps = |fps: Option<Fps>| fps.map(|fps| [fps.numerator(), fps.denominator()]);
        let texts = clip.texts.iter().map(|text| TextJson {
            locale: text.locale,
            segment: text.segment,
            old: text.text.old,
            new: text.text.new,
            is_fallback: text.is_fallback,
        });
        let events = clip.events.iter();
        ClipJson {
            key: clip.key,
            fps: clip.fps.map(|change| ChangeJson::of(change, fps)),
            viseme_type: clip.viseme_type.map(|change| ChangeJson::of(change, |kind| kind.map(VisemeType::name))),
            frames: clip.frames.map(FramesJson::of),
            segment_starts: clip.segment_starts.clone().map(|change| ChangeJson::of(change, |starts| starts)),
            texts: texts.collect(),
            events: events
                .map(|event| EventJson { segment: event.segment, old: event.event.old, new: event.event.new })
                .collect(),
        }
    }
}

impl FramesJson {
    fn of(frames: FramesChange) -> Self {
        let counts = ChangeJson::of(frames.counts, |count| count);
        FramesJson { counts, differing: frames.differing, first: frames.first }
    }
}
