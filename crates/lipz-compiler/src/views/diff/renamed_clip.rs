//! Clips that differ only in their keys.

use super::locale_pair::LocalePair;
use super::{ClipChange, Difference};
use foldhash::fast::FixedState;
use lipz_bank::{Clip, Dialogue, Locale};
use std::collections::{HashMap, HashSet, VecDeque};
use std::hash::{BuildHasher, Hash, Hasher};

/// A clip in both banks with different keys.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct RenamedClip<'d> {
    /// The key in the old bank.
    pub old: &'d str,
    /// The key in the new bank.
    pub new: &'d str,
}

/// Pairs removed clips with equal added ones, sorted by key.
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
        // Unequal clips with the same digest are too rare for a further search.
        if equal.front().is_some_and(|other| ClipChange::between(&clip, other, locales).is_none())
            && let Some(other) = equal.pop_front()
        {
            difference.renamed.push(RenamedClip { old: clip.key(), new: other.key() });
        }
    }
    let paired = |key: fn(&RenamedClip<'d>) -> &'d str| difference.renamed.iter().map(key).collect::<HashSet<_>>();
    let (old_keys, new_keys) = (paired(|pair| pair.old), paired(|pair| pair.new));
    difference.removed.retain(|key| !old_keys.contains(key));
    difference.added.retain(|key| !new_keys.contains(key));
}

/// Returns a hash of the content that [`ClipChange::between`] compares. Equal clips have equal hashes.
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
