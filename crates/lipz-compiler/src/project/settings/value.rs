//! Values of settings: their types and their ranges.

use lipz_bank::{Fps, VisemeType};
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest::nearest};
use lipz_file::{locale, rate};
use std::fmt::Display;
use std::ops::Range;
use std::str::FromStr;
use toml::Spanned;
use toml::de::DeValue;

/// The value of a setting.
pub(super) struct NamedValue<'t> {
    /// The name of the setting in messages: `text.lines`.
    pub(super) name: String,
    /// The range of the key in the file.
    pub(super) key: Range<usize>,
    pub(super) node: &'t Spanned<DeValue<'t>>,
}

impl<'t> NamedValue<'t> {
    pub(super) fn boolean(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<bool> {
        match self.node.get_ref() {
            DeValue::Boolean(value) => Some(*value),
            DeValue::String(text) if matches!(text.as_ref(), "true" | "false") => {
                self.wrong_type("true or false", &format!("remove the quotes: {text}"), diagnostics)
            }
            _ => self.wrong_type("true or false", "write true or false", diagnostics),
        }
    }

    pub(super) fn text(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<&'t str> {
        match self.node.get_ref() {
            DeValue::String(text) if text.is_empty() => {
                self.refuse("is empty", "write a value, or remove the line", diagnostics)
            }
            DeValue::String(text) => Some(text.as_ref()),
            DeValue::Array(_) => self.wrong_type("a string", "write one string without brackets: \"…\"", diagnostics),
            _ => self.wrong_type("a string", "put the value into double quotes", diagnostics),
        }
    }

    /// Returns the items of a list, each as a separate value. Items with diagnostics are left out.
    pub(super) fn list<T>(
        &self,
        diagnostics: &mut Vec<Diagnostic>,
        mut item: impl FnMut(&NamedValue<'t>, &mut Vec<Diagnostic>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let DeValue::Array(array) = self.node.get_ref() else {
            let help = match self.node.get_ref() {
                DeValue::String(text) => format!("write [\"{}\"]", escape::text(text)),
                _ => "write strings in brackets: [\"…\", \"…\"]".to_owned(),
            };
            return self.wrong_type("a list", &help, diagnostics);
        };
        let items = array.iter().map(|node| NamedValue { name: self.name.clone(), key: self.key.clone(), node });
        Some(items.filter_map(|value| item(&value, diagnostics)).collect())
    }

    /// Returns an integer of at least 1.
    pub(super) fn count(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<u32> {
        let DeValue::Integer(integer) = self.node.get_ref() else {
            return self.wrong_type("a whole number", "write a number without a fraction or quotes", diagnostics);
        };
        let number = i64::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i64::MAX);
        match u32::try_from(number) {
            Ok(count) if count > 0 => Some(count),
            _ if number < 1 => self.refuse("is less than 1", "remove the line for no limit", diagnostics),
            _ => self.refuse("is too large", "remove the line for no limit", diagnostics),
        }
    }

    /// Returns a number of milliseconds, which may be 0.
    pub(super) fn milliseconds(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<u32> {
        match self.node.get_ref() {
            DeValue::Integer(integer) if integer.as_str() == "0" => Some(0),
            _ => self.count(diagnostics),
        }
    }

    /// Returns a number above 0, which is a limit.
    pub(super) fn positive(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<f64> {
        self.above_zero("remove the line for no limit", diagnostics)
    }

    /// Returns the size of a font, in pixels.
    pub(super) fn font_pixels(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<f64> {
        self.above_zero("write the size of the font in pixels, such as 32", diagnostics)
    }

    fn above_zero(&self, help: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<f64> {
        let number = self.decimal(diagnostics)?;
        match f64::from_str(&number) {
            Ok(number) if number > 0.0 && number.is_finite() => Some(number),
            _ => self.refuse("is not a number above 0", help, diagnostics),
        }
    }

    /// Returns a number from 0 to 100.
    pub(super) fn percent(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<f64> {
        let number = self.decimal(diagnostics)?;
        match f64::from_str(&number) {
            Ok(number) if (0.0..=100.0).contains(&number) => Some(number),
            _ => self.refuse("is not a number from 0 to 100", "write a percentage, such as 90", diagnostics),
        }
    }

    /// Returns a frame rate, with a warning if it does not match the text exactly.
    pub(super) fn fps(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<Fps> {
        match self.ratio(diagnostics)? {
            Some(fps) => Some(fps),
            None => self.refuse("is outside 1 to 1000", "write frames per second, usually 24, 25 or 30", diagnostics),
        }
    }

    /// Returns a rate if the value is a number: `Some(None)` if it is outside 1 to 1000. Adds a warning if the rate
    /// does not match the text exactly.
    pub(super) fn ratio(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<Option<Fps>> {
        let number = self.decimal(diagnostics)?;
        let rate = rate::parse(number.trim_start_matches('+'));
        let Some((rate, fps)) = rate.and_then(|rate| Some((rate, Fps::new(rate.numerator, rate.denominator)?))) else {
            return Some(None);
        };
        if !rate.is_exact {
            let (numerator, denominator) = (rate.numerator, rate.denominator);
            let message = format!("`{}` is stored as {numerator}/{denominator}, the nearest exact ratio", self.name);
            diagnostics.push(Diagnostic::at(Code::FpsInexact, self.span(), message).help("write fewer digits"));
        }
        Some(Some(fps))
    }

    /// Returns the decimal digits of a number.
    pub(super) fn decimal(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
        match self.node.get_ref() {
            DeValue::Float(float) => Some(float.as_str().to_owned()),
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(number) => Some(number.to_string()),
                Err(_) => Some(integer.as_str().to_owned()),
            },
            DeValue::String(text) if text.parse::<f64>().is_ok() => {
                self.wrong_type("a number", &format!("remove the quotes: {text}"), diagnostics)
            }
            _ => self.wrong_type("a number", "write a number: 24, 29.97", diagnostics),
        }
    }

    pub(super) fn viseme_type(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<VisemeType> {
        let text = self.text(diagnostics)?;
        let found = text.parse::<VisemeType>().ok();
        if found.is_none() {
            let near = nearest(text, VisemeType::ALL.map(VisemeType::name));
            return self.refuse_unknown("is not a viseme type", near, "write blair, toonboom or rms", diagnostics);
        }
        found
    }

    /// Returns a locale in its canonical form; any BCP 47 tag if `extended`.
    pub(super) fn locale(&self, extended: bool, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
        let text = self.text(diagnostics)?;
        match canonical_locale(text, extended) {
            Ok(tag) => Some(tag),
            Err((what, help)) => self.refuse(what, help, diagnostics),
        }
    }

    /// Returns a word that Character Event Syntax can contain.
    pub(super) fn word(&self, diagnostics: &mut Vec<Diagnostic>) -> Option<String> {
        let text = self.text(diagnostics)?;
        if !is_word(text) {
            return self.refuse("is not one word", "write one word without spaces, `,` or `|`", diagnostics);
        }
        Some(text.to_owned())
    }

    /// Reports that the value has the wrong type. Returns `None`.
    pub(super) fn wrong_type<T>(&self, expected: &str, help: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<T> {
        let found = match self.node.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date or time",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        let message = format!("`{}` is {found}, not {expected}", self.name);
        diagnostics.push(
            Diagnostic::at(Code::SettingType, self.span(), message)
                .also(span(&self.key), format!("must be {expected}"))
                .help(help),
        );
        None
    }

    /// Reports that the setting cannot have this value. Returns `None`.
    pub(super) fn refuse<T>(&self, what: impl Display, help: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<T> {
        let shown = match self.node.get_ref() {
            DeValue::String(text) if text.is_empty() => format!("`{}`", self.name),
            DeValue::String(text) => escape::quoted(text),
            DeValue::Integer(integer) => escape::quoted(&integer.to_string()),
            DeValue::Float(float) => escape::quoted(float.as_str()),
            _ => format!("`{}`", self.name),
        };
        diagnostics.push(Diagnostic::at(Code::SettingValue, self.span(), format!("{shown} {what}")).help(help));
        None
    }

    /// Refuses an unknown word, with the known one that was probably meant, or else with other help.
    pub(super) fn refuse_unknown<T>(
        &self,
        what: &str,
        near: Option<&str>,
        otherwise: &str,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<T> {
        let Some(near) = near else { return self.refuse(what, otherwise, diagnostics) };
        let refused = self.refuse(what, &format!("did you mean \"{near}\"?"), diagnostics);
        let last = diagnostics.pop().map(|found| found.suggest(self.span(), format!("\"{near}\"")));
        diagnostics.extend(last);
        refused
    }

    pub(super) fn span(&self) -> Span {
        span(&self.node.span())
    }
}

/// Returns the canonical form of a locale, or as an error the problem and the help.
pub(super) fn canonical_locale(text: &str, extended: bool) -> Result<String, (&'static str, &'static str)> {
    match (locale::canonical_tag(text, extended), locale::canonical_tag(text, true)) {
        (Some(tag), _) => Ok(tag),
        (None, Some(_)) => Err((
            "is not a locale of the form ll-cc",
            "name a language and a country, as in en-us, or accept any BCP 47 tag: extended-locales = true",
        )),
        (None, None) => Err(("is not a locale", "name a language and a country, as in en-us")),
    }
}

/// Whether events can contain `text`: one word of Character Event Syntax, which ends at white space, at `,`, and at the
/// end of a segment.
pub fn is_word(text: &str) -> bool {
    !text.is_empty() && !text.contains([' ', '\t', '\r', '\n', ',', lipz_file::text::DELIMITER])
}

pub(super) fn span(range: &Range<usize>) -> Span {
    Span::new(range.start, range.end)
}
