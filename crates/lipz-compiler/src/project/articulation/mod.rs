//! Articulation profiles of a project, and their section in a bank.

mod targets;

use lipz_bank::articulation::ArticulationProfile;
use lipz_layout::{ArticulationRecord, PhoneTargetRecord};
use lipz_types::Phone;
use std::array;
use std::collections::BTreeMap;
use zerocopy::IntoBytes;

/// The name of the profile for programs that do not name one.
const DEFAULT_PROFILE: &str = "default";

/// The number of settings in a profile.
pub const COUNT: usize = 4;

/// The values of a profile in the units of the bank. Missing values are those of the profile that it is based on.
pub type ArticulationNumbers = [Option<i16>; COUNT];

/// A setting of a profile.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ArticulationSetting {
    /// Its name in `lipz.toml`.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The lowest number.
    pub least: i16,
    /// The highest number.
    pub most: i16,
}

const fn setting(name: &'static str, unit: &'static str, least: i16, most: i16) -> ArticulationSetting {
    ArticulationSetting { name, unit, least, most }
}

/// All settings, in the order of their numbers. The reader refuses values outside of these ranges.
pub const SETTINGS: [ArticulationSetting; COUNT] = [
    setting("gain", "percent", 0, 300),
    setting("jaw", "percent", 0, 300),
    setting("lead", "milliseconds", -200, 200),
    setting("level", "decibels", -127, 0),
];

/// The targets of a phone in percent, in the order of the bank's record.
pub const TARGET_NAMES: [&str; 7] =
    ["jaw", "opening", "rounding", "spreading", "tongue_tip", "tongue_out", "tongue_back"];

/// Returns the built-in targets of a phone in percent, in the order of [`TARGET_NAMES`].
pub fn phone_targets(phone: Phone) -> [u8; TARGET_NAMES.len()] {
    targets::TARGETS.get(usize::from(phone.number())).map(|row| row.1).unwrap_or_default()
}

/// Returns the numbers of a profile, in the order of [`SETTINGS`].
pub fn numbers(profile: &ArticulationProfile<'_>) -> [i16; COUNT] {
    // The reader accepts percentages up to 300.
    let percent = |percent: u16| i16::try_from(percent).unwrap_or(i16::MAX);
    [percent(profile.gain_percent()), percent(profile.jaw_percent()), profile.lead_ms(), profile.level_db()]
}

/// The percentages of a phone's targets that a profile changes, in the order of [`TARGET_NAMES`].
pub type TargetNumbers = [Option<u8>; TARGET_NAMES.len()];

/// The settings of a profile. Missing ones are those of the profile that it is based on.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ProfileSettings {
    /// Its numbers, in the order of [`SETTINGS`].
    pub numbers: ArticulationNumbers,
    /// Its own targets of phones, by the number of the phone.
    pub targets: BTreeMap<u8, TargetNumbers>,
}

/// The articulation profiles of a project.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ArticulationSettings {
    /// The project's own profile, based on [`ArticulationProfile::DEFAULT`].
    pub base: ProfileSettings,
    /// Other profiles by name, based on `base`. Names are not empty, and at most 65,535 bytes long.
    pub named: BTreeMap<String, ProfileSettings>,
}

impl ArticulationSettings {
    /// Returns the section of the bank. It always has the profile `default`, which has the targets of all phones.
    pub(crate) fn section(&self) -> Vec<u8> {
        let base = on_top_of(numbers(&ArticulationProfile::DEFAULT), &self.base.numbers);
        let base_targets =
            with_targets(targets::TARGETS.into_iter().map(targets::record).collect(), &self.base.targets);
        let mut profiles = BTreeMap::from([(DEFAULT_PROFILE, (base, base_targets.clone()))]);
        for (name, own) in &self.named {
            let targets = with_targets(base_targets.clone(), &own.targets);
            profiles.insert(name.as_str(), (on_top_of(base, &own.numbers), targets));
        }
        let mut bytes = Vec::new();
        for (name, (numbers, targets)) in profiles {
            bytes.extend_from_slice(record(numbers, name, targets.len()).as_bytes());
            bytes.extend_from_slice(name.as_bytes());
            bytes.extend_from_slice(targets.as_bytes());
        }
        bytes
    }
}

/// Returns the values of a profile that sets `own` and inherits the rest from another.
fn on_top_of(other: [i16; COUNT], own: &ArticulationNumbers) -> [i16; COUNT] {
    array::from_fn(|place| own[place].unwrap_or(other[place]))
}

/// Returns the targets of a profile that changes some of them.
fn with_targets(mut targets: Vec<PhoneTargetRecord>, own: &BTreeMap<u8, TargetNumbers>) -> Vec<PhoneTargetRecord> {
    for (number, changed) in own {
        let Some(target) = targets.get_mut(usize::from(*number)) else { continue };
        for (percent, changed) in target.percent.iter_mut().zip(changed) {
            *percent = changed.unwrap_or(*percent);
        }
    }
    targets
}

fn record([gain, jaw, lead_ms, level_db]: [i16; COUNT], name: &str, target_count: usize) -> ArticulationRecord {
    // The settings limit percentages to 300, and names to this length.
    let percent = |percent: i16| u16::try_from(percent).unwrap_or(0);
    ArticulationRecord {
        name_length_bytes: u16::try_from(name.len()).unwrap_or(u16::MAX).into(),
        target_count: u16::try_from(target_count).unwrap_or(u16::MAX).into(),
        gain_percent: percent(gain).into(),
        jaw_percent: percent(jaw).into(),
        lead_ms: lead_ms.into(),
        level_db: level_db.into(),
        reserved: [0; 4],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_phone_has_the_row_with_its_name() {
        for (phone, (name, percent, _, _, second)) in Phone::all().zip(targets::TARGETS) {
            assert_eq!(phone.name(), name);
            assert!(percent.iter().all(|percent| *percent <= 100) && Phone::from_number(second).is_some(), "{name}");
        }
    }
}
