//! Golden banks, and tools to inspect and damage them.

use crate::answers::write_answers;
use lipz_bank::{Bank, ClipId, Error};
use lipz_layout::{CHECKED_FROM, ClipRecord, DirectoryEntry, Header, KeyRecord, Tag, checksum};
use std::mem::size_of;
use std::ops::Range;
use zerocopy::FromBytes;

pub static CURVES: &[u8] = include_bytes!("../../../fixtures/banks/v1/curves.lipzbank");
/// Emotions in texts and events, and curves of a face.
pub static FACES: &[u8] = include_bytes!("../../../fixtures/banks/v1/faces.lipzbank");
/// Generated motion of faces, with two profiles.
pub static SPECIALS: &[u8] = include_bytes!("../../../fixtures/banks/v1/specials.lipzbank");
/// Phones, articulation profiles and rigs.
pub static PHONES: &[u8] = include_bytes!("../../../fixtures/banks/v1/phones.lipzbank");
/// All built-in rigs, and every English phone.
pub static RIGS: &[u8] = include_bytes!("../../../fixtures/banks/v1/rigs.lipzbank");
/// A line with a dub, which another voice falls back to.
pub static DUBBED: &[u8] = include_bytes!("../../../fixtures/banks/v1/dubbed.lipzbank");
pub static DRAMA: &[u8] = include_bytes!("../../../fixtures/banks/v1/drama.lipzbank");
pub static LONG: &[u8] = include_bytes!("../../../fixtures/banks/v1/long.lipzbank");
pub static RECORDED: &[u8] = include_bytes!("../../../fixtures/banks/v1/recorded.lipzbank");
pub static SMALL: &[u8] = include_bytes!("../../../fixtures/banks/v1/small.lipzbank");
pub static STRIPPED: &[u8] = include_bytes!("../../../fixtures/banks/v1/stripped.lipzbank");
/// Variants of texts, with keys of one and two names.
pub static VARIANTS: &[u8] = include_bytes!("../../../fixtures/banks/v1/variants.lipzbank");
pub static WIDE: &[u8] = include_bytes!("../../../fixtures/banks/v1/wide.lipzbank");

/// Returns a verified bank of this repository.
pub fn verified(bytes: &[u8]) -> Bank<'_> {
    Bank::open(bytes).and_then(Bank::verify).expect("a golden bank")
}

/// Returns the error of `open` or `verify` for these bytes, if there is one.
pub fn refusal(bytes: &[u8]) -> Option<Error> {
    Bank::open(bytes).and_then(Bank::verify).err()
}

/// Corrects the checksum after a change.
pub fn reseal(bytes: &mut [u8]) {
    if let Some(checked) = bytes.get(CHECKED_FROM..) {
        let sum = checksum(checked);
        bytes[8..16].copy_from_slice(&sum.to_le_bytes());
    }
}

/// Returns a copy of `bytes` that `change` has changed, with a correct checksum.
pub fn changed(bytes: &[u8], change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut copy = bytes.to_vec();
    change(&mut copy);
    reseal(&mut copy);
    copy
}

/// Overwrites the bytes from `at` on.
pub fn put(bytes: &mut [u8], at: usize, new: impl AsRef<[u8]>) {
    let new = new.as_ref();
    bytes[at..at + new.len()].copy_from_slice(new);
}

/// Returns the number in the four bytes at `at`.
pub fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

/// Returns the directory of an undamaged bank.
pub fn directory(bytes: &[u8]) -> &[DirectoryEntry] {
    let (header, rest) = Header::ref_from_prefix(bytes).expect("a header");
    let count = header.section_count.get() as usize;
    <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).expect("a directory").0
}

/// Returns the offset of a section's directory entry.
pub fn entry_of(bytes: &[u8], tag: Tag) -> usize {
    let index = directory(bytes).iter().position(|entry| entry.tag == tag.0).expect("a known section");
    size_of::<Header>() + index * size_of::<DirectoryEntry>()
}

/// Returns the range of a section's contents.
pub fn section(bytes: &[u8], tag: Tag) -> Range<usize> {
    let at = entry_of(bytes, tag);
    let start = u32_at(bytes, at + 4) as usize;
    start..start + u32_at(bytes, at + 8) as usize
}

/// Returns the slot of a clip.
fn slot_of(bytes: &[u8], key: &str) -> usize {
    let records = <[KeyRecord]>::ref_from_bytes(&bytes[section(bytes, Tag::KEYS)]).expect("key records");
    records.iter().position(|record| record.id.get() == ClipId::from_key(key).get()).expect("a known key")
}

/// Returns the offset of a clip's record.
pub fn record_of(bytes: &[u8], key: &str) -> usize {
    section(bytes, Tag::CLIPS).start + slot_of(bytes, key) * size_of::<ClipRecord>()
}

/// Returns the offset of a clip's key record.
pub fn key_record_of(bytes: &[u8], key: &str) -> usize {
    section(bytes, Tag::KEYS).start + slot_of(bytes, key) * size_of::<KeyRecord>()
}

/// A random number generator with a fixed seed (SplitMix64; Steele, Lea and Flood, OOPSLA 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// Returns a number below `bound`.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.next_u64() % bound as u64) as usize
    }
}

/// Returns all answers of `bank`, one fact per line, ordered by key and tag.
pub fn dump(bank: &Bank<'_>) -> String {
    let mut out = String::new();
    write_answers(bank, &mut out).expect("a string takes everything");
    out
}
