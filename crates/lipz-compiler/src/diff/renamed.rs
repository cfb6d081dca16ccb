//! Clips that have another key and are otherwise the same.

use super::{ClipChange, Difference, LocalePair};
use foldhash::fast::FixedState;
use lipz_bank::{Clip, Dialogue, Locale};
use std::collections::{HashMap, HashSet, VecDeque};
use std::hash::{BuildHasher, Hash, Hasher};

/// A clip that is in both banks under different keys.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct Renamed<'d> {
    /// The key in the old bank.
    pub old: &'d str,
    /// The key in the new bank.
    pub new: &'d str,
}

/// Pairs removed clips with equal added ones, in the order of their keys.
pub(super) fn find<'d>(
    difference: &mut Difference<'d>,
    old: &'d Dialogue<'d>,
    new: &'d Dialogue<'d>,
    locales: &[LocalePair<'d>],
) {
    let old_locales: Vec<_> = locales.iter().filter_map(|pair| Some((pair.tag, pair.old?))).collect();
    let new_locales: Vec<_> = locales.iter().filter_map(|pair| Some((pair.tag, pair.new?))).collect();
    let mut candidates: HashMap<u64, VecDeque<Clip<'_>>> = HashMap::new();
    for clip in difference.added.iter().filter_map(|key| new.clip_by_key(key)) {
        candidates.entry(digest(&clip, &new_locales)).or_default().push_back(clip);
    }
    for clip in difference.removed.iter().filter_map(|key| old.clip_by_key(key)) {
        let Some(equal) = candidates.get_mut(&digest(&clip, &old_locales)) else { continue };
        // Clips of one digest that are not equal are too rare to look further.
        if equal.front().is_some_and(|other| ClipChange::between(&clip, other, locales).is_none())
            && let Some(other) = equal.pop_front()
        {
            difference.renamed.push(Renamed { old: clip.key(), new: other.key() });
        }
    }
    let paired = |key: fn(&Renamed<'d>) -> &'d str| difference.renamed.iter().map(key).collect::<HashSet<_>>();
    let (old_keys, new_keys) = (paired(|pair| pair.old), paired(|pair| pair.new));
    difference.removed.retain(|key| !old_keys.contains(key));
    difference.added.retain(|key| !new_keys.contains(key));
}

/// A hash of what [`ClipChange::between`] compares; equal clips have equal ones.
fn digest(clip: &Clip<'_>, locales: &[(&str, Locale)]) -> u64 {
    let mut hasher = FixedState::default().build_hasher();
    (clip.frames(), clip.segment_count()).hash(&mut hasher);
    for segment in clip.segments() {
        segment.event().hash(&mut hasher);
        for (tag, locale) in locales {
            if let Some(text) = segment.text(*locale).filter(|text| !text.is_fallback()) {
                (tag, text.as_str()).hash(&mut hasher);
            }
        }
    }
    hasher.finish()
}
