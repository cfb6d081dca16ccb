//! The phones of a clip, with times in milliseconds.

use super::blend::Blend;
use super::profile::ArticulationProfile;
use super::query_time::QueryTime;
use crate::file::entries;
use crate::{Bank, Clip};
use core::fmt;
use lipz_layout::{PHONES_ARE_CERTAIN, PHONES_ARE_WIDE, PHONES_OFFSET, PhoneClipRecord, Tag};
use lipz_types::Phone;

/// A phone of a clip, and when it is spoken.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub struct PhoneSpan {
    /// The number of the phone, as in [`Phone::from_number`]. A bank of a later version can have unknown ones.
    pub number: u8,
    /// The start in milliseconds, from that of the clip.
    pub start_ms: u32,
    /// The end in milliseconds: the start of the next phone, or the end of the clip.
    pub end_ms: u32,
}

impl PhoneSpan {
    /// Returns the phone; `None` if this version of lipz does not list its number.
    pub const fn phone(&self) -> Option<Phone> {
        Phone::from_number(self.number)
    }
}

/// The phones of a clip; empty for a clip without phones.
#[derive(Clone, Copy)]
pub struct Phones<'a> {
    bytes: &'a [u8],
    level_db: Option<i8>,
    is_wide: bool,
    are_certain: bool,
    clip_end_ms: u32,
}

/// The `level_db` of a clip without a level.
const NO_LEVEL: u8 = 0x80;
/// The most phones that matter at a time. More would be in reach only if they took 12 milliseconds each.
const MOST_NEAR: u32 = 24;
/// The part of a diphthong after which its second sound begins, in hundredths.
const GLIDE_PERCENT: i32 = 55;
/// The length from which a diphthong has two sounds, in microseconds.
const SHORTEST_GLIDE_US: i32 = 30_000;
/// The length of the last phone of a clip without frames, in milliseconds.
const LAST_MS: u32 = 100;

impl<'a> Phones<'a> {
    /// Returns the number of phones.
    pub const fn count(&self) -> u32 {
        let bytes = self.bytes.len();
        (if self.is_wide { bytes / 5 } else { bytes / 3 }) as u32
    }

    /// Whether the clip has no phones.
    pub const fn is_empty(&self) -> bool {
        self.count() == 0
    }

    /// Whether the phones come from the text of the recording, rather than from the audio alone.
    pub const fn are_certain(&self) -> bool {
        self.are_certain
    }

    /// Returns the level of the speech in decibels relative to full scale, if it was measured.
    pub const fn level_db(&self) -> Option<i8> {
        self.level_db
    }

    /// Returns the phone with this index.
    pub fn get(&self, index: u32) -> Option<PhoneSpan> {
        let (number, start_ms) = self.entry(index)?;
        let end_ms = match self.entry(index.wrapping_add(1)) {
            Some((_, next_ms)) => next_ms,
            None => self.clip_end_ms.max(start_ms),
        };
        Some(PhoneSpan { number, start_ms, end_ms })
    }

    /// Returns all phones, in the order of their times.
    pub fn iter(&self) -> impl Iterator<Item = PhoneSpan> + 'a {
        let phones = *self;
        (0..phones.count()).filter_map(move |index| phones.get(index))
    }

    /// Whether the bytes are whole phones, at least one, and their times ascend.
    pub(super) fn are_in_order(&self) -> bool {
        let mut end = 0;
        let ascend = (0..self.count()).all(|index| {
            let start = self.entry(index).map_or(0, |(_, start_ms)| u64::from(start_ms));
            let is_later = index == 0 || start >= end;
            end = start.wrapping_add(1);
            is_later
        });
        ascend && !self.is_empty() && self.bytes.len().checked_rem(self.entry_bytes()) == Some(0)
    }

    const fn entry_bytes(&self) -> usize {
        if self.is_wide { 5 } else { 3 }
    }

    /// Returns number and start of the phone with this index.
    fn entry(&self, index: u32) -> Option<(u8, u32)> {
        let start = (index as usize).checked_mul(self.entry_bytes())?;
        let (number, rest) = self.bytes.get(start..)?.split_first()?;
        let half = |at: usize| match rest.get(at..) {
            Some([low, high, ..]) => Some(u32::from(*low) | u32::from(*high) << 8),
            _ => None,
        };
        let high = if self.is_wide { half(2)? } else { 0 };
        Some((*number, half(0)? | high << 16))
    }

    /// Returns the number of phones that start at or before a time.
    fn started_by(&self, ms: u32) -> u32 {
        let (mut start, mut end) = (0, self.count());
        while start < end {
            let middle = start.wrapping_add(end.wrapping_sub(start) / 2);
            match self.entry(middle) {
                Some((_, start_ms)) if start_ms <= ms => start = middle.wrapping_add(1),
                _ => end = middle,
            }
        }
        start
    }

    /// Adds the sounds that matter at a time.
    pub(super) fn add_near(&self, now: QueryTime, profile: &ArticulationProfile<'_>, blend: &mut Blend) {
        let (first_ms, last_ms) = now.reach();
        // The phone before the first one that starts within reach may end within reach.
        let first = self.started_by(first_ms).saturating_sub(1);
        let mut next = self.entry(first);
        for index in 1..=MOST_NEAR {
            let (number, start_ms) = match next {
                Some((number, start_ms)) if start_ms <= last_ms => (number, start_ms),
                _ => break,
            };
            next = self.entry(first.wrapping_add(index));
            let end_ms = next.map_or(self.clip_end_ms, |(_, start_ms)| start_ms);
            if number != Phone::SILENCE.number() {
                add_sounds(&PhoneSpan { number, start_ms, end_ms }, now, profile, blend);
            }
        }
    }
}

