//! Face profiles of a project, and their section in a bank.

use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotion, FaceProfile};
use lipz_layout::FaceRecord;
use std::array;
use std::collections::BTreeMap;
use zerocopy::IntoBytes;

/// The name of the profile for programs that do not name one.
pub const DEFAULT_PROFILE: &str = "default";

/// The number of blink intervals: one for a calm face, and one for each attribute of emotion.
const INTERVALS: usize = 1 + Emotion::ALL.len();

/// The number of settings in a profile.
pub const COUNT: usize = INTERVALS + 7;

/// The values of a profile in the units of the bank. Missing values are those of the profile that it is based on.
pub type FaceNumbers = [Option<u16>; COUNT];

/// The unit of a setting.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unit {
    /// Seconds; milliseconds in the bank.
    Seconds,
    /// Degrees; thousandths of a degree in the bank.
    Degrees,
    /// Percent.
    Percent,
}

/// A setting of a profile.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FaceSetting {
    /// Its name in `lipz.toml`.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// The lowest number, in the unit of the bank.
    pub least: u16,
    /// The highest number, in the unit of the bank.
    pub most: u16,
    /// Whether 0 is allowed in addition.
    pub may_be_none: bool,
}

impl FaceSetting {
    /// Returns a number from the bank as written in `lipz.toml`.
    pub fn shown(&self, number: u16) -> CurveValue {
        let in_thousandths = if self.unit == Unit::Percent { 1000 } else { 1 };
        CurveValue::from_thousandths(i32::from(number) * in_thousandths)
    }

    /// Whether the bank may contain this number.
    pub fn allows(&self, number: u16) -> bool {
        (self.least..=self.most).contains(&number) || self.may_be_none && number == 0
    }
}

const fn interval(name: &'static str) -> FaceSetting {
    FaceSetting { name, unit: Unit::Seconds, least: 1000, most: 60_000, may_be_none: true }
}

const fn other(name: &'static str, unit: Unit, least: u16, most: u16) -> FaceSetting {
    FaceSetting { name, unit, least, most, may_be_none: false }
}

/// All settings, in the order of their numbers. The reader refuses values outside of these ranges.
pub const SETTINGS: [FaceSetting; COUNT] = [
    interval("blink"),
    interval("blink-sadness"),
    interval("blink-anger"),
    interval("blink-joy"),
    interval("blink-fear"),
    interval("blink-disgust"),
    interval("blink-surprise"),
    interval("blink-shock"),
    interval("blink-perplexed"),
    interval("blink-asleep"),
    interval("blink-pain"),
    interval("blink-exertion"),
    interval("blink-shout"),
    other("blink-length", Unit::Seconds, 40, 400),
    other("double-blinks", Unit::Percent, 0, 100),
    other("glances", Unit::Percent, 0, 100),
    other("head", Unit::Degrees, 0, 30_000),
    other("head-follows", Unit::Degrees, 0, 60_000),
    other("pose", Unit::Seconds, 100, 60_000),
    other("fixation", Unit::Seconds, 200, 60_000),
];

/// Returns the numbers of a profile, in the order of [`SETTINGS`].
pub fn numbers(profile: &FaceProfile<'_>) -> [u16; COUNT] {
    array::from_fn(|place| match place.checked_sub(INTERVALS) {
        None => profile.blink_interval_ms(place.checked_sub(1).map(|place| Emotion::ALL[place])),
        Some(0) => profile.blink_length_ms(),
        Some(1) => profile.double_blink_percent().into(),
        Some(2) => profile.glance_percent().into(),
        Some(3) => profile.head_motion_thousandths(),
        Some(4) => profile.head_follows_thousandths(),
        Some(5) => profile.pose_ms(),
        Some(_) => profile.fixation_ms(),
    })
}

/// The face profiles of a project.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct FaceProfileSettings {
    /// The project's own profile, based on [`FaceProfile::DEFAULT`]. It becomes the profile `default` if it sets any
    /// value.
    pub base: FaceNumbers,
    /// Other profiles by name, based on `base`. Names are not empty, and at most 65,535 bytes long.
    pub named: BTreeMap<String, FaceNumbers>,
}

impl FaceProfileSettings {
    /// Returns the section of the bank; empty if there are no profiles.
    pub(crate) fn section(&self) -> Vec<u8> {
        let mut profiles: BTreeMap<&str, &FaceNumbers> = BTreeMap::new();
        if self.base != FaceNumbers::default() {
            profiles.insert(DEFAULT_PROFILE, &self.base);
        }
        profiles.extend(self.named.iter().map(|(name, profile)| (name.as_str(), profile)));
        let base = on_top_of(numbers(&FaceProfile::DEFAULT), &self.base);
        let mut bytes = Vec::new();
        for (name, own) in profiles {
            bytes.extend_from_slice(record(on_top_of(base, own), name).as_bytes());
            bytes.extend_from_slice(name.as_bytes());
        }
        bytes
    }
}

/// Returns the values of a profile that sets `own` and inherits the rest from another. Blink intervals of emotions
/// change in proportion to that of a calm face.
fn on_top_of(other: [u16; COUNT], own: &FaceNumbers) -> [u16; COUNT] {
    let calm = u32::from(own[0].unwrap_or(other[0]));
    array::from_fn(|place| match own[place] {
        Some(number) => number,
        None if place >= INTERVALS => other[place],
        // A face that does not blink has no proportion.
        None if other[0] == 0 => in_proportion(numbers(&FaceProfile::DEFAULT), place, calm),
        None => in_proportion(other, place, calm),
    })
}

/// Returns the blink interval at an index after that of a calm face changes to `calm`, rounded to the precision of the
/// bank.
fn in_proportion(intervals: [u16; COUNT], place: usize, calm: u32) -> u16 {
    let (old, old_calm) = (u32::from(intervals[place]), u32::from(intervals[0]));
    let setting = SETTINGS[place];
    match (2 * old * calm + old_calm) / (2 * old_calm) {
        0 => 0,
        number => number.clamp(setting.least.into(), setting.most.into()) as u16,
    }
}

fn record(numbers: [u16; COUNT], name: &str) -> FaceRecord {
    let [
        intervals @ ..,
        blink_length_ms,
        double_blink_percent,
        glance_percent,
        head_motion,
        head_follows,
        pose_ms,
        fixation_ms,
    ] = numbers;
    FaceRecord {
        blink_interval_ms: intervals.map(Into::into),
        blink_length_ms: blink_length_ms.into(),
        // The settings limit percentages to 100, and names to this length.
        double_blink_percent: u8::try_from(double_blink_percent).unwrap_or(u8::MAX),
        glance_percent: u8::try_from(glance_percent).unwrap_or(u8::MAX),
        head_motion: head_motion.into(),
        head_follows: head_follows.into(),
        pose_ms: pose_ms.into(),
        fixation_ms: fixation_ms.into(),
        name_length_bytes: u16::try_from(name.len()).unwrap_or(u16::MAX).into(),
    }
}
