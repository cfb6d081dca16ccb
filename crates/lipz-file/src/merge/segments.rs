//! Merging the segments of visemes, texts and events.

use super::elements::{ElementVersions, MergedElement};
use crate::locale::text_name;
use crate::text::{DELIMITER, segments, trim};
use crate::{JsonString, Value};
use std::borrow::Cow;
use std::collections::HashMap;

/// The values of both sides.
type BothValues<'s> = (Option<Value<'s>>, Option<Value<'s>>);

/// Whether the value of an element is divided into segments.
fn has_segments(name: &str) -> bool {
    matches!(name, "visemes" | "events") || text_name(name).is_some()
}

/// Returns the segments of an element, with their spaces.
fn parts<'d>(name: &str, value: Option<&'d Value<'_>>) -> Option<Vec<&'d str>> {
    match value {
        Some(Value::String(string)) if has_segments(name) => {
            Some(segments(&string.text).map(|range| string.text.get(range).unwrap_or_default()).collect())
        }
        _ => None,
    }
}

/// Merges the segments of an element that both sides have changed. Returns `None` if it has no segments, or if their
/// number has changed.
pub(super) fn merge<'s>(name: &str, of: ElementVersions<'_, 's>) -> Option<BothValues<'s>> {
    let [base, ours, theirs] = [of.base, of.ours, of.theirs].map(|value| parts(name, value));
    let (ours, theirs) = (ours?, theirs?);
    let base = base.unwrap_or_default();
    // A text that both sides have added has no base.
    let is_new = of.base.is_none();
    if ours.len() != theirs.len() || !(is_new || base.len() == ours.len()) {
        return None;
    }
    let (mut by_us, mut by_them) = (Vec::with_capacity(ours.len()), Vec::with_capacity(ours.len()));
    for (at, (our, their)) in ours.into_iter().zip(theirs).enumerate() {
        let old = base.get(at).map_or("", |old| trim(old));
        let (our_merged, their_merged) = match (trim(our) == old, trim(their) == old) {
            (_, true) => (our, our),
            (true, false) => (their, their),
            (false, false) if trim(our) == trim(their) => (our, our),
            (false, false) => (our, their),
        };
        by_us.push(our_merged);
        by_them.push(their_merged);
    }
    Some((Some(joined(&by_us)), Some(joined(&by_them))))
}

fn joined<'s>(parts: &[&str]) -> Value<'s> {
    Value::String(JsonString::from(Cow::Owned(parts.join(&DELIMITER.to_string()))))
}

/// The elements of three versions, for the number of segments of the clip.
pub(super) struct Counts<'m, 'd, 's> {
    pub(super) base: &'m HashMap<&'d str, &'d Value<'s>>,
    pub(super) ours: &'m HashMap<&'d str, &'d Value<'s>>,
    pub(super) theirs: &'m HashMap<&'d str, &'d Value<'s>>,
}

impl Counts<'_, '_, '_> {
    /// Returns the number of segments that the merged clip has if one side has changed it.
    pub(super) fn expected(&self) -> Option<usize> {
        let [base, ours, theirs] = [self.base, self.ours, self.theirs].map(count);
        match (base == ours, base == theirs) {
            (true, false) => theirs,
            (false, true) => ours,
            _ => None,
        }
    }
}

/// Returns the number of segments of a clip.
fn count(elements: &HashMap<&str, &Value<'_>>) -> Option<usize> {
    elements.iter().filter_map(|(name, value)| Some(parts(name, Some(value))?.len())).max()
}

/// Whether the value of an element would have a different number of segments.
pub(super) fn has_other_count(merged: &MergedElement<'_>, count: usize) -> bool {
    parts(&merged.name, merged.ours()).is_some_and(|parts| parts.len() != count)
}
