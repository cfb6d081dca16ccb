//! `[articulation]` and its profiles.

use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use crate::project::articulation::{ProfileSettings, SETTINGS, TARGET_NAMES, TargetNumbers, numbers};
use lipz_bank::articulation::ArticulationProfile;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest::nearest};
use lipz_types::Phone;
use toml::de::DeValue;

/// The most bytes of a name that fit into a record of the bank.
const MAX_NAME_BYTES: usize = u16::MAX as usize;

/// The table of a profile with the targets of phones.
const PHONES: &str = "phones";

/// Parses targets, or returns the first word that is wrong.
fn targets(text: &str) -> Result<TargetNumbers, String> {
    let mut targets = TargetNumbers::default();
    for part in text.split(',').map(str::trim) {
        let (name, percent) = part.split_once(char::is_whitespace).ok_or(part)?;
        let place = TARGET_NAMES.iter().position(|known| *known == name).ok_or(name)?;
        let percent = percent.trim();
        targets[place] = Some(percent.parse().ok().filter(|number| *number <= 100).ok_or(percent)?);
    }
    Ok(targets)
}

impl SettingsReader<'_> {
    /// Reads an entry of `[articulation]`: a setting of the project's own profile, or a named profile.
    pub(super) fn articulation(&mut self, name: &str, value: &NamedValue<'_>) {
        let mut base = std::mem::take(&mut self.settings.options.articulation.base);
        let is_setting = self.articulation_setting(name, value, &mut base);
        self.settings.options.articulation.base = base;
        if is_setting {
            return;
        }
        let DeValue::Table(entries) = value.node.get_ref() else {
            return self.unknown_articulation_setting(name, value);
        };
        if name.is_empty() || name.len() > MAX_NAME_BYTES {
            let message = "an articulation profile has a name that is empty or too long";
            let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
            return self
                .diagnostics
                .push(diagnostic.help("write a name of 1 to 65,535 bytes, as in [articulation.otto]"));
        }
        let mut profile = ProfileSettings::default();
        for (key, node) in entries {
            let setting = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{setting}", value.name), key: key.span(), node };
            if !self.articulation_setting(setting, &value, &mut profile) {
                self.unknown_articulation_setting(setting, &value);
            }
        }
        self.settings.options.articulation.named.insert(name.to_owned(), profile);
    }

    /// Reads a setting of a profile; `false` if no setting has this name.
    fn articulation_setting(&mut self, name: &str, value: &NamedValue<'_>, profile: &mut ProfileSettings) -> bool {
        if name == PHONES {
            self.phone_targets(value, profile);
            return true;
        }
        let Some(place) = SETTINGS.iter().position(|setting| setting.name == name) else { return false };
        let Some(text) = value.decimal(&mut self.diagnostics) else { return true };
        let setting = SETTINGS[place];
        // Values out of range stay out of range, because casts saturate, and NaN is in no range.
        let range = f64::from(setting.least)..=f64::from(setting.most);
        let number = text.parse::<f64>().ok().map(f64::round).filter(|number| range.contains(number));
        match number {
            Some(number) => profile.numbers[place] = Some(number as i16),
            None => {
                let what = format!("is not from {} to {} {}", setting.least, setting.most, setting.unit);
                let usual = numbers(&ArticulationProfile::DEFAULT)[place];
                self.refuse(value, &what, &format!("write a number, such as {} = {usual}", setting.name));
            }
        }
        true
    }

    /// Reads the targets of phones: `AA = "jaw 70, opening 60"`.
    fn phone_targets(&mut self, value: &NamedValue<'_>, profile: &mut ProfileSettings) {
        let DeValue::Table(entries) = value.node.get_ref() else {
            return self.refuse(
                value,
                "is not a table",
                "write the targets of each phone: AA = \"jaw 70, opening 60\"",
            );
        };
        for (key, node) in entries {
            let name = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{name}", value.name), key: key.span(), node };
            let Ok(phone) = name.parse::<Phone>() else {
                let message = format!("{} is not a known phone", escape::quoted(name));
                let help = match nearest(name, Phone::all().map(Phone::name)) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "write ARPAbet in capitals without stress, IPA, or `sil` for rest".to_owned(),
                };
                self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
                continue;
            };
            let Some(text) = value.text(&mut self.diagnostics) else { continue };
            match targets(text) {
                Ok(targets) => _ = profile.targets.insert(phone.number(), targets),
                Err(word) => {
                    let what = format!("has {} in its targets", escape::quoted(&word));
                    let help =
                        format!("write percentages from 0 to 100 of {}: jaw 70, opening 60", TARGET_NAMES.join(", "));
                    self.refuse(&value, &what, &help);
                }
            }
        }
    }

    fn unknown_articulation_setting(&mut self, name: &str, value: &NamedValue<'_>) {
        let message = format!("{} is not a setting of an articulation profile", escape::quoted(name));
        let help = match nearest(name, SETTINGS.map(|setting| setting.name)) {
            Some(known) => format!("did you mean `{known}`?"),
            None => {
                let known = SETTINGS.map(|setting| setting.name).join(", ");
                format!("use {known}; write a named profile as a table, [articulation.NAME]")
            }
        };
        self.diagnostics.push(Diagnostic::at(Code::UnknownSetting, span(&value.key), message).help(help));
    }
}
