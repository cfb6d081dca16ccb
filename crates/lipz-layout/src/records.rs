//! The records of the sections.

use super::{I16, I32, U16, U32, U64};
use core::mem::size_of;
use lipz_types::StoredFps;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

/// Clip flag: the file has a `visemes` element (possibly of no frames).
pub const FLAG_VISEMES: u8 = 1;
/// `rate` of a clip whose frame rate is unspecified.
pub const NO_RATE: u16 = u16::MAX;
/// The highest `rate` that is itself the frames of a second. Those above it count the places in the `RATE`
/// section.
pub const MAX_INTEGER_FPS: u16 = 1000;
/// Locale flag: the project's default locale.
pub const LOCALE_DEFAULT: u16 = 1;
/// Number of a typed event's character for "the speaker", and of its object for "none".
pub const NO_NAME: u32 = u32::MAX;
/// `length_us` of a clip without a recording.
pub const NO_RECORDING: u64 = u64::MAX;
/// Bit of a curve's `name_and_width`: its keys are [`WideCurveKeyRecord`]s.
pub const CURVE_WIDE: u32 = 1 << 31;
/// Flag of a layer: its babble profiles, or its lack of them, count, and not those below it.
pub const LAYER_BABBLE: u32 = 1;
/// Flag of a layer: its default locale, or its lack of one, counts, and not that below it.
pub const LAYER_DEFAULT_LOCALE: u32 = 2;
/// Flag of a layer: its face profiles, or its lack of them, count, and not those below it.
pub const LAYER_FACES: u32 = 4;
/// Flag of a layer: its list of voices, or its lack of one, counts, and not those below it.
pub const LAYER_VOICES: u32 = 8;
/// Part of a clip in a layer: everything but its texts.
pub const PART_CLIP: u8 = 1;
/// Part of a clip in a layer: its texts.
pub const PART_TEXTS: u8 = 2;
/// Part of a dub in a layer, in place of its texts: they are those that the stack has for its original.
pub const PART_ORIGINAL: u8 = 4;
/// Stand-in of a locale for which no other one stands in.
pub const NO_STAND_IN: u32 = u32::MAX;
/// Entry of the table of a voice for a clip that has no dub there.
pub const NO_DUB: u32 = u32::MAX;
/// Bit of an entry of the table of a voice: the clip in this slot is a dub in this voice, and the rest is the slot of its
/// original.
pub const DUB_OF: u32 = 1 << 31;
/// Bit of an entry of the table of a voice: there is no dub in this voice, and the rest is the slot of that in another
/// one, which the voice falls back to.
pub const OTHER_DUB: u32 = 1 << 30;
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

/// One clip while it plays: what is asked for sixty times a second, apart from how it is found, so that
/// many fit into a cache.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct ClipRecord {
    /// Where the clip's frames start in the `FRAM` section.
    pub frames_offset_bytes: U32,
    /// Frames of the clip.
    pub frame_count: U32,
    /// Number of the first segment among those of all clips: its index in `STRT`, and in `EVRF` if that
    /// is as long.
    pub segments_first: U32,
    /// Frames in a second up to [`MAX_INTEGER_FPS`], and above it their places in `RATE`; or [`NO_RATE`].
    pub rate: U16,
    /// Number of the [`VisemeType`](lipz_types::VisemeType), 0 if unspecified.
    pub viseme_type: u8,
    /// [`FLAG_VISEMES`] or 0.
    pub flags: u8,
}

/// One clip as it is found, and what says which texts in other files are its own.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct KeyRecord {
    /// [`ClipId`](lipz_types::ClipId) of the key.
    pub id: U64,
    /// Where the key starts in the `NAME` section.
    pub key_offset_bytes: U32,
    /// Length of the key.
    pub key_length_bytes: U16,
    /// Segments of the clip, at least 1.
    pub segment_count: U16,
}

/// One distinct non-integer frame rate.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct RateRecord {
    /// ⌈2⁶⁴ · frames per microsecond⌉.
    pub frames_per_micro_q64: U64,
    /// Frame rate, in lowest terms.
    pub fps_numerator: U32,
    /// Seconds in which that many frames pass.
    pub fps_denominator: U32,
}

impl RateRecord {
    /// The rate of the record, not checked; `None` if it is of no frames.
    #[inline]
    pub fn fps(&self) -> Option<StoredFps> {
        StoredFps::from_parts(self.fps_numerator.get(), self.fps_denominator.get(), self.frames_per_micro_q64.get())
    }
}

