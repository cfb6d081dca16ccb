//! The JSON format of results, where it differs from their fields. New versions only add fields
//! (docs/reference/versions.md).
#![cfg_attr(
    not(all(feature = "diff", feature = "inspect", feature = "stats")),
    allow(dead_code, reason = "each feature uses a part of this")
)]

use crate::bank::Coverage;
use crate::project::face;
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Fps, Recording, VisemeType};
use lipz_layout::Tag;
use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Writes numerator and denominator.
pub(crate) fn fps<S: Serializer>(fps: &Option<Fps>, serializer: S) -> Result<S::Ok, S::Error> {
    ratio(*fps).serialize(serializer)
}

pub(crate) fn ratio(fps: Option<Fps>) -> Option<[u32; 2]> {
    fps.map(|fps| [fps.numerator(), fps.denominator()])
}

/// Writes the name of the type.
pub(crate) fn viseme_type<S: Serializer>(kind: &Option<VisemeType>, serializer: S) -> Result<S::Ok, S::Error> {
    kind.map(VisemeType::name).serialize(serializer)
}

/// Data of a bank about a recording. The hash is sixteen hexadecimal digits, because JSON in JavaScript has no 64-bit
/// integers.
#[derive(serde::Serialize)]
pub(crate) struct KnownRecording {
    length_us: u64,
    content_hash: String,
}

impl From<Recording> for KnownRecording {
    fn from(recording: Recording) -> Self {
        let content_hash = format!("{:016x}", recording.content_hash());
        KnownRecording { length_us: recording.length_us(), content_hash }
    }
}

pub(crate) fn recording<S: Serializer>(recording: &Option<Recording>, serializer: S) -> Result<S::Ok, S::Error> {
    recording.map(KnownRecording::from).serialize(serializer)
}

/// Writes a list of sections, each with its tag as text.
pub(crate) fn sections<S: Serializer>(sections: &[(Tag, usize)], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(serde::Serialize)]
    struct Section<'t> {
        tag: Cow<'t, str>,
        bytes: usize,
    }
    serializer.collect_seq(
        sections.iter().map(|(Tag(tag), bytes)| Section { tag: String::from_utf8_lossy(tag), bytes: *bytes }),
    )
}

/// A babble profile, with its digits as text.
#[derive(serde::Serialize)]
pub(crate) struct Profile<'d> {
    name: &'d str,
    ooh: Cow<'d, str>,
    aah: Cow<'d, str>,
    ooh_power_transfer: Cow<'d, str>,
    aah_power_transfer: Cow<'d, str>,
    rate: [u32; 2],
}

impl<'d> From<Babble<'d>> for Profile<'d> {
    fn from(babble: Babble<'d>) -> Self {
        let rate = babble.rate();
        Profile {
            name: babble.name(),
            ooh: String::from_utf8_lossy(babble.ooh()),
            aah: String::from_utf8_lossy(babble.aah()),
            ooh_power_transfer: String::from_utf8_lossy(babble.ooh_power_transfer()),
            aah_power_transfer: String::from_utf8_lossy(babble.aah_power_transfer()),
            rate: [rate.numerator(), rate.denominator()],
        }
    }
}

/// A face profile, with the names and units of `lipz.toml`.
#[derive(serde::Serialize)]
pub(crate) struct Face<'d> {
    name: &'d str,
    settings: BTreeMap<&'static str, f64>,
}

impl<'d> From<FaceProfile<'d>> for Face<'d> {
    fn from(profile: FaceProfile<'d>) -> Self {
        let settings = std::iter::zip(face::SETTINGS, face::numbers(&profile));
        let shown = |(setting, number): (face::FaceSetting, u16)| {
            (setting.name, f64::from(setting.shown(number).thousandths()) / 1000.0)
        };
        Face { name: profile.name(), settings: settings.map(shown).collect() }
    }
}

/// Adds the percentage, which is not a field.
impl Serialize for Coverage {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut json = serializer.serialize_struct("Coverage", 8)?;
        json.serialize_field("locale", &self.tag)?;
        json.serialize_field("is_default", &self.is_default)?;
        json.serialize_field("percent", &self.percent())?;
        json.serialize_field("clips", &self.clip_count)?;
        json.serialize_field("texts", &self.own_count)?;
        json.serialize_field("same_as_default", &self.same_as_default)?;
        json.serialize_field("fallbacks", &self.fallbacks)?;
        json.serialize_field("missing", &self.missing)?;
        json.end()
    }
}
