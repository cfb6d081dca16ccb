//! The sections that every bank has, and their records.

use super::{Tag, U16, U32, U64};
use crate::records::records;
use core::mem::size_of;
use lipz_types::StoredFps;

impl Tag {
    /// [`ClipRecord`]s in slot order.
    pub const CLIPS: Tag = Tag(*b"CLIP");
    /// [`KeyRecord`]s in slot order.
    pub const KEYS: Tag = Tag(*b"KEYS");
    /// [`RateRecord`]s: the distinct non-integer frame rates.
    pub const RATES: Tag = Tag(*b"RATE");
    /// Pilots of the clip index, one `u32` per bucket.
    pub const PILOTS: Tag = Tag(*b"PILT");
    /// Slots of the clips, ordered by key (bytewise), one `u32` each.
    pub const KEY_ORDER: Tag = Tag(*b"ORDR");
    /// Pool of keys and locale tags, UTF-8.
    pub const NAMES: Tag = Tag(*b"NAME");
    /// Frame codes, one byte each.
    pub const FRAMES: Tag = Tag(*b"FRAM");
    /// Segment starts: for each segment of all clips the offset of its first frame in `FRAM`, one `u32` each, followed
    /// by the length of `FRAM`.
    pub const STARTS: Tag = Tag(*b"STRT");
    /// [`LocaleRecord`]s, ordered by tag.
    pub const LOCALES: Tag = Tag(*b"LOCL");
    /// Text starts: for each locale in turn, the offset of each segment's text in `TEXT`, one `u32` each, followed by
    /// the length of `TEXT`.
    pub const TEXT_STARTS: Tag = Tag(*b"TXST");
    /// Text pool, UTF-8: display texts, grouped by locale.
    pub const TEXTS: Tag = Tag(*b"TEXT");
    /// For each segment of the clips with events, which come first, the number of an event record, one
    /// `u32` each.
    pub const EVENT_REFS: Tag = Tag(*b"EVRF");
    /// [`EventRecord`]s: the distinct event strings.
    pub const EVENTS: Tag = Tag(*b"EVNT");
    /// [`TypedEventRecord`]s: the events of each event string in turn.
    pub const TYPED_EVENTS: Tag = Tag(*b"EVTY");
    /// [`EventNameRecord`]s, ordered by name (bytewise).
    pub const EVENT_NAMES: Tag = Tag(*b"EVNM");
    /// Pool of event strings and the names in them, UTF-8.
    pub const EVENT_STRINGS: Tag = Tag(*b"EVST");

    /// The sections of every bank, in file order, each with the length of an entry.
    pub const REQUIRED: [(Tag, usize); 16] = [
        (Tag::CLIPS, size_of::<ClipRecord>()),
        (Tag::KEYS, size_of::<KeyRecord>()),
        (Tag::RATES, size_of::<RateRecord>()),
        (Tag::PILOTS, 4),
        (Tag::KEY_ORDER, 4),
        (Tag::NAMES, 1),
        (Tag::FRAMES, 1),
        (Tag::STARTS, 4),
        (Tag::LOCALES, size_of::<LocaleRecord>()),
        (Tag::TEXT_STARTS, 4),
        (Tag::TEXTS, 1),
        (Tag::EVENT_REFS, 4),
        (Tag::EVENTS, size_of::<EventRecord>()),
        (Tag::TYPED_EVENTS, size_of::<TypedEventRecord>()),
        (Tag::EVENT_NAMES, size_of::<EventNameRecord>()),
        (Tag::EVENT_STRINGS, 1),
    ];
}

// Every length of an entry is a power of two, so that no division is needed to check whether entries fill a section.
#[allow(clippy::indexing_slicing)]
const _: () = {
    let mut place = 0;
    while place < Tag::REQUIRED.len() {
        assert!(Tag::REQUIRED[place].1.is_power_of_two());
        place += 1;
    }
};

/// Clip flag: the file has a `visemes` element (possibly empty).
pub const FLAG_VISEMES: u8 = 1;
/// The `rate` of a clip whose frame rate is unspecified.
pub const NO_RATE: u16 = u16::MAX;
/// The highest `rate` that is itself the frame rate. Higher values are indices in the `RATE` section, starting from
/// this value plus one.
pub const MAX_INTEGER_FPS: u16 = 1000;
/// Locale flag: the project's default locale.
pub const LOCALE_DEFAULT: u16 = 1;
/// In a typed event, the `character` that stands for the speaker, and the `object` of an event without one.
pub const NO_NAME: u32 = u32::MAX;
/// Verb of a typed event: `feels emotion`.
pub const VERB_FEELS: u8 = 1;
/// Verb of a typed event: `sees target`.
pub const VERB_SEES: u8 = 2;
/// Verb of a typed event: `stares target`.
pub const VERB_STARES: u8 = 3;
/// Verb of a typed event: `stops staring`.
pub const VERB_STOPS_STARING: u8 = 4;
/// Verb of a typed event: `points target`.
pub const VERB_POINTS: u8 = 5;
/// Verb of a typed event: `stops pointing`.
pub const VERB_STOPS_POINTING: u8 = 6;
/// Verb of a typed event: `does action`.
pub const VERB_DOES: u8 = 7;
/// Verb of a typed event: `nods`, or `nods number`.
pub const VERB_NODS: u8 = 8;
/// Verb of a typed event: `shakes`, or `shakes number`.
pub const VERB_SHAKES: u8 = 9;
/// Verb of a typed event: `breathes`, or `breathes number`.
pub const VERB_BREATHES: u8 = 10;
/// Verb of a typed event: `blinks`.
pub const VERB_BLINKS: u8 = 11;
/// Verb of a typed event: `looks away`.
pub const VERB_LOOKS_AWAY: u8 = 12;

