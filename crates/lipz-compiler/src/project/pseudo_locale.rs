//! The tags of pseudo-locales.

use lipz_file::locale::language;

/// The region of CLDR's accented pseudo-locales.
const REGION: &str = "-xa";

/// Returns the pseudo-locale for texts of `locale`: `en-xa` for `en-us`.
pub(crate) fn locale_for(locale: &str) -> String {
    format!("{}{REGION}", language(locale))
}

/// Whether a locale is a pseudo-locale.
pub(crate) fn is_pseudo(tag: &str) -> bool {
    tag.ends_with(REGION)
}
