//! The binary layout of a bank, format 1: shared by the reader and the writer.
//!
//! This crate is for programs that write banks or inspect their bytes. Programs that play dialogue use `lipz-bank`,
//! whose signatures contain no type of this crate, so the layout can change without changing the reader.
//!
//! Every structure has alignment 1 and little-endian fields, so that any `&[u8]` can be read in place.
//! `docs/reference/bank-format.md` has the same tables in readable form; a test compares the two.

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
mod header;
mod index;
mod optional;
mod records;
mod required;
mod set;

use lipz_types::hash::{FINISH, STEP, mix};

pub use lipz_types::BANK_MAGIC as MAGIC;

pub use checksum::{RunningChecksum, checksum};
pub use header::*;
pub use index::{DIRECT_SLOT, bucket_of, shard_of, slot_of, spread};
pub use optional::*;
pub use records::{RECORDS, RecordLayout};
pub use required::*;
pub use set::*;

/// Little-endian, unaligned, unsigned 16-bit number.
pub type U16 = zerocopy::little_endian::U16;
/// Little-endian, unaligned, unsigned 32-bit number.
pub type U32 = zerocopy::little_endian::U32;
/// Little-endian, unaligned, signed 16-bit number.
pub type I16 = zerocopy::little_endian::I16;
/// Little-endian, unaligned, signed 32-bit number.
pub type I32 = zerocopy::little_endian::I32;
/// Little-endian, unaligned, unsigned 64-bit number.
pub type U64 = zerocopy::little_endian::U64;

/// Major format version: a reader rejects any other.
pub const FORMAT_MAJOR: u16 = 1;
/// Minor format version: a reader accepts newer ones, which only add sections that it may skip.
pub const FORMAT_MINOR: u16 = 0;

/// Text start for "no text, even after fallback".
pub const NO_TEXT: u32 = u32::MAX;
/// Bit of a text start: the text comes from another locale.
pub const TEXT_FALLBACK: u32 = 1 << 31;
/// Bit of a text start: the text does not end where the next one starts. A count comes before it.
pub const TEXT_HAS_LENGTH: u32 = 1 << 30;
/// The other bits of a text start: the offset of the text, or its count, in the text pool, in bytes.
pub const TEXT_OFFSET: u32 = TEXT_HAS_LENGTH - 1;
/// Length of a count in bytes. Each byte has six bits of the text's length, the highest first, so that the pool stays
/// UTF-8.
pub const TEXT_COUNT_BYTES: usize = 3;
/// The maximal length of a text in bytes.
pub const TEXT_MAX_BYTES: usize = 0xFFFF;

/// Returns the count that precedes a text of this length.
#[inline]
pub const fn text_count(length_bytes: usize) -> [u8; TEXT_COUNT_BYTES] {
    [(length_bytes >> 12) as u8 & 0x3F, (length_bytes >> 6) as u8 & 0x3F, length_bytes as u8 & 0x3F]
}

/// Returns the length in bytes of the text after a count.
#[inline]
pub fn counted_length(count: &[u8]) -> usize {
    count.iter().fold(0, |length, digit| length << 6 | usize::from(digit & 0x3F))
}

/// Returns a hash of the ids and segments of the clips, in slot order, which texts in another file must match.
pub fn fingerprint(keys: &[KeyRecord], clips: &[ClipRecord]) -> u64 {
    keys.iter().zip(clips).fold(keys.len() as u64, |hash, (key, clip)| {
        let segments = u64::from(clip.segments_first.get()) << 32 | u64::from(key.segment_count.get());
        mix(mix(hash ^ key.id.get(), STEP) ^ segments, FINISH)
    })
}

/// Returns a hash of the fingerprints of a set's banks, in their order.
pub fn set_fingerprint(banks: &[SetBankRecord]) -> u64 {
    banks.iter().fold(banks.len() as u64, |hash, bank| mix(hash ^ bank.fingerprint.get(), STEP))
}

/// The example of the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