/// Adds the sound of a phone, or both sounds of a diphthong.
fn add_sounds(span: &PhoneSpan, now: QueryTime, profile: &ArticulationProfile<'_>, blend: &mut Blend) {
    let targets = profile.targets(span.number);
    let (mut start_us, end_us) = (now.until(span.start_ms), now.until(span.end_ms));
    let length_us = end_us.wrapping_sub(start_us);
    let mut last = targets;
    if targets.second != span.number && length_us > SHORTEST_GLIDE_US {
        let glide_us = start_us.wrapping_add(length_us.wrapping_mul(GLIDE_PERCENT) / 100);
        blend.add(start_us, glide_us, targets);
        start_us = glide_us;
        last = profile.targets(targets.second);
    }
    blend.add(start_us, end_us, last);
}

/// Two tracks are equal if they have the same phones, level and certainty.
impl PartialEq for Phones<'_> {
    fn eq(&self, other: &Self) -> bool {
        (
            self.bytes,
            self.level_db,
            self.is_wide,
            self.are_certain,
            self.is_empty() || self.clip_end_ms == other.clip_end_ms,
        ) == (other.bytes, other.level_db, other.is_wide, other.are_certain, true)
    }
}
impl Eq for Phones<'_> {}

/// Prints the phones as in a Lipz file: `sil@0 DH@191`.
impl fmt::Display for Phones<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, span) in self.iter().enumerate() {
            let space = if index == 0 { "" } else { " " };
            let name = span.phone().map_or("?", Phone::name);
            write!(f, "{space}{name}@{}", span.start_ms)?;
        }
        Ok(())
    }
}

impl fmt::Debug for Phones<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Phones").field(&self.count()).finish()
    }
}

impl<'a> Clip<'a> {
    /// Returns the phones of the clip; empty if the clip has none.
    pub fn phones(&self) -> Phones<'a> {
        let clips = phone_clips(self.bank);
        let slot = self.slot();
        let place = clips.partition_point(|record| record.slot.get() < slot);
        let mut phones = match clips.get(place) {
            Some(record) if record.slot.get() == slot => PhoneTable::of(self.bank, clips).phones(place),
            _ => return Phones { bytes: &[], level_db: None, is_wide: false, are_certain: true, clip_end_ms: 0 },
        };
        let last_ms = || phones.entry(phones.count().wrapping_sub(1)).map_or(0, |(_, start_ms)| start_ms);
        phones.clip_end_ms = match self.stored_fps() {
            Some(fps) if self.frame_count() > 0 => {
                u32::try_from(fps.start_of_frame_us(self.frame_count()) / 1000).unwrap_or(u32::MAX)
            }
            _ => last_ms().saturating_add(LAST_MS),
        };
        phones
    }
}

/// Returns the clips of a bank that have phones.
fn phone_clips<'a>(bank: &Bank<'a>) -> &'a [PhoneClipRecord] {
    entries(bank.file.section(Tag::PHONE_CLIPS))
}

/// The sections of phones; empty in a bank without them.
#[derive(Clone, Copy)]
pub(super) struct PhoneTable<'a> {
    pub(super) clips: &'a [PhoneClipRecord],
    pub(super) bytes: &'a [u8],
}

impl<'a> PhoneTable<'a> {
    pub(super) fn new(bank: &Bank<'a>) -> PhoneTable<'a> {
        PhoneTable::of(bank, phone_clips(bank))
    }

    fn of(bank: &Bank<'a>, clips: &'a [PhoneClipRecord]) -> PhoneTable<'a> {
        PhoneTable { clips, bytes: bank.file.section(Tag::PHONES) }
    }

    /// Returns where the data of a clip starts in the section.
    pub(super) fn offset(&self, place: usize) -> usize {
        let end = self.bytes.len();
        self.clips.get(place).map_or(end, |record| (record.offset_and_flags.get() & PHONES_OFFSET) as usize)
    }

    /// Returns the phones of the clip at `place`, without the end of the last one; empty if damaged.
    pub(super) fn phones(&self, place: usize) -> Phones<'a> {
        let flags = self.clips.get(place).map_or(0, |record| record.offset_and_flags.get());
        let data = self.bytes.get(self.offset(place)..self.offset(place.wrapping_add(1))).unwrap_or(&[]);
        let (level, bytes) = data.split_first().unwrap_or((&NO_LEVEL, &[]));
        Phones {
            bytes,
            level_db: if *level == NO_LEVEL { None } else { Some(*level as i8) },
            is_wide: flags & PHONES_ARE_WIDE != 0,
            are_certain: flags & PHONES_ARE_CERTAIN != 0,
            clip_end_ms: 0,
        }
    }
}
