//! The source texts of a clip at one time, and their translations.

use crate::exchange::{Mark, State};
use std::collections::BTreeMap;

/// The source texts of a clip at one time, and the translations made from them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct Version {
    pub(super) source_locale: String,
    /// The texts of its segments.
    pub(super) sources: Vec<String>,
    /// By locale, the information about the translation of each segment.
    pub(super) made: BTreeMap<String, Vec<Option<ApprovedMark>>>,
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
