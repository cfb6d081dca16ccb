//! Locales of a bank, as arguments name them and as people read them.

use lipz_diagnostics::{Code, Report, escape};
use lipz_file::locale::canonical_tag;
use std::borrow::Cow;

/// What to do about a bank without locales.
const NO_TEXTS: &str = "it has no texts; those of a split bank are in its text banks (--texts)";

/// The locale that a text was taken from, for people.
pub(crate) fn locale_name(tag: &str) -> Cow<'_, str> {
    if tag.is_empty() { "(not packed)".into() } else { escape::text(tag) }
}

/// The one of the locales of `bank` whose tag is `asked`, however it is spelled: `de_DE` is `de-de`. If there is none,
/// the report names those that there are.
pub(crate) fn choose<T>(
    asked: &str,
    bank: &str,
    known: impl Iterator<Item = T> + Clone,
    tag: impl Fn(&T) -> &str,
) -> Result<T, Report> {
    let canonical = canonical_tag(asked, true);
    let wanted = canonical.as_deref().unwrap_or(asked);
    known.clone().find(|locale| tag(locale) == wanted).ok_or_else(|| {
        let tags: Vec<_> = known.map(|locale| escape::text(tag(&locale)).into_owned()).collect();
        let help = if tags.is_empty() { NO_TEXTS.to_owned() } else { format!("it has {}", tags.join(", ")) };
        let message = format!("the bank has no locale {}", escape::quoted(asked));
        Report::failure(bank, Code::NoSuchLocale, message, &help)
    })
}
