//! Clips with the texts of some locales only.

use super::{ClipData, ClipText, Locales};
use crate::{Options, fallback};
use std::collections::BTreeSet;

impl ClipData {
    /// Keeps the texts of the `packed` locales. Where one of these has no text and falls back to a
    /// locale that is not packed, it gets that one's text, marked as a fallback.
    pub(crate) fn keep_texts(&mut self, packed: &BTreeSet<String>, locales: &mut Locales, options: &Options) {
        let own: Vec<ClipText> = std::mem::take(&mut self.texts);
        let tags: Vec<String> = own.iter().map(|text| locales.tag(text.locale).to_owned()).collect();
        for tag in packed {
            if let Some(index) = tags.iter().position(|known| known == tag) {
                self.texts.push(own[index].clone());
                continue;
            }
            // It comes last: the other places stay those of the clip's texts.
            let with_tag: Vec<&String> = tags.iter().chain([tag]).collect();
            let nearest = fallback::chain(&with_tag, tags.len(), options).into_iter().next();
            if let Some(index) = nearest.filter(|&index| !packed.contains(&tags[index])) {
                let locale = locales.number(tag, false);
                self.texts.push(ClipText { locale, is_fallback: true, ..own[index].clone() });
            }
        }
        // The packed locales are in the order of their tags, and so are these texts.
    }
}