/// The frame rate that [`ClipRecord::rate`] stands for, not checked; `None` if it stands for none.
#[inline]
#[allow(clippy::arithmetic_side_effects)] // constants
pub fn stored_fps(rate: u16, records: &[RateRecord]) -> Option<StoredFps> {
    if rate <= MAX_INTEGER_FPS {
        return StoredFps::from_whole(rate);
    }
    // No bank has so many records that `NO_RATE` leads to one.
    records.get(usize::from(rate).wrapping_sub(usize::from(MAX_INTEGER_FPS) + 1)).and_then(RateRecord::fps)
}

/// One locale of the bank.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct LocaleRecord {
    /// Where the tag (`en-us`) starts in the `NAME` section.
    pub tag_offset_bytes: U32,
    /// Length of the tag.
    pub tag_length_bytes: U16,
    /// [`LOCALE_DEFAULT`] or 0.
    pub flags: U16,
}

/// One distinct event string.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct EventRecord {
    /// Where the string starts in the `EVST` section.
    pub offset_bytes: U32,
    /// Length of the string.
    pub length_bytes: U32,
    /// Index in `EVTY` of the first of the events that the string is made of.
    pub typed_first: U32,
    /// How many they are; 0 if the string is empty or some other syntax than Character Event Syntax.
    pub typed_count: U32,
}

/// One event of Character Event Syntax.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct TypedEventRecord {
    /// Number of the name of who does it in `EVNM`, or [`NO_NAME`] for the speaker of the clip.
    pub character: U32,
    /// Number of the name of the emotion, target or action in `EVNM`, or of the number of a gesture, as it is written;
    /// [`NO_NAME`] where there is none.
    pub object: U32,
    /// [`VERB_FEELS`] and so on.
    pub verb: u8,
    /// Zero.
    pub reserved: [u8; 7],
}

/// One distinct name that typed events mention: a character, emotion, target or action.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct EventNameRecord {
    /// Where the name starts in the `EVST` section.
    pub offset_bytes: U32,
    /// Length of the name.
    pub length_bytes: U32,
}

/// One babble profile; its name, loops and power transfers follow it in this order.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct BabbleRecord {
    /// ⌈2⁶⁴ · digits per microsecond⌉.
    pub frames_per_micro_q64: U64,
    /// Digits of the loops in `rate_denominator` seconds, in lowest terms.
    pub rate_numerator: U32,
    /// Seconds in which that many digits pass.
    pub rate_denominator: U32,
    /// Length of the name.
    pub name_length_bytes: U16,
    /// Length of the loop for the lips.
    pub ooh_length_bytes: U16,
    /// Length of the loop for the jaw.
    pub aah_length_bytes: U16,
    /// Length of the power transfer of the lips.
    pub ooh_power_transfer_length_bytes: U16,
    /// Length of the power transfer of the jaw.
    pub aah_power_transfer_length_bytes: U16,
    /// Zero.
    pub reserved: [u8; 6],
}

/// One face profile; its name follows it.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct FaceRecord {
    /// Milliseconds from blink to blink on a calm face, then while each of the twelve attributes of emotion is the strongest;
    /// 0 for no blinks.
    pub blink_interval_ms: [U16; 13],
    /// Length of a blink.
    pub blink_length_ms: U16,
    /// How many of 100 blinks are double.
    pub double_blink_percent: u8,
    /// Percentage of the time in which the eyes glance at hands and body.
    pub glance_percent: u8,
    /// How far the head turns while the mouth moves, in thousandths of a degree.
    pub head_motion: U16,
    /// How far the eyes turn before the head follows them, in thousandths of a degree.
    pub head_follows: U16,
    /// Milliseconds from one pose of the head to the next.
    pub pose_ms: U16,
    /// Milliseconds from one fixation of the eyes to the next.
    pub fixation_ms: U16,
    /// Length of the name.
    pub name_length_bytes: U16,
}

/// The recording that the mouth shapes of a clip were made for.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct RecordingRecord {
    /// Length in microseconds, rounded to the nearest; [`NO_RECORDING`] if the clip has none.
    pub length_us: U64,
    /// XXH3-64 with seed 0 of all bytes of the file; 0 if the clip has none.
    pub content_hash: U64,
}

/// One clip with curves.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct CurveClipRecord {
    /// Slot of the clip.
    pub slot: U32,
    /// Index in `CURV` of the first of its curves.
    pub curves_first: U32,
}

/// One curve of a clip.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct CurveRecord {
    /// Where its keys start in `CRVK`, in units of four bytes.
    pub keys_first: U32,
    /// Number of its name in `EVNM`, and [`CURVE_WIDE`].
    pub name_and_width: U32,
}

/// One key of a curve, if all of its keys fit so.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct CurveKeyRecord {
    /// The frame at whose start the curve has the value.
    pub frame: U16,
    /// The value in thousandths.
    pub thousandths: I16,
}

