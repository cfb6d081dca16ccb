//! Clips with the texts of some locales only.

use super::{ClipData, ClipText, Locales};
use crate::Options;
use crate::fallback::Fallbacks;
use foldhash::HashMap;
use std::collections::BTreeSet;

impl ClipData {
    /// Keeps the texts of the `packed` locales. Where one of these has no text and falls back to a
    /// locale that is not packed, it gets that one's text, marked as a fallback.
    pub(crate) fn keep_texts(&mut self, packed: &BTreeSet<String>, locales: &mut Locales, options: &Options) {
        let own: Vec<ClipText> = std::mem::take(&mut self.texts);
        let tags: Vec<String> = own.iter().map(|text| locales.tag(text.locale).to_owned()).collect();
        // Own texts are in the order of their tags.
        let own_of = |tag: &String| tags.binary_search(tag).ok();
        let missing: Vec<&String> = packed.iter().filter(|tag| own_of(tag).is_none()).collect();
        let mut borrowed: HashMap<usize, usize> = HashMap::default();
        if !missing.is_empty() && !tags.is_empty() {
            // Missing ones come last: the other places stay those of the clip's texts.
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
        // The packed locales are in the order of their tags, and so are these texts.
    }
}
