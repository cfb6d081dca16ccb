//! The binary layout of a bank, format 1: shared by the reader and the writer.
//!
//! This crate is for programs that write banks or look into their bytes. Programs that play dialogue use
//! `lipz-bank`, none of whose signatures holds a type of this crate: the layout may change without a
//! change of the reader.
//!
//! Every structure has alignment 1 and little-endian fields, so that any `&[u8]` can be read in
//! place. `docs/reference/bank-format.md` carries the same tables for people; a test compares the two.

#![no_std]
#![forbid(unsafe_code)]
// Numbers are narrowed only where they are known to fit.
#![allow(clippy::cast_possible_truncation)]
#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::arithmetic_side_effects,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic
    )
)]

mod checksum;
mod index;
mod records;
mod sections;

use lipz_types::hash::{FINISH, STEP, mix};

pub use lipz_types::BANK_MAGIC as MAGIC;

pub use checksum::{RunningChecksum, checksum};
pub use index::{DIRECT_SLOT, bucket_of, shard_of, slot_of, spread};
pub use records::{BabbleRecord, ClipRecord, EventNameRecord, EventRecord, FaceRecord};
pub use records::{CURVE_WIDE, CurveClipRecord, CurveKeyRecord, CurveRecord, WideCurveKeyRecord};
pub use records::{DUB_OF, NO_DUB, OTHER_DUB};
pub use records::{FLAG_VISEMES, LOCALE_DEFAULT, MAX_INTEGER_FPS, NO_NAME, NO_RATE, NO_RECORDING, stored_fps};
pub use records::{KeyRecord, LocaleRecord, RateRecord, RecordingRecord, SetBankRecord, TypedEventRecord};
pub use records::{
    LAYER_BABBLE, LAYER_DEFAULT_LOCALE, LAYER_DUB, LAYER_DUB_OF, LAYER_FACES, LAYER_NO_DUB, LAYER_OTHER_DUB,
    LAYER_VOICES, LayerDubRecord, LayerRecord, NO_STAND_IN, PART_CLIP, PART_ORIGINAL, PART_TEXTS, filter_place,
};
pub use records::{
    VERB_BLINKS, VERB_BREATHES, VERB_DOES, VERB_FEELS, VERB_LOOKS_AWAY, VERB_NODS, VERB_POINTS, VERB_SEES, VERB_SHAKES,
    VERB_STARES, VERB_STOPS_POINTING, VERB_STOPS_STARING,
};
pub use sections::{CHECKED_FROM, DirectoryEntry, Header, MAX_SECTIONS, SECTION_ALIGNMENT, SECTION_REQUIRED, Tag};

/// Little-endian, unaligned 16-bit number.
pub type U16 = zerocopy::little_endian::U16;
/// Little-endian, unaligned 32-bit number.
pub type U32 = zerocopy::little_endian::U32;
/// Little-endian, unaligned 16-bit number with a sign.
pub type I16 = zerocopy::little_endian::I16;
/// Little-endian, unaligned 32-bit number with a sign.
pub type I32 = zerocopy::little_endian::I32;
/// Little-endian, unaligned 64-bit number.
pub type U64 = zerocopy::little_endian::U64;

/// The first eight bytes of the index of a set, which is no bank.
pub const SET_MAGIC: [u8; 8] = *b"\x89LPS\r\n\x1a\n";

/// The most banks of a set.
pub const MAX_SET_BANKS: usize = 4096;

/// Major format version: a reader refuses any other.
pub const FORMAT_MAJOR: u16 = 1;
/// Minor format version: a reader accepts newer ones, which only add sections that it may skip.
pub const FORMAT_MINOR: u16 = 0;

/// Entry of the text starts for "no text, also after fallback".
pub const NO_TEXT: u32 = u32::MAX;
/// Bit of a text start: the text is that of another locale.
pub const TEXT_FALLBACK: u32 = 1 << 31;
/// Bit of a text start: the text does not end where the next one starts. A count comes before it.
pub const TEXT_HAS_LENGTH: u32 = 1 << 30;
/// The other bits of a text start: where the text, or its count, starts in the text pool, in bytes.
pub const TEXT_OFFSET: u32 = TEXT_HAS_LENGTH - 1;
/// Bytes of a count. Each has six bits of the text's length, the highest first, so that the pool stays UTF-8.
pub const TEXT_COUNT_BYTES: usize = 3;
/// The most bytes of a text.
pub const TEXT_MAX_BYTES: usize = 0xFFFF;

/// The count in front of a text of so many bytes.
#[inline]
pub const fn text_count(length_bytes: usize) -> [u8; TEXT_COUNT_BYTES] {
    [(length_bytes >> 12) as u8 & 0x3F, (length_bytes >> 6) as u8 & 0x3F, length_bytes as u8 & 0x3F]
}

/// The length in bytes of the text behind a count.
#[inline]
pub fn counted_length(count: &[u8]) -> usize {
    count.iter().fold(0, |length, digit| length << 6 | usize::from(digit & 0x3F))
}

/// Hash of the ids and segments of the clips, in slot order: what texts in another file must agree with.
pub fn fingerprint(keys: &[KeyRecord], clips: &[ClipRecord]) -> u64 {
    keys.iter().zip(clips).fold(keys.len() as u64, |hash, (key, clip)| {
        let segments = u64::from(clip.segments_first.get()) << 32 | u64::from(key.segment_count.get());
        mix(mix(hash ^ key.id.get(), STEP) ^ segments, FINISH)
    })
}

/// Hash of the fingerprints of the banks of a set, in their order.
pub fn set_fingerprint(banks: &[SetBankRecord]) -> u64 {
    banks.iter().fold(banks.len() as u64, |hash, bank| mix(hash ^ bank.fingerprint.get(), STEP))
}

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
