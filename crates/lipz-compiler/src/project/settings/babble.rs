//! `[babble]` and its profiles.

use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use crate::project::babble::BabbleProfile;
use lipz_bank::Fps;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest::nearest};
use lipz_file::digits::Digits;
use toml::de::DeValue;

/// The settings of a profile.
const SETTINGS: [&str; 5] = ["ooh", "aah", "ooh-power-transfer", "aah-power-transfer", "rate"];

/// The most bytes of a name that fit into a record of the bank.
const MAX_NAME_BYTES: usize = u16::MAX as usize;

impl SettingsReader<'_> {
    /// Reads an entry of `[babble]`: a setting of the project's own profile, or a named profile.
    pub(super) fn babble(&mut self, name: &str, value: &NamedValue<'_>) {
        let mut base = std::mem::take(&mut self.settings.options.babble.base);
        let is_setting = self.profile_setting(name, value, &mut base);
        self.settings.options.babble.base = base;
        if is_setting {
            return;
        }
        let DeValue::Table(entries) = value.node.get_ref() else {
            return self.unknown_babble_setting(name, value);
        };
        if name.is_empty() || name.len() > MAX_NAME_BYTES {
            let message = "a babble profile has a name that is empty or too long";
            let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
            return self.diagnostics.push(diagnostic.help("write a name of 1 to 65,535 bytes, as in [babble.robot]"));
        }
        let mut profile = BabbleProfile::default();
        for (key, node) in entries {
            let setting = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{setting}", value.name), key: key.span(), node };
            if !self.profile_setting(setting, &value, &mut profile) {
                self.unknown_babble_setting(setting, &value);
            }
        }
        self.settings.options.babble.named.insert(name.to_owned(), profile);
    }

    /// Reads a setting of a profile; `false` if no setting has this name.
    fn profile_setting(&mut self, name: &str, value: &NamedValue<'_>, profile: &mut BabbleProfile) -> bool {
        let digits = match name {
            "ooh" => &mut profile.ooh,
            "aah" => &mut profile.aah,
            "ooh-power-transfer" => &mut profile.ooh_power_transfer,
            "aah-power-transfer" => &mut profile.aah_power_transfer,
            "rate" => {
                profile.rate = self.rate(value);
                return true;
            }
            _ => return false,
        };
        *digits = self.digits(value);
        true
    }

    fn digits(&mut self, value: &NamedValue<'_>) -> Option<Digits> {
        let text = match value.node.get_ref() {
            DeValue::String(text) => text,
            DeValue::Integer(number) => {
                let help = format!("put the digits into quotes: \"{number}\"");
                return value.wrong_type("a string of digits", &help, &mut self.diagnostics);
            }
            _ => {
                return value.wrong_type(
                    "a string of digits",
                    "write digits in quotes: \"0123\"",
                    &mut self.diagnostics,
                );
            }
        };
        let why = match Digits::parse(text) {
            Ok(digits) => return Some(digits),
            Err(why) => why,
        };
        // In a plain string, the characters follow the quote without escapes.
        let is_plain = value.node.span().len() == text.len() + 2;
        let text_start = is_plain.then_some(value.span().start as usize + 1);
        self.diagnostics.push(why.diagnostic(&value.name, value.span(), text_start));
        None
    }

    fn rate(&mut self, value: &NamedValue<'_>) -> Option<Fps> {
        let rate = value.ratio(&mut self.diagnostics)?;
        if rate.is_none() {
            let message = format!("`{}` is outside 1 to 1000", escape::text(&value.name));
            let diagnostic = Diagnostic::at(Code::BabbleRate, value.span(), message);
            self.diagnostics.push(diagnostic.help("write digits per second; the viewer uses 24"));
        }
        rate
    }

    fn unknown_babble_setting(&mut self, name: &str, value: &NamedValue<'_>) {
        let message = format!("{} is not a setting of a babble profile", escape::quoted(name));
        let found = Diagnostic::at(Code::UnknownSetting, span(&value.key), message);
        self.diagnostics.push(match nearest(name, SETTINGS) {
            Some(known) => found.help(format!("did you mean `{known}`?")).suggest(span(&value.key), known),
            None => {
                let names = SETTINGS.join(", ");
                found.help(format!("use one of {names}; write a named profile as a table, [babble.NAME]"))
            }
        });
    }
}
