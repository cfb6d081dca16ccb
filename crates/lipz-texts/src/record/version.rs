//! The source texts of a clip at one time, and their translations.

use crate::exchange::{Mark, State};
use lipz_file::locale::split_variant;
use std::collections::BTreeMap;

/// The source texts of a clip at one time, and the translations made from them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct Version {
    /// With the key of a variant, if these are its texts: `en-us-x-few`.
    pub(super) source_locale: String,
    /// The texts of its segments.
    pub(super) sources: Vec<String>,
    /// By locale, the information about the translation of each segment.
    pub(super) made: BTreeMap<String, Vec<Option<ApprovedMark>>>,
}

impl Version {
    /// Whether the version has source texts, but no translation.
    pub(super) fn is_untranslated(&self) -> bool {
        self.made.values().flatten().all(Option::is_none)
    }

    /// Returns the source locale, without the variant whose texts these are.
    pub(super) fn locale(&self) -> &str {
        split_variant(&self.source_locale).0
    }
}

/// An approved translation of a segment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ApprovedMark {
    /// The mark of its text.
    pub(super) mark: Mark,
    pub(super) state: State,
    /// Whether an import put the text there, or found it unchanged.
    pub(super) is_imported: bool,
}
