//! Face profiles: the frequency of blinks, and the range of head and eyes.

use super::Emotion;
use crate::Bank;
use crate::file::profiles;
use core::fmt;
use lipz_layout::{FaceRecord, Tag};
use zerocopy::FromBytes;

/// The blink intervals of a profile: for a calm face, then for each attribute of emotion.
const INTERVALS: usize = 1 + Emotion::ALL.len();

/// The parameters of generated motion: `[face]` in `lipz.toml`, or [`FaceProfile::DEFAULT`].
///
/// ```
/// use lipz_bank::face::{Emotion, FaceProfile};
/// let profile = FaceProfile::DEFAULT; // or that of a bank: bank.default_face_profile(), bank.face_profile("robot")
/// assert_eq!(profile.blink_interval_ms(None), 4000);
/// assert_eq!(profile.blink_interval_ms(Some(Emotion::Anger)), 6000); // a glare
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct FaceProfile<'data> {
    name: &'data [u8],
    blink_interval_ms: [u16; INTERVALS],
    blink_length_ms: u16,
    double_blink_percent: u8,
    glance_percent: u8,
    head_motion: u16,
    head_follows: u16,
    pose_ms: u16,
    fixation_ms: u16,
    is_without_curves: bool,
}

impl FaceProfile<'static> {
    /// The default, which needs no bank (`docs/guides/faces.md` gives the reasons).
    pub const DEFAULT: FaceProfile<'static> = FaceProfile {
        name: b"default",
        // Sadness, anger, joy, fear, disgust, surprise, shock, perplexed, asleep, pain, exertion, shout.
        blink_interval_ms: [4000, 4000, 6000, 4000, 2000, 4000, 4000, 4000, 2000, 4000, 4000, 4000, 4000],
        blink_length_ms: 240,
        double_blink_percent: 10,
        glance_percent: 20,
        head_motion: 3000,
        head_follows: 20_000,
        pose_ms: 400,
        fixation_ms: 1000,
        is_without_curves: false,
    };
}

impl<'data> FaceProfile<'data> {
    /// Returns the profile at the start of `bytes`, and the bytes after it; `None` if they are cut off.
    pub(crate) fn split_first(bytes: &'data [u8]) -> Option<(FaceProfile<'data>, &'data [u8])> {
        let (record, rest) = FaceRecord::ref_from_prefix(bytes).ok()?;
        let length = usize::from(record.name_length_bytes.get());
        let mut profile = FaceProfile {
            name: rest.get(..length)?,
            blink_interval_ms: [0; INTERVALS],
            blink_length_ms: record.blink_length_ms.get(),
            double_blink_percent: record.double_blink_percent,
            glance_percent: record.glance_percent,
            head_motion: record.head_motion.get(),
            head_follows: record.head_follows.get(),
            pose_ms: record.pose_ms.get(),
            fixation_ms: record.fixation_ms.get(),
            is_without_curves: false,
        };
        for (place, interval) in profile.blink_interval_ms.iter_mut().zip(&record.blink_interval_ms) {
            *place = interval.get();
        }
        Some((profile, rest.get(length..)?))
    }

    /// Whether all numbers are in their ranges.
    pub(crate) fn is_valid(&self) -> bool {
        const LONGEST_MS: u16 = 60_000;
        let intervals = self.blink_interval_ms.iter().all(|ms| *ms == 0 || (1000..=LONGEST_MS).contains(ms));
        intervals
            && (40..=400).contains(&self.blink_length_ms)
            && self.double_blink_percent <= 100
            && self.glance_percent <= 100
            && self.head_motion <= 30_000
            && self.head_follows <= 60_000
            && (100..=LONGEST_MS).contains(&self.pose_ms)
            && (200..=LONGEST_MS).contains(&self.fixation_ms)
    }

    /// Returns the profile for faces without the curves of their clips. It generates what the curves would replace:
    /// `blink`, the motion of the head and the direction of the eyes, each complete and without additions. `lipz
    /// convert --write-curves=blink` samples it.
    #[must_use]
    pub const fn without_curves(mut self) -> FaceProfile<'data> {
        self.is_without_curves = true;
        self
    }

    pub(super) const fn is_without_curves(&self) -> bool {
        self.is_without_curves
    }

    /// Returns the name of the profile. Empty only in a damaged bank.
    pub fn name(&self) -> &'data str {
        core::str::from_utf8(self.name).unwrap_or("")
    }

    pub(crate) const fn name_bytes(&self) -> &'data [u8] {
        self.name
    }

    /// Returns the average interval between blinks in milliseconds, for this leading emotion or a calm face; 0 for no
    /// blinks.
    pub fn blink_interval_ms(&self, leads: Option<Emotion>) -> u16 {
        let place = leads.map_or(0, |emotion| (emotion as usize).wrapping_add(1));
        self.blink_interval_ms.get(place).copied().unwrap_or(0)
    }

    pub(super) const fn blink_intervals(&self) -> &[u16; INTERVALS] {
        &self.blink_interval_ms
    }

    /// Returns the milliseconds from the start of a blink until the lids are open again.
    pub const fn blink_length_ms(&self) -> u16 {
        self.blink_length_ms
    }

    /// Returns the percentage of blinks that are double.
    pub const fn double_blink_percent(&self) -> u8 {
        self.double_blink_percent
    }

    /// Returns the percentage of time in which the eyes glance at the other person's hands and body.
    pub const fn glance_percent(&self) -> u8 {
        self.glance_percent
    }

    /// Returns how far the head turns to each side while the mouth moves, in thousandths of a degree. It nods two
    /// thirds of that, and tilts half.
    pub const fn head_motion_thousandths(&self) -> u16 {
        self.head_motion
    }

    /// Returns how far the eyes turn before the head follows them, in thousandths of a degree.
    pub const fn head_follows_thousandths(&self) -> u16 {
        self.head_follows
    }

    /// Returns the average interval between poses of the head in milliseconds: one word.
    pub const fn pose_ms(&self) -> u16 {
        self.pose_ms
    }

    /// Returns the average length of a fixation of the eyes, in milliseconds.
    pub const fn fixation_ms(&self) -> u16 {
        self.fixation_ms
    }
}

impl fmt::Debug for FaceProfile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FaceProfile").field(&self.name()).finish()
    }
}

impl<'data> Bank<'data> {
    /// Returns the face profile with this name.
    pub fn face_profile(&self, name: &str) -> Option<FaceProfile<'data>> {
        self.face_profiles().find(|profile| profile.name == name.as_bytes())
    }

    /// Returns the project's profile, `[face]` in its settings, or [`FaceProfile::DEFAULT`].
    pub fn default_face_profile(&self) -> FaceProfile<'data> {
        self.face_profile("default").unwrap_or(FaceProfile::DEFAULT)
    }

    /// Returns all face profiles of the bank, ordered by name.
    pub fn face_profiles(&self) -> impl Iterator<Item = FaceProfile<'data>> + Clone {
        profiles(self.file.section(Tag::FACES), FaceProfile::split_first)
    }
}
