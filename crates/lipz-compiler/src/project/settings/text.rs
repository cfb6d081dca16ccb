//! `locales` of `[text]`: the limits of texts in some locales.

use super::PixelLimit;
use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use crate::project::TextLimits;
use lipz_diagnostics::suggest::nearest;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_file::locale::language_or_locale;
use toml::de::DeValue;

/// The settings that apply to some locales.
const LIMITS: [&str; 7] =
    ["line-columns", "line-pixels", "font", "font-pixels", "lines", "characters-per-second", "shortest-seconds"];

/// A setting `line-pixels`, which needs a font.
pub(super) struct LinePixels {
    /// The locale or language with the setting; `None` for the whole project.
    locale: Option<String>,
    name: String,
    span: Span,
}

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
            let limits = self.locale_limits(locale.as_deref(), &value);
            if let (Some(locale), Some((limits, pixels))) = (locale, limits) {
                // Without limits for it, the compiler does not measure the text.
                if limits != TextLimits::default() {
                    self.settings.options.locale_limits.insert(locale.clone(), limits);
                }
                self.settings.pixel_limits.locales.insert(locale.clone(), pixels);
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

    fn locale_limits(&mut self, locale: Option<&str>, value: &NamedValue<'_>) -> Option<(TextLimits, PixelLimit)> {
        let DeValue::Table(entries) = value.node.get_ref() else {
            self.refuse(value, "is not a table", "write the limits of the locale, as in { characters-per-second = 4 }");
            return None;
        };
        let (mut limits, mut pixels) = (TextLimits::default(), PixelLimit::default());
        for (key, node) in entries {
            let setting = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{setting}", value.name), key: key.span(), node };
            let found = &mut self.diagnostics;
            match setting {
                "line-columns" => limits.line_columns = value.count(found),
                "line-pixels" => pixels.line_pixels = self.line_pixels(locale, &value),
                "font" => pixels.font = self.named_file(&value),
                "font-pixels" => pixels.font_pixels = value.font_pixels(found),
                "lines" => limits.lines = value.count(found),
                "characters-per-second" => limits.characters_per_second = value.positive(found),
                "shortest-seconds" => limits.shortest_seconds = value.positive(found),
                _ => {
                    let message = format!("{} is not a setting of texts in a locale", escape::quoted(setting));
                    let diagnostic = Diagnostic::at(Code::UnknownSetting, span(&value.key), message);
                    found.push(match nearest(setting, LIMITS) {
                        Some(known) => {
                            diagnostic.help(format!("did you mean `{known}`?")).suggest(span(&value.key), known)
                        }
                        None => diagnostic
                            .help(format!("the settings are {}", LIMITS.map(|name| format!("`{name}`")).join(", "))),
                    });
                }
            }
        }
        Some((limits, pixels))
    }

    /// Reads the most pixels of a line. The font can be in a table that is read later.
    pub(super) fn line_pixels(&mut self, locale: Option<&str>, value: &NamedValue<'_>) -> Option<u32> {
        let pixels = value.count(&mut self.diagnostics)?;
        let locale = locale.map(str::to_owned);
        self.line_pixels.push(LinePixels { locale, name: value.name.clone(), span: value.span() });
        Some(pixels)
    }

    /// Reports limits in pixels for texts whose font or its size is not set.
    pub(super) fn check_line_pixels(&mut self) {
        for LinePixels { locale, name, span } in std::mem::take(&mut self.line_pixels) {
            let limits = &self.settings.pixel_limits;
            let limit = locale.map_or_else(|| limits.project.clone(), |locale| limits.of(&locale));
            let (missing, help) = match (limit.font, limit.font_pixels) {
                (Some(_), Some(_)) => continue,
                (Some(_), None) => ("`font-pixels`", "add the size of the font in pixels: font-pixels = 32"),
                (None, Some(_)) => ("`font`", "add the font of the game: font = \"game.ttf\""),
                (None, None) => {
                    ("`font`", "add the font of the game and its size in pixels: font = \"game.ttf\", font-pixels = 32")
                }
            };
            let message = format!("`{name}` is set, but {missing} is missing");
            let diagnostic = Diagnostic::at(Code::SettingValue, span, message);
            self.diagnostics.push(diagnostic.help(help));
        }
    }
}
