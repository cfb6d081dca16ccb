//! What several lines say about the same source texts, in as few lines as can be: records that say the same are the same
//! file, whatever was merged in which order.

use super::{Made, Version};
use crate::{Mark, State};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::mem;

/// Puts versions with the same source texts together, in the order of these. Of two states of a translation, the further
/// one counts; of several translations, all: those of a segment in the order of their marks, each in a version of its own.
pub(super) fn merge(versions: &mut Vec<Version>) {
    versions.retain(|version| version.made.values().flatten().any(Option::is_some));
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

    /// Without locales of which it knows nothing.
    fn without_nothing(mut self) -> Version {
        self.made.retain(|_, made| made.iter().any(Option::is_some));
        self
    }

    /// The versions that say what this one and others of the same texts do.
    fn with(mut self, others: Vec<BTreeMap<String, Vec<Option<Made>>>>) -> Vec<Version> {
        // Mostly they are about different locales.
        let mut same: BTreeMap<String, Vec<Vec<Option<Made>>>> = BTreeMap::new();
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

/// What is known of the segments of a translation, each once, in as few rows as can be: in each the next one of every segment.
fn laid_out(all: impl Iterator<Item = Vec<Option<Made>>>) -> Vec<Vec<Option<Made>>> {
    let mut known: Vec<BTreeMap<Mark, State>> = Vec::new();
    for made in all {
        known.resize_with(known.len().max(made.len()), BTreeMap::new);
        for (segment, made) in known.iter_mut().zip(made) {
            if let Some(Made { mark, state }) = made {
                let known = segment.entry(mark).or_insert(state);
                *known = state.max(*known);
            }
        }
    }
    let count = known.iter().map(BTreeMap::len).max().unwrap_or_default();
    let mut segments: Vec<_> = known.into_iter().map(BTreeMap::into_iter).collect();
    let row = |_| segments.iter_mut().map(|segment| segment.next().map(|(mark, state)| Made { mark, state })).collect();
    (0..count).map(row).collect()
}
