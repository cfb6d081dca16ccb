//! The element with the text of a clip in a locale.

use lipz_file::locale::{TextName, text_name};
use lipz_file::{Document, Element};

/// Returns the locale of a text from the name of its element, with `default_locale` for `text`, or empty if it has
/// none; `None` for other elements.
pub(crate) fn locale_of(name: &str, default_locale: Option<&str>) -> Option<String> {
    Some(match text_name(name)? {
        TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag)) => tag,
        TextName::OtherShape(locale, None) => locale,
        TextName::NoLocale => default_locale.unwrap_or_default().to_owned(),
    })
}

/// Returns the element with the text in a locale, whatever the spelling of its name.
pub(crate) fn text_in<'d, 's>(
    document: &'d Document<'s>,
    locale: &str,
    default_locale: Option<&str>,
) -> Option<&'d Element<'s>> {
    let is_own = |element: &&Element<'_>| locale_of(&element.name.text, default_locale).as_deref() == Some(locale);
    document.elements.iter().find(is_own)
}
