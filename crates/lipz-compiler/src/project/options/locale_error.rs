//! The error for a locale that the options of a project refuse.

use lipz_diagnostics::{Code, Report, escape};
use lipz_file::locale::canonical_tag;
use std::fmt;

/// The reason why a tag is not accepted as a locale of a project.
#[derive(Clone, PartialEq, Eq)]
pub struct LocaleError {
    tag: String,
    /// Whether the project accepts extended locales.
    is_extended: bool,
}

impl LocaleError {
    /// Returns the canonical form of a tag of the form `ll-cc`, or with `extended` of any BCP 47 language tag.
    pub(crate) fn check(tag: &str, extended: bool) -> Result<String, LocaleError> {
        canonical_tag(tag, extended).ok_or_else(|| LocaleError { tag: tag.to_owned(), is_extended: extended })
    }

    /// Returns the refused tag.
    pub fn tag(&self) -> &str {
        &self.tag
    }

    /// Converts the error to a diagnostic without a file.
    pub fn to_report(&self) -> Report {
        Report::failure("", Code::LocaleShape, self.message(), self.help())
    }

    fn message(&self) -> String {
        let form = if self.is_extended { "BCP 47 language tag" } else { "locale of the form ll-cc" };
        format!("{} is not a {form}", escape::quoted(&self.tag))
    }

    fn help(&self) -> &'static str {
        if self.is_extended {
            "name a language, with a script and a region where needed: en-us, es-419, zh-hant"
        } else if canonical_tag(&self.tag, true).is_some() {
            "name a language and a country: en-us; or call `extended_locales(true)` first to accept other tags"
        } else {
            "name a language and a country: en-us"
        }
    }
}

impl fmt::Display for LocaleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message(), self.help())
    }
}

/// The same text, because a `main` that returns the error prints it this way.
impl fmt::Debug for LocaleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for LocaleError {}

#[cfg(test)]
mod tests {
    use crate::project::Options;

    #[test]
    fn locales_are_checked_where_they_are_set() {
        let options = Options::new();
        let message = |refused: Result<Options, super::LocaleError>| refused.unwrap_err().to_string();
        assert_eq!(
            message(options.clone().default_locale("english")),
            "`english` is not a locale of the form ll-cc: name a language and a country: en-us"
        );
        assert!(message(options.clone().default_locale("es-419")).contains("`extended_locales(true)`"));
        assert!(message(options.clone().locales(["en-us", "de"])).starts_with("`de`"));
        assert!(message(options.clone().fallback("de", ["en-us"])).starts_with("`de`"));
        assert!(message(options.clone().fallback("de-de", ["en"])).starts_with("`en`"));
        let extended = options.clone().extended_locales(true);
        assert_eq!(
            message(extended.clone().default_locale("-")),
            "`-` is not a BCP 47 language tag: name a language, with a script and a region where needed: en-us, es-419, zh-hant"
        );
        let set = extended.default_locale("es-419").unwrap().fallback("zh_Hant", ["zh-TW"]).unwrap();
        assert_eq!(set.get_default_locale(), Some("es-419"));
        assert_eq!(set.get_fallbacks()["zh-hant"], ["zh-tw"], "in their canonical form");
        assert_eq!(options.default_locale("en_US").unwrap().get_default_locale(), Some("en-us"));
    }
}
