//! The options for merging translations into Lipz files.

use crate::exchange::{Mark, State};
use lipz_diagnostics::Levels;
use lipz_file::placeholder::PlaceholderPattern;
use std::collections::BTreeSet;

/// The options for merging translations into Lipz files.
#[derive(Clone, PartialEq, Debug)]
pub struct Merge<'a> {
    pub(super) source_locale: &'a str,
    pub(super) default_locale: Option<&'a str>,
    pub(super) min_state: State,
    pub(super) is_forced: bool,
    pub(super) levels: Levels,
    pub(super) imported: BTreeSet<(String, Mark)>,
    pub(super) placeholders: &'a [PlaceholderPattern],
}

impl<'a> Merge<'a> {
    /// Returns the options for translations from this locale.
    pub fn new(source_locale: &'a str) -> Merge<'a> {
        Merge {
            source_locale,
            default_locale: None,
            min_state: State::Translated,
            is_forced: false,
            levels: Levels::default(),
            imported: BTreeSet::new(),
            placeholders: &[],
        }
    }

    /// Sets the locale of `text` without a locale, which is also the first one in the layout.
    #[must_use]
    pub fn default_locale(self, locale: Option<&'a str>) -> Self {
        Merge { default_locale: locale, ..self }
    }

    /// Sets the least state of imported translations.
    #[must_use]
    pub fn min_state(self, min_state: State) -> Self {
        Merge { min_state, ..self }
    }

    /// Sets whether translations are imported even if their texts have changed since the export.
    #[must_use]
    pub fn forced(self, is_forced: bool) -> Self {
        Merge { is_forced, ..self }
    }

    /// Sets the locales and marks of texts that imports put into the clip: [`TextRecord::imported`]. A later version of the
    /// same file may replace them.
    ///
    /// [`TextRecord::imported`]: crate::TextRecord::imported
    #[must_use]
    pub fn imported(self, imported: BTreeSet<(String, Mark)>) -> Self {
        Merge { imported, ..self }
    }

    /// Whether an import put this text there.
    pub(super) fn is_imported(&self, locale: &str, text: &str) -> bool {
        !self.imported.is_empty() && self.imported.contains(&(locale.to_owned(), Mark::of(text)))
    }

    /// Sets the patterns of the project's own placeholders, which translations repeat.
    #[must_use]
    pub fn placeholders(self, placeholders: &'a [PlaceholderPattern]) -> Self {
        Merge { placeholders, ..self }
    }

    /// Sets the levels of lints. Texts with errors are not imported.
    #[must_use]
    pub fn levels(self, levels: &Levels) -> Self {
        Merge { levels: levels.clone(), ..self }
    }
}
