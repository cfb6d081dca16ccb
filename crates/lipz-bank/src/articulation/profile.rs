//! Articulation profiles: the targets of all phones, and how a character moves the mouth.

use crate::Bank;
use crate::file::{entries, profiles};
use core::fmt;
use core::mem::size_of;
use lipz_layout::{ArticulationRecord, PhoneTargetRecord, Tag};
use zerocopy::{FromBytes, IntoBytes};

/// How a character articulates: `[articulation]` in `lipz.toml`, or [`ArticulationProfile::DEFAULT`].
#[derive(Clone, Copy)]
pub struct ArticulationProfile<'data> {
    name: &'data [u8],
    targets: &'data [PhoneTargetRecord],
    gain_percent: u16,
    jaw_percent: u16,
    lead_ms: i16,
    level_db: i16,
}

/// The mouth at rest: the lips lie on each other without pressure.
pub(super) const REST: PhoneTargetRecord =
    PhoneTargetRecord { percent: [5, 12, 10, 0, 0, 0, 0], strength_tenths: [0; 3], class: 0, second: 0 };

/// The change of the opening with the level of a line, in thousandths per decibel: 0.4 to 0.65 mm of about 15 mm.
const GAIN_PER_DB: i32 = 35;
/// The range of the gain of a line, in thousandths.
const LINE_GAIN: core::ops::RangeInclusive<i32> = 700..=1300;
/// The highest percentages of a profile.
const MOST_PERCENT: u16 = 300;
/// The most milliseconds by which a profile moves the mouth.
const MOST_LEAD_MS: i16 = 200;

impl ArticulationProfile<'static> {
    /// The default, which needs no bank. It has no targets for phones, because these are in the bank together with the
    /// phones.
    pub const DEFAULT: ArticulationProfile<'static> = ArticulationProfile {
        name: b"default",
        targets: &[],
        gain_percent: 100,
        jaw_percent: 100,
        lead_ms: 10,
        level_db: -20,
    };
}

impl<'data> ArticulationProfile<'data> {
    /// Returns the profile at the start of `bytes`, and the bytes after it; `None` if they are cut off.
    pub(crate) fn split_first(bytes: &'data [u8]) -> Option<(ArticulationProfile<'data>, &'data [u8])> {
        let (record, rest) = ArticulationRecord::ref_from_prefix(bytes).ok()?;
        let name_length = usize::from(record.name_length_bytes.get());
        let name = rest.get(..name_length)?;
        let rest = rest.get(name_length..)?;
        let length = usize::from(record.target_count.get()).checked_mul(size_of::<PhoneTargetRecord>())?;
        let profile = ArticulationProfile {
            name,
            targets: entries(rest.get(..length)?),
            gain_percent: record.gain_percent.get(),
            jaw_percent: record.jaw_percent.get(),
            lead_ms: record.lead_ms.get(),
            level_db: record.level_db.get(),
        };
        Some((profile, rest.get(length..)?))
    }

    /// Whether all numbers are in their ranges.
    pub(super) fn is_valid(&self) -> bool {
        let percents = |record: &PhoneTargetRecord| record.percent.iter().all(|percent| *percent <= 100);
        self.gain_percent <= MOST_PERCENT
            && self.jaw_percent <= MOST_PERCENT
            && (-MOST_LEAD_MS..=MOST_LEAD_MS).contains(&self.lead_ms)
            && (-127..=0).contains(&self.level_db)
            && !self.targets.is_empty()
            && self.targets.iter().all(percents)
    }

    /// Returns the name of the profile. Empty only in a damaged bank.
    pub fn name(&self) -> &'data str {
        core::str::from_utf8(self.name).unwrap_or("")
    }

    pub(super) const fn name_bytes(&self) -> &'data [u8] {
        self.name
    }

    /// Returns how wide the mouth opens, in percent of the default.
    pub const fn gain_percent(&self) -> u16 {
        self.gain_percent
    }

    /// Returns how far the jaw moves, in percent of the default.
    pub const fn jaw_percent(&self) -> u16 {
        self.jaw_percent
    }

    /// Returns the milliseconds by which the mouth is ahead of the audio.
    pub const fn lead_ms(&self) -> i16 {
        self.lead_ms
    }

    /// Returns the level of speech at which the gain is 100 percent, in decibels relative to full scale.
    pub const fn level_db(&self) -> i16 {
        self.level_db
    }

    /// Returns the targets of a phone; those of rest for a phone that the profile does not list.
    pub(super) fn targets(&self, number: u8) -> &'data PhoneTargetRecord {
        self.targets.get(usize::from(number)).unwrap_or(&REST)
    }

    /// Returns the targets of the mouth at rest.
    pub(super) fn rest(&self) -> &'data PhoneTargetRecord {
        self.targets(0)
    }

    /// Returns the gain of a line with this level, in thousandths.
    pub(super) fn gain_at(&self, level_db: Option<i8>) -> u32 {
        let louder_db = level_db.map_or(0, |level| i32::from(level).wrapping_sub(i32::from(self.level_db)));
        let line = louder_db.wrapping_mul(GAIN_PER_DB).wrapping_add(1000);
        let line = line.clamp(*LINE_GAIN.start(), *LINE_GAIN.end()) as u32;
        line.wrapping_mul(u32::from(self.gain_percent)) / 100
    }

    /// Returns the value of the jaw for this profile, from that of the targets.
    pub(super) fn jaw(&self, value: u32) -> u32 {
        value.wrapping_mul(u32::from(self.jaw_percent)) / 100
    }
}

/// Two profiles are equal if they have the same name, numbers and targets.
impl PartialEq for ArticulationProfile<'_> {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |profile: &Self| (profile.gain_percent, profile.jaw_percent, profile.lead_ms, profile.level_db);
        self.name == other.name
            && numbers(self) == numbers(other)
            && self.targets.as_bytes() == other.targets.as_bytes()
    }
}
impl Eq for ArticulationProfile<'_> {}

impl fmt::Debug for ArticulationProfile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("ArticulationProfile").field(&self.name()).finish()
    }
}

impl<'data> Bank<'data> {
    /// Returns the articulation profile with this name.
    pub fn articulation(&self, name: &str) -> Option<ArticulationProfile<'data>> {
        self.articulations().find(|profile| profile.name == name.as_bytes())
    }

    /// Returns the project's profile, `[articulation]` in its settings, or [`ArticulationProfile::DEFAULT`].
    pub fn default_articulation(&self) -> ArticulationProfile<'data> {
        self.articulation("default").unwrap_or(ArticulationProfile::DEFAULT)
    }

    /// Returns all articulation profiles of the bank, ordered by name.
    pub fn articulations(&self) -> impl Iterator<Item = ArticulationProfile<'data>> + Clone {
        profiles(self.file.section(Tag::ARTICULATION), ArticulationProfile::split_first)
    }
}
