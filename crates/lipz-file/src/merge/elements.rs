//! The elements of a merged file, in the order of our version.

use super::{recording, segments};
use crate::{Document, Element, JsonString, Value};
use std::borrow::Cow;
use std::collections::HashMap;

/// The values of an element on both sides. They are equal unless the element is a conflict.
#[derive(Clone, Debug)]
pub(super) struct MergedElement<'s> {
    pub(super) name: String,
    pub(super) ours: Option<Value<'s>>,
    pub(super) theirs: Option<Value<'s>>,
}

impl<'s> MergedElement<'s> {
    pub(super) fn is_conflict(&self) -> bool {
        self.ours != self.theirs
    }

    pub(super) fn ours(&self) -> Option<&Value<'s>> {
        self.ours.as_ref()
    }

    /// Returns our value, or the only one.
    pub(super) fn ours_first(&self) -> Option<&Value<'s>> {
        self.ours.as_ref().or(self.theirs.as_ref())
    }

    /// Returns their value, or the only one.
    pub(super) fn theirs_first(&self) -> Option<&Value<'s>> {
        self.theirs.as_ref().or(self.ours.as_ref())
    }
}

/// Three versions of an element.
#[derive(Clone, Copy)]
pub(super) struct ElementVersions<'d, 's> {
    pub(super) base: Option<&'d Value<'s>>,
    pub(super) ours: Option<&'d Value<'s>>,
    pub(super) theirs: Option<&'d Value<'s>>,
}

impl ElementVersions<'_, '_> {
    pub(super) fn is_changed_by_us(&self) -> bool {
        !is_same(self.base, self.ours)
    }

    pub(super) fn is_changed_by_them(&self) -> bool {
        !is_same(self.base, self.theirs)
    }
}

/// Whether both values are missing, or differ at most in spaces around `|`.
pub(super) fn is_same(one: Option<&Value<'_>>, other: Option<&Value<'_>>) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => one.says_the_same(other),
        (one, other) => one.is_none() && other.is_none(),
    }
}

/// Merges the elements of three versions.
pub(super) fn merge<'s>(base: &Document<'s>, ours: &Document<'s>, theirs: &Document<'s>) -> Vec<MergedElement<'s>> {
    let [base, by_us, by_them] = [base, ours, theirs].map(values);
    let versions = |name: &str| ElementVersions {
        base: base.get(name).copied(),
        ours: by_us.get(name).copied(),
        theirs: by_them.get(name).copied(),
    };
    let recording = recording::Changes::of(versions);
    let segment_counts = segments::Counts { base: &base, ours: &by_us, theirs: &by_them };
    let expected_count = segment_counts.expected();
    let merge_one = |name: String| {
        let of = versions(&name);
        let mut merged = match recording.is_conflict(&name) {
            true => MergedElement { name, ours: of.ours.cloned(), theirs: of.theirs.cloned() },
            false => one(name, of),
        };
        let is_stale = || expected_count.is_some_and(|count| segments::has_other_count(&merged, count));
        if !merged.is_conflict() && !is_same(of.ours, of.theirs) && is_stale() {
            (merged.ours, merged.theirs) = (of.ours.cloned(), of.theirs.cloned());
        }
        merged
    };
    let names = names(ours, theirs).into_iter();
    names.map(merge_one).filter(|merged| merged.ours.is_some() || merged.theirs.is_some()).collect()
}

/// Merges an element.
fn one<'s>(name: String, of: ElementVersions<'_, 's>) -> MergedElement<'s> {
    let both = |value: Option<Value<'s>>| (value.clone(), value);
    let (ours, theirs) = if is_same(of.ours, of.theirs) || !of.is_changed_by_them() {
        both(of.ours.cloned())
    } else if !of.is_changed_by_us() {
        both(of.theirs.cloned())
    } else {
        segments::merge(&name, of).unwrap_or((of.ours.cloned(), of.theirs.cloned()))
    };
    MergedElement { name, ours, theirs }
}

/// Returns the names of all elements: those of our version in its order, and each new name before the one that follows it
/// in the other version.
fn names(ours: &Document<'_>, theirs: &Document<'_>) -> Vec<String> {
    let own: Vec<&str> = ours.elements.iter().map(|element| element.name.text.as_ref()).collect();
    let places: HashMap<&str, usize> = own.iter().enumerate().map(|(place, name)| (*name, place)).collect();
    // The new names before each own name, and at the end; from last to first.
    let mut added: Vec<Vec<&str>> = vec![Vec::new(); own.len() + 1];
    let mut place = own.len();
    for element in theirs.elements.iter().rev() {
        let name = element.name.text.as_ref();
        match places.get(name) {
            Some(known) => place = *known,
            None => added.iter_mut().skip(place).take(1).for_each(|names| names.push(name)),
        }
    }
    let own = own.into_iter().map(Some).chain([None]);
    let all = added.into_iter().zip(own).flat_map(|(before, name)| before.into_iter().rev().chain(name));
    all.map(str::to_owned).collect()
}

fn values<'d, 's>(document: &'d Document<'s>) -> HashMap<&'d str, &'d Value<'s>> {
    document.elements.iter().map(|element| (element.name.text.as_ref(), &element.value)).collect()
}

/// Returns the document with one of the values of each element.
pub(super) fn document<'s>(
    merged: &[MergedElement<'s>],
    value: for<'m> fn(&'m MergedElement<'s>) -> Option<&'m Value<'s>>,
) -> Document<'s> {
    let element = |merged: &MergedElement<'s>| {
        let name = JsonString::from(Cow::Owned(merged.name.clone()));
        Some(Element { name, value: value(merged)?.clone() })
    };
    Document { elements: merged.iter().filter_map(element).collect() }
}
