//! Babble profiles of a project, and their section in a bank.

use lipz_bank::Fps;
use lipz_bank::babble::Babble;
use lipz_file::digits::Digits;
use lipz_layout::BabbleRecord;
use std::collections::BTreeMap;
use zerocopy::IntoBytes;

/// The name of the profile for programs that do not name one.
pub const DEFAULT_PROFILE: &str = "default";

/// The values of a profile. Missing values are those of the profile that it is based on.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct BabbleProfile {
    /// The loop for the lips.
    pub ooh: Option<Digits>,
    /// The loop for the jaw.
    pub aah: Option<Digits>,
    /// The effect of power on the lips.
    pub ooh_power_transfer: Option<Digits>,
    /// The effect of power on the jaw.
    pub aah_power_transfer: Option<Digits>,
    /// Digits per second.
    pub rate: Option<Fps>,
}

/// The babble profiles of a project.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct BabbleProfiles {
    /// The project's own profile, based on [`Babble::DEFAULT`]. It becomes the profile `default` if it sets any value.
    pub base: BabbleProfile,
    /// Other profiles by name, based on `base`. Names are not empty, and at most 65,535 bytes long.
    pub named: BTreeMap<String, BabbleProfile>,
}

impl BabbleProfiles {
    /// Returns the section of the bank; empty if there are no profiles.
    pub(crate) fn section(&self) -> Vec<u8> {
        let mut profiles: BTreeMap<&str, &BabbleProfile> = BTreeMap::new();
        if self.base != BabbleProfile::default() {
            profiles.insert(DEFAULT_PROFILE, &self.base);
        }
        profiles.extend(self.named.iter().map(|(name, profile)| (name.as_str(), profile)));
        let mut bytes = Vec::new();
        for (name, profile) in profiles {
            self.push(&mut bytes, name, profile);
        }
        bytes
    }

    fn push(&self, bytes: &mut Vec<u8>, name: &str, profile: &BabbleProfile) {
        let base = &self.base;
        let built_in = Babble::DEFAULT;
        let digits = |own: &'_ Option<Digits>, base: &'_ Option<Digits>, built_in: &[u8]| -> Vec<u8> {
            own.as_ref().or(base.as_ref()).map_or(built_in.to_vec(), |digits| digits.as_str().into())
        };
        let ooh = digits(&profile.ooh, &base.ooh, built_in.ooh());
        let aah = digits(&profile.aah, &base.aah, built_in.aah());
        let of_power = built_in.ooh_power_transfer();
        let ooh_power_transfer = digits(&profile.ooh_power_transfer, &base.ooh_power_transfer, of_power);
        let of_power = built_in.aah_power_transfer();
        let aah_power_transfer = digits(&profile.aah_power_transfer, &base.aah_power_transfer, of_power);
        let rate = profile.rate.or(base.rate).unwrap_or(built_in.rate());
        // `Digits` and the settings limit names and digits to this length.
        let length = |bytes: &[u8]| u16::try_from(bytes.len()).unwrap_or(u16::MAX).into();
        let record = BabbleRecord {
            frames_per_micro_q64: rate.frames_per_micro_q64().into(),
            rate_numerator: rate.numerator().into(),
            rate_denominator: rate.denominator().into(),
            name_length_bytes: length(name.as_bytes()),
            ooh_length_bytes: length(&ooh),
            aah_length_bytes: length(&aah),
            ooh_power_transfer_length_bytes: length(&ooh_power_transfer),
            aah_power_transfer_length_bytes: length(&aah_power_transfer),
            reserved: [0; 6],
        };
        bytes.extend_from_slice(record.as_bytes());
        for string in [name.as_bytes(), &ooh, &aah, &ooh_power_transfer, &aah_power_transfer] {
            bytes.extend_from_slice(string);
        }
    }
}
