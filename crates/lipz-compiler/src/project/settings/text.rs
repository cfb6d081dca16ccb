//! `locales` of `[text]`: the limits of texts in some locales.

use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use crate::project::TextLimits;
use lipz_diagnostics::suggest::nearest;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::locale::language_or_locale;
use toml::de::DeValue;

/// The settings that apply to some locales.
const LIMITS: [&str; 4] = ["line-columns", "lines", "characters-per-second", "shortest-seconds"];

impl SettingsReader<'_> {
    /// Reads the limits of locales and languages: a table for each.
    pub(super) fn text_locales(&mut self, value: &NamedValue<'_>) {
        let DeValue::Table(locales) = value.node.get_ref() else {
            return self.refuse(value, "is not a table", "write a table for each locale, as in [text.locales.ja-jp]");
        };
        for (key, node) in locales {
            let name = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{name}", value.name), key: key.span(), node };
            let locale = self.language_or_locale(name, &value);
            let limits = self.locale_limits(&value);
            if let (Some(locale), Some(limits)) = (locale, limits) {
                self.settings.options.locale_limits.insert(locale.clone(), limits);
                self.refuse_second("text.locales", locale, &value);
            }
        }
    }

    /// Reads the language or locale in a key.
    fn language_or_locale(&mut self, name: &str, value: &NamedValue<'_>) -> Option<String> {
        let found = language_or_locale(name, self.extended());
        if found.is_some() || name.contains(['-', '_']) {
            return found.or_else(|| self.locale_of_key(name, value));
        }
        let message = format!("{} is not a language or locale", escape::quoted(name));
        let help = "name a language, as in ja, or a language and a country, as in ja-jp";
        self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
        None
    }

    fn locale_limits(&mut self, value: &NamedValue<'_>) -> Option<TextLimits> {
        let DeValue::Table(entries) = value.node.get_ref() else {
            self.refuse(value, "is not a table", "write the limits of the locale, as in { characters-per-second = 4 }");
            return None;
        };
        let mut limits = TextLimits::default();
        for (key, node) in entries {
            let setting = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{setting}", value.name), key: key.span(), node };
            let found = &mut self.diagnostics;
            match setting {
                "line-columns" => limits.line_columns = value.count(found),
                "lines" => limits.lines = value.count(found),
                "characters-per-second" => limits.characters_per_second = value.positive(found),
                "shortest-seconds" => limits.shortest_seconds = value.positive(found),
                _ => {
                    let message = format!("{} is not a limit of texts", escape::quoted(setting));
                    let diagnostic = Diagnostic::at(Code::UnknownSetting, span(&value.key), message);
                    found.push(match nearest(setting, LIMITS) {
                        Some(known) => {
                            diagnostic.help(format!("did you mean `{known}`?")).suggest(span(&value.key), known)
                        }
                        None => diagnostic
                            .help(format!("the limits are {}", LIMITS.map(|name| format!("`{name}`")).join(", "))),
                    });
                }
            }
        }
        Some(limits)
    }
}
