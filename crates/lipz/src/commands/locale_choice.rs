//! Locales of a bank, as arguments name them and as people read them.

use crate::{Outcome, console};
use lipz_diagnostics::escape;
use lipz_file::locale::canonical_tag;
use std::borrow::Cow;

/// The locale that a text was taken from, for people.
pub(super) fn locale_name(tag: &str) -> Cow<'_, str> {
    if tag.is_empty() { "(not packed)".into() } else { escape::text(tag) }
}

/// The one of `known` whose tag is `asked`, however it is spelled: `de_DE` is `de-de`. Says which ones there
/// are if there is none.
pub(super) fn choose<T>(
    asked: &str,
    known: impl Iterator<Item = T> + Clone,
    tag: impl Fn(&T) -> &str,
) -> Result<T, Outcome> {
    let canonical = canonical_tag(asked, true);
    let wanted = canonical.as_deref().unwrap_or(asked);
    known.clone().find(|locale| tag(locale) == wanted).ok_or_else(|| {
        let tags: Vec<_> = known.map(|locale| escape::text(tag(&locale)).into_owned()).collect();
        let asked = escape::text(asked);
        console::remark(&format!("error: no locale `{asked}` in the bank\nhelp: it has {}\n", tags.join(", ")));
        Outcome::Failed
    })
}
