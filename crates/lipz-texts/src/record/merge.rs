//! Merging of lines about the same source texts into as few lines as possible. Records with the same content produce
//! the same file, in any order of merges.

use super::version::{ApprovedMark, Version};
use crate::exchange::Mark;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::mem;

/// Merges versions with the same source texts, and sorts them by these. If a translation has two states, the further
/// one counts. If there are several translations, all count: those of each segment are sorted by mark, each in its own
/// version.
pub(super) fn merge(versions: &mut Vec<Version>) {
    versions.retain(|version| !version.is_untranslated());
    versions.sort_by(|a, b| a.texts().cmp(&b.texts()));
    let mut merged = Vec::with_capacity(versions.len());
    let mut rest = mem::take(versions).into_iter().peekable();
    while let Some(first) = rest.next() {
        let mut same = Vec::new();
        while let Some(other) = rest.next_if(|other| other.texts() == first.texts()) {
            same.push(other.made);
        }
        if same.is_empty() {
            merged.push(first.without_nothing());
        } else {
            merged.extend(first.with(same));
        }
    }
    *versions = merged;
}

impl Version {
    fn texts(&self) -> (&str, &[String]) {
        (&self.source_locale, &self.sources)
    }

    /// Drops locales without information.
    fn without_nothing(mut self) -> Version {
        self.made.retain(|_, made| made.iter().any(Option::is_some));
        self
    }

    /// Returns versions with the content of this one and others of the same texts.
    fn with(mut self, others: Vec<BTreeMap<String, Vec<Option<ApprovedMark>>>>) -> Vec<Version> {
        // Usually they have different locales.
        let mut same: BTreeMap<String, Vec<Vec<Option<ApprovedMark>>>> = BTreeMap::new();
        for (locale, made) in others.into_iter().flatten() {
            match self.made.entry(locale) {
                Entry::Vacant(own) => drop(own.insert(made)),
                Entry::Occupied(own) => same.entry(own.key().clone()).or_default().push(made),
            }
        }
        let mut rest: Vec<Version> = Vec::new();
        for (locale, others) in same {
            let own = self.made.remove(&locale);
            let mut rows = laid_out(own.into_iter().chain(others)).into_iter();
            self.made.extend(rows.next().map(|row| (locale.clone(), row)));
            for (number, row) in rows.enumerate() {
                let made = (locale.clone(), row);
                match rest.get_mut(number) {
                    Some(version) => version.made.extend([made]),
                    None => rest.push(Version {
                        source_locale: self.source_locale.clone(),
                        sources: self.sources.clone(),
                        made: BTreeMap::from([made]),
                    }),
                }
            }
        }
        [self.without_nothing()].into_iter().chain(rest).collect()
    }
}

/// Arranges the distinct marks of each segment in as few rows as possible: each row has the next one of every segment.
fn laid_out(all: impl Iterator<Item = Vec<Option<ApprovedMark>>>) -> Vec<Vec<Option<ApprovedMark>>> {
    let mut known: Vec<BTreeMap<Mark, ApprovedMark>> = Vec::new();
    for made in all {
        known.resize_with(known.len().max(made.len()), BTreeMap::new);
        for (segment, made) in known.iter_mut().zip(made) {
            if let Some(made) = made {
                let known = segment.entry(made.mark).or_insert(made);
                known.state = known.state.max(made.state);
                known.is_imported |= made.is_imported;
            }
        }
    }
    let count = known.iter().map(BTreeMap::len).max().unwrap_or_default();
    let mut segments: Vec<_> = known.into_iter().map(BTreeMap::into_iter).collect();
    let row = |_| segments.iter_mut().map(|segment| segment.next().map(|(_, made)| made)).collect();
    (0..count).map(row).collect()
}
