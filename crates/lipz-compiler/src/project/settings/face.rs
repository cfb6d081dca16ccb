//! `[face]` and its profiles.

use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use crate::project::GestureKeys;
use crate::project::face::{FaceNumbers, FaceSetting, SETTINGS, Unit, numbers};
use lipz_bank::face::FaceProfile;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest::nearest};
use toml::de::DeValue;

/// The most bytes of a name that fit into a record of the bank.
const MAX_NAME_BYTES: usize = u16::MAX as usize;

/// The sources of gestures, by name.
const KEYS: [(&str, GestureKeys); 3] =
    [("words", GestureKeys::Words), ("events", GestureKeys::Events), ("off", GestureKeys::Off)];

impl SettingsReader<'_> {
    /// Reads an entry of `[face]`: a setting of the compiler or of the project's own profile, or a named profile.
    pub(super) fn face(&mut self, name: &str, value: &NamedValue<'_>) {
        match name {
            "keys" => return self.gesture_keys(value),
            "nods" => {
                let strength = self.strength(value);
                let gestures = &mut self.settings.options.gestures;
                return gestures.nods_thousandths = strength.unwrap_or(gestures.nods_thousandths);
            }
            "breath" => {
                let strength = self.strength(value);
                let gestures = &mut self.settings.options.gestures;
                return gestures.breath_thousandths = strength.unwrap_or(gestures.breath_thousandths);
            }
            _ => {}
        }
        let mut base = self.settings.options.faces.base;
        let is_setting = self.face_setting(name, value, &mut base);
        self.settings.options.faces.base = base;
        if is_setting {
            return;
        }
        let DeValue::Table(entries) = value.node.get_ref() else {
            return self.unknown_face_setting(name, value);
        };
        if name.is_empty() || name.len() > MAX_NAME_BYTES {
            let message = "a face profile has a name that is empty or too long";
            let diagnostic = Diagnostic::at(Code::SettingValue, span(&value.key), message);
            return self.diagnostics.push(diagnostic.help("write a name of 1 to 65,535 bytes, as in [face.robot]"));
        }
        let mut profile = FaceNumbers::default();
        for (key, node) in entries {
            let setting = key.get_ref().as_ref();
            let value = NamedValue { name: format!("{}.{setting}", value.name), key: key.span(), node };
            if !self.face_setting(setting, &value, &mut profile) {
                self.unknown_face_setting(setting, &value);
            }
        }
        self.settings.options.faces.named.insert(name.to_owned(), profile);
    }

    /// Reads the sources of gestures.
    fn gesture_keys(&mut self, value: &NamedValue<'_>) {
        let Some(text) = value.text(&mut self.diagnostics) else { return };
        match KEYS.iter().find(|(known, _)| *known == text) {
            Some((_, keys)) => self.settings.options.gestures.keys = *keys,
            None => {
                let near = nearest(text, KEYS.map(|(known, _)| known));
                let otherwise = "write \"words\" for gestures that match the text, \"events\" or \"off\"";
                value.refuse_unknown::<()>("is not a value of `keys`", near, otherwise, &mut self.diagnostics);
            }
        }
    }

    /// Returns a strength from 0 to 10, in thousandths.
    fn strength(&mut self, value: &NamedValue<'_>) -> Option<i32> {
        Some((self.within(value, 10.0)? * 1000.0).round() as i32)
    }

    /// Reads a setting of a profile; `false` if no setting has this name.
    fn face_setting(&mut self, name: &str, value: &NamedValue<'_>, profile: &mut FaceNumbers) -> bool {
        let Some(place) = SETTINGS.iter().position(|setting| setting.name == name) else { return false };
        let Some(text) = value.decimal(&mut self.diagnostics) else { return true };
        let setting = SETTINGS[place];
        let per_unit = if setting.unit == Unit::Percent { 1.0 } else { 1000.0 };
        let number = text.parse::<f64>().ok().map(|number| (number * per_unit).round());
        // Values out of range stay out of range, because casts saturate, and NaN is in no range.
        let number = number.filter(|number| (0.0..=f64::from(u16::MAX)).contains(number)).map(|number| number as u16);
        match number.filter(|number| setting.allows(*number)) {
            Some(number) => profile[place] = Some(number),
            None => self.refuse(value, &out_of_range(&setting), &example(&setting)),
        }
        true
    }

    fn unknown_face_setting(&mut self, name: &str, value: &NamedValue<'_>) {
        let message = format!("{} is not a setting of a face profile", escape::quoted(name));
        let of_project = ["keys", "nods", "breath"];
        let found = Diagnostic::at(Code::UnknownSetting, span(&value.key), message);
        self.diagnostics.push(
            match nearest(name, SETTINGS.map(|setting| setting.name).into_iter().chain(of_project)) {
                Some(known) if known == name => found.help("write it in [face]; it applies to all characters"),
                Some(known) => found.help(format!("did you mean `{known}`?")).suggest(span(&value.key), known),
                None => found.help(
                    "use a setting from docs/guides/faces.md, such as blink or head; write a named profile as a table, \
                    [face.NAME]",
                ),
            },
        );
    }
}

fn out_of_range(setting: &FaceSetting) -> String {
    let unit = match setting.unit {
        Unit::Seconds => "seconds",
        Unit::Degrees => "degrees",
        Unit::Percent => "percent",
    };
    let (least, most) = (setting.shown(setting.least), setting.shown(setting.most));
    let none = if setting.may_be_none { ", nor 0 for never" } else { "" };
    format!("is not from {least} to {most} {unit}{none}")
}

fn example(setting: &FaceSetting) -> String {
    let mut defaults = std::iter::zip(&SETTINGS, numbers(&FaceProfile::DEFAULT));
    let usual = defaults.find(|(other, _)| other.name == setting.name).map(|(_, number)| setting.shown(number));
    let usual = usual.unwrap_or_default();
    format!("write a number, such as {} = {usual}", setting.name)
}
