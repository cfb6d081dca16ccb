//! Pairs of the locales of two banks.

use crate::bank::dialogue::TaggedLocale;
use lipz_bank::Locale;
use std::collections::BTreeMap;

/// One locale in both banks.
pub(super) struct LocalePair<'d> {
    pub(super) tag: &'d str,
    pub(super) old: Option<Locale>,
    pub(super) new: Option<Locale>,
}

impl<'d> LocalePair<'d> {
    /// Returns the locales of both banks, sorted.
    pub(super) fn all(old: &[TaggedLocale<'d>], new: &[TaggedLocale<'d>]) -> Vec<LocalePair<'d>> {
        let mut pairs: BTreeMap<&str, LocalePair<'d>> = BTreeMap::new();
        let absent = |tag| LocalePair { tag, old: None, new: None };
        for locale in old {
            pairs.entry(locale.tag).or_insert_with_key(|tag| absent(tag)).old = Some(locale.locale);
        }
        for locale in new {
            pairs.entry(locale.tag).or_insert_with_key(|tag| absent(tag)).new = Some(locale.locale);
        }
        pairs.into_values().collect()
    }
}