records! {
    /// The part of a clip that playback reads sixty times per second. Data for finding the clip is kept apart, so that many
    /// records fit in a cache.
    ClipRecord: 16 {
        /// Offset of the clip's first frame in the `FRAM` section.
        frames_offset_bytes: U32,
        /// Number of frames.
        frame_count: U32,
        /// Number of the first segment among those of all clips: its index in `STRT`, and in `EVRF` if that is long enough.
        segments_first: U32,
        /// Frames per second up to [`MAX_INTEGER_FPS`], above it an index in `RATE`, or [`NO_RATE`].
        rate: U16,
        /// Number of the [`VisemeType`](lipz_types::VisemeType), 0 if unspecified.
        viseme_type: u8,
        /// [`FLAG_VISEMES`] or 0.
        flags: u8,
    }

    /// The part of a clip for finding it, and for matching texts in other files.
    KeyRecord: 16 {
        /// [`ClipId`](lipz_types::ClipId) of the key.
        id: U64,
        /// Offset of the key in the `NAME` section.
        key_offset_bytes: U32,
        /// Length of the key in bytes.
        key_length_bytes: U16,
        /// Number of segments, at least 1.
        segment_count: U16,
    }

    /// One distinct non-integer frame rate.
    RateRecord: 16 {
        /// ⌈2⁶⁴ · frames per microsecond⌉.
        frames_per_micro_q64: U64,
        /// Frame rate, in lowest terms.
        fps_numerator: U32,
        /// Seconds in which that many frames pass.
        fps_denominator: U32,
    }

    /// One locale of the bank.
    LocaleRecord: 8 {
        /// Offset of the tag (`en-us`) in the `NAME` section.
        tag_offset_bytes: U32,
        /// Length of the tag in bytes.
        tag_length_bytes: U16,
        /// [`LOCALE_DEFAULT`] or 0.
        flags: U16,
    }

    /// One distinct event string.
    EventRecord: 16 {
        /// Offset of the string in the `EVST` section.
        offset_bytes: U32,
        /// Length of the string in bytes.
        length_bytes: U32,
        /// Index in `EVTY` of the first event of the string.
        typed_first: U32,
        /// Number of its events; 0 if the string is empty or not Character Event Syntax.
        typed_count: U32,
    }

    /// One event of Character Event Syntax.
    TypedEventRecord: 16 {
        /// Number in `EVNM` of the name of the character, or [`NO_NAME`] for the speaker of the clip.
        character: U32,
        /// Number in `EVNM` of the emotion, target or action, or of the amount of a gesture as written; [`NO_NAME`] without
        /// an object.
        object: U32,
        /// [`VERB_FEELS`] and so on.
        verb: u8,
        /// Zero.
        reserved: [u8; 7],
    }

    /// One distinct name in typed events: a character, emotion, target or action.
    EventNameRecord: 8 {
        /// Offset of the name in the `EVST` section.
        offset_bytes: U32,
        /// Length of the name in bytes.
        length_bytes: U32,
    }
}

impl RateRecord {
    /// Returns the rate of the record, without a check; `None` if it has no frames.
    #[inline]
    pub fn fps(&self) -> Option<StoredFps> {
        StoredFps::from_parts(self.fps_numerator.get(), self.fps_denominator.get(), self.frames_per_micro_q64.get())
    }
}

/// Returns the frame rate of [`ClipRecord::rate`], without a check; `None` if the number does not have one.
#[inline]
#[allow(clippy::arithmetic_side_effects)] // constants
pub fn stored_fps(rate: u16, records: &[RateRecord]) -> Option<StoredFps> {
    if rate <= MAX_INTEGER_FPS {
        return StoredFps::from_whole(rate);
    }
    // No bank has enough records for `NO_RATE` to lead to one.
    records.get(usize::from(rate).wrapping_sub(usize::from(MAX_INTEGER_FPS) + 1)).and_then(RateRecord::fps)
}
