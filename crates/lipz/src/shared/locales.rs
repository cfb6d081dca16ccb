//! Locales of a bank, as arguments and output name them.

use lipz_diagnostics::{Code, Report, escape};
use lipz_file::locale::canonical_tag;
use std::borrow::Cow;

/// The help for a bank without locales.
const NO_TEXTS: &str = "add the text banks of a split bank: BANK+TEXTS";

/// Returns the name of a text's locale for people.
pub(crate) fn locale_name(tag: &str) -> Cow<'_, str> {
    if tag.is_empty() { "(not packed)".into() } else { escape::text(tag) }
}

/// Returns the locale of `bank` with the tag `asked` in any spelling: `de_DE` is `de-de`. Otherwise, reports the
/// available locales.
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
        let help = if tags.is_empty() {
            NO_TEXTS.to_owned()
        } else {
            format!("choose one of its locales: {}", tags.join(", "))
        };
        let message = format!("the bank has no locale {}", escape::quoted(asked));
        Report::failure(bank, Code::NoSuchLocale, message, &help)
    })
}