/// One key of a curve of which one is late or large.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct WideCurveKeyRecord {
    /// The frame at whose start the curve has the value.
    pub frame: U32,
    /// The value in thousandths.
    pub thousandths: I32,
}

/// What a bank is over others: the start of the `LAYR` section.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct LayerRecord {
    /// Banks that it was made over, at least 1: so many checksums follow.
    pub base_count: U32,
    /// Clips of those banks that it removes: so many ids follow the checksums.
    pub removed_count: U32,
    /// Entries about the locales, 0 or one for each: they follow the ids.
    pub stand_in_count: U32,
    /// Entries about the clips, 0 or one for each slot: they follow those about the locales.
    pub part_count: U32,
    /// Locales of those banks that it removes: their tags are the rest of the section.
    pub removed_locale_count: U32,
    /// [`LAYER_BABBLE`], [`LAYER_DEFAULT_LOCALE`], [`LAYER_FACES`] and [`LAYER_VOICES`].
    pub flags: U32,
    /// Words of the filter of ids, 0 or a power of two: they follow the checksums.
    pub filter_count: U32,
    /// What changes about dubs: so many [`LayerDubRecord`]s follow the ids of removed clips.
    pub dub_count: U32,
    /// Texts of partly dubbed clips that are those of their originals: so many places follow what is about dubs.
    pub borrowed_count: U32,
    /// Voices that it adds, or all of the stack with [`LAYER_VOICES`], behind that of the originals; 0, or at least 2. Their tags
    /// follow the entries about the clips.
    pub voice_count: U32,
}

/// What a layer says about a clip in a voice: an entry of `DUBS` with ids for slots.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct LayerDubRecord {
    /// The id of the clip.
    pub clip_id: U64,
    /// The id of the clip that is played for it, or that it is a dub of; 0 if there is none.
    pub other_id: U64,
    /// Index of the voice in the layer's list.
    pub voice: U16,
    /// [`LAYER_NO_DUB`], [`LAYER_DUB`], [`LAYER_OTHER_DUB`] or [`LAYER_DUB_OF`].
    pub kind: U16,
    /// Zero.
    pub reserved: [u8; 4],
}

/// Nothing is played for the clip in this voice, and it is a dub of none.
pub const LAYER_NO_DUB: u16 = 0;
/// The other clip is the dub of this one.
pub const LAYER_DUB: u16 = 1;
/// The other clip is a dub of this one in another voice, and is played where this voice has none.
pub const LAYER_OTHER_DUB: u16 = 2;
/// The clip is the dub of the other one.
pub const LAYER_DUB_OF: u16 = 3;

/// A bank of a set: 32 bytes.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned, Clone, Copy, Debug)]
#[repr(C)]
pub struct SetBankRecord {
    /// The checksum in its header.
    pub checksum: U64,
    /// The fingerprint in its header.
    pub fingerprint: U64,
    /// Its length.
    pub length_bytes: U32,
    /// Its clips.
    pub clip_count: U32,
    /// Where the name of its file starts in `NAME`.
    pub name_offset_bytes: U32,
    /// Length of the name.
    pub name_length_bytes: U32,
}

/// The word of a filter of ids with so many words, and the bit in it, that stand for an id.
#[inline]
pub const fn filter_place(id: u64, filter_count: usize) -> (usize, u32) {
    // Ids are hashes: their bits are as good as those of another hash. The count is a power of two.
    ((id >> 6) as usize & filter_count.wrapping_sub(1), id as u32 & 63)
}

const _: () = assert!(size_of::<LayerRecord>() == 40);
const _: () = assert!(size_of::<LayerDubRecord>() == 24);
const _: () = assert!(size_of::<SetBankRecord>() == 32);
const _: () = assert!(size_of::<CurveClipRecord>() == 8);
const _: () = assert!(size_of::<CurveRecord>() == 8);
const _: () = assert!(size_of::<CurveKeyRecord>() == 4);
const _: () = assert!(size_of::<WideCurveKeyRecord>() == 8);
const _: () = assert!(size_of::<BabbleRecord>() == 32);
const _: () = assert!(size_of::<FaceRecord>() == 40);
const _: () = assert!(size_of::<RecordingRecord>() == 16);
const _: () = assert!(size_of::<ClipRecord>() == 16);
const _: () = assert!(size_of::<KeyRecord>() == 16);
const _: () = assert!(size_of::<RateRecord>() == 16);
const _: () = assert!(size_of::<LocaleRecord>() == 8);
const _: () = assert!(size_of::<EventRecord>() == 16);
const _: () = assert!(size_of::<TypedEventRecord>() == 16);
const _: () = assert!(size_of::<EventNameRecord>() == 8);
