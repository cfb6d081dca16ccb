//! Deliberately changed banks that are otherwise correct.

use super::Scene;
use lipz_bank::ClipId;
use lipz_layout::{CHECKED_FROM, ClipRecord, KeyRecord, Tag, checksum, fingerprint};
use std::fs;

/// Returns the range of a section in the bank, from its directory entry.
pub(crate) fn section(bank: &[u8], tag: Tag) -> std::ops::Range<usize> {
    let at = bank.windows(4).position(|window| window == tag.0).unwrap();
    let number = |at: usize| u32::from_le_bytes(bank[at..at + 4].try_into().unwrap()) as usize;
    number(at + 4)..number(at + 4) + number(at + 8)
}

/// Corrects the checksum.
pub(crate) fn seal(bank: &mut [u8]) {
    let sum = checksum(&bank[CHECKED_FROM..]);
    bank[8..16].copy_from_slice(&sum.to_le_bytes());
}

/// Returns a valid bank with one clip, whose key of ten bytes is not allowed for files. With a single clip, every id
/// has slot 0.
pub(crate) fn bank_with_key(scene: &Scene, key: &str) -> Vec<u8> {
    scene.write("forged/act1/ottos.lipz", r#"{ "text_en-us": "Aye." }"#);
    scene.prepare(&["pack", "forged", "-o", "forged.lipzbank", "--quiet"]);
    let mut bank = fs::read(scene.path().join("forged.lipzbank")).unwrap();
    let names = section(&bank, Tag::NAMES);
    let at = bank[names.clone()].windows(10).position(|window| window == b"act1/ottos").unwrap() + names.start;
    bank[at..at + 10].copy_from_slice(key.as_bytes());
    let id = ClipId::from_key(key).get();
    let record = section(&bank, Tag::KEYS).start;
    bank[record..record + 8].copy_from_slice(&id.to_le_bytes());
    bank[24..32].copy_from_slice(&fingerprint_of(id).to_le_bytes());
    seal(&mut bank);
    bank
}

/// Returns the fingerprint of a bank with one clip of one segment.
fn fingerprint_of(id: u64) -> u64 {
    let key =
        KeyRecord { id: id.into(), key_offset_bytes: 0.into(), key_length_bytes: 0.into(), segment_count: 1.into() };
    let clip = ClipRecord {
        frames_offset_bytes: 0.into(),
        frame_count: 0.into(),
        segments_first: 0.into(),
        rate: 0.into(),
        viseme_type: 0,
        flags: 0,
    };
    fingerprint(&[key], &[clip])
}
