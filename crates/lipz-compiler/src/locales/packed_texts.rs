//! Clips with the texts of some locales only.

use crate::clip::{ClipData, ClipText, Locales};
use crate::locales::fallback::Fallbacks;
use crate::project::Options;
use foldhash::HashMap;
use lipz_file::locale::{split_variant, variant_tag};
use std::borrow::Cow;
use std::collections::BTreeSet;

impl ClipData {
    /// Keeps the texts of the `packed` locales and their variants. A locale without a text that falls back to an unpacked
    /// locale gets a copy of its text and of the variants, marked as a fallback.
    pub(crate) fn keep_texts(&mut self, packed: &BTreeSet<String>, locales: &mut Locales, options: &Options) {
        let own: Vec<ClipText> = std::mem::take(&mut self.texts);
        let tags: Vec<String> = own.iter().map(|text| locales.tag(text.locale).to_owned()).collect();
        let packed = &*with_variants(packed, &tags);
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

/// Returns the packed locales with the variants of a clip that has texts with these tags: its own ones, and those that a
/// packed locale may borrow.
fn with_variants<'p>(packed: &'p BTreeSet<String>, tags: &[String]) -> Cow<'p, BTreeSet<String>> {
    let mut all = Cow::Borrowed(packed);
    for tag in tags {
        let (locale, Some(key)) = split_variant(tag) else { continue };
        if packed.contains(locale) {
            all.to_mut().insert(tag.clone());
            continue;
        }
        let borrowers = packed.iter().filter(|packed| !tags.contains(packed));
        all.to_mut().extend(borrowers.map(|packed| variant_tag(packed, key)));
    }
    all
}
