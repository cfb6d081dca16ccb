//! Clips with the texts of some locales only.

use crate::clip::{ClipData, ClipText, Locales};
use crate::locales::fallback::Fallbacks;
use crate::project::Options;
use foldhash::HashMap;
use std::collections::BTreeSet;

impl ClipData {
    /// Keeps the texts of the `packed` locales. A locale without a text that falls back to an unpacked locale gets a
    /// copy of its text, marked as a fallback.
    pub(crate) fn keep_texts(&mut self, packed: &BTreeSet<String>, locales: &mut Locales, options: &Options) {
        let own: Vec<ClipText> = std::mem::take(&mut self.texts);
        let tags: Vec<String> = own.iter().map(|text| locales.tag(text.locale).to_owned()).collect();
        // Own texts are sorted by tag.
        let own_of = |tag: &String| tags.binary_search(tag).ok();
        let missing: Vec<&String> = packed.iter().filter(|tag| own_of(tag).is_none()).collect();
        let mut borrowed: HashMap<usize, usize> = HashMap::default();
        if !missing.is_empty() && !tags.is_empty() {
            // Add missing ones at the end, so that the other indexes remain those of the clip's texts.
            let all: Vec<&String> = tags.iter().chain(missing.iter().copied()).collect();
            let places = tags.len()..all.len();
            Fallbacks::new(&all, options).resolve(0..tags.len(), places, |locale, other| {
                borrowed.insert(locale - tags.len(), other);
            });
        }
        let mut missing_count = 0;
        for tag in packed {
            if let Some(index) = own_of(tag) {
                self.texts.push(own[index]);
                continue;
            }
            let nearest = borrowed.get(&missing_count).copied();
            missing_count += 1;
            if let Some(index) = nearest.filter(|&index| !packed.contains(&tags[index])) {
                let locale = locales.number(tag, false);
                self.texts.push(own[index].as_fallback_of(locale));
            }
        }
        // The packed locales are sorted by tag, and so are these texts.
    }
}
