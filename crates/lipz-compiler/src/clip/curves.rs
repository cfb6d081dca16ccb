//! The curves of clips in flat arrays.

use lipz_bank::curve::CurveValue;
use std::collections::BTreeMap;

/// A key: frame and value.
pub(crate) type Key = (u32, CurveValue);

/// Curves, one after the other.
#[derive(Debug, Default)]
pub(crate) struct Curves {
    names: Vec<Box<str>>,
    /// The end of the keys of each curve.
    ends: Vec<usize>,
    keys: Vec<Key>,
}

impl Curves {
    /// Adds a curve.
    pub(crate) fn push(&mut self, name: &str, keys: impl IntoIterator<Item = Key>) {
        self.names.push(name.into());
        self.keys.extend(keys);
        self.ends.push(self.keys.len());
    }

    /// Returns the number of curves.
    pub(crate) fn count(&self) -> usize {
        self.names.len()
    }

    /// Returns names and keys of the curves with these numbers.
    pub(crate) fn range(&self, numbers: std::ops::Range<usize>) -> impl Iterator<Item = (&str, &[Key])> {
        numbers.map(|number| {
            let start = number.checked_sub(1).map_or(0, |before| self.ends[before]);
            (&*self.names[number], &self.keys[start..self.ends[number]])
        })
    }

    /// Returns all curves.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &[Key])> {
        self.range(0..self.count())
    }

    /// Adds curves whose names are not yet present. All are sorted by name afterwards.
    pub(crate) fn add_missing(&mut self, mut curves: BTreeMap<String, Vec<Key>>) {
        if curves.is_empty() {
            return;
        }
        curves.extend(self.iter().map(|(name, keys)| (name.to_owned(), keys.to_vec())));
        self.clear();
        curves.into_iter().for_each(|(name, keys)| self.push(&name, keys));
    }

    /// Removes all curves and keeps the allocation.
    pub(crate) fn clear(&mut self) {
        self.keep_first(0);
    }

    /// Removes all curves except the first `count`.
    pub(crate) fn keep_first(&mut self, count: usize) {
        self.names.truncate(count);
        self.ends.truncate(count);
        self.keys.truncate(self.ends.last().copied().unwrap_or(0));
    }
}
