//! A clean file as the checks see it.

use super::elements::{CleanRole, Element};
use crate::clip::{ClipData, Locales};
use crate::project::Options;

/// A file without escapes, unknown elements and values of wrong types, whose elements all have as many segments.
pub(in crate::check) struct CleanFile<'f> {
    pub(super) file: &'f str,
    pub(super) elements: &'f [Element],
    pub(in crate::check) clip: &'f ClipData,
    pub(in crate::check) locales: &'f Locales,
    pub(in crate::check) options: &'f Options,
    /// Whether a segment of a text displays nothing.
    pub(in crate::check) has_blank: bool,
}

impl CleanFile<'_> {
    /// The text elements as they are written.
    #[allow(dead_code, reason = "for checks of what is written; those so far go by what is displayed")]
    pub(in crate::check) fn texts(&self) -> impl Iterator<Item = &str> {
        let texts = self.elements.iter().filter(|element| matches!(element.role, CleanRole::Text(_)));
        texts.filter_map(|element| self.file.get(element.place.clone()))
    }

    /// The display texts of each locale. The segments of a text are concatenated.
    pub(in crate::check) fn displays(&self) -> impl Iterator<Item = &[u8]> {
        self.clip.texts.iter().map(|text| self.clip.text_of(text))
    }
}
