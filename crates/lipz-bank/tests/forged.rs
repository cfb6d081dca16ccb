//! Forged banks with a correct checksum, which `verify` rejects.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Error, ErrorKind};
use lipz_layout::{TEXT_HAS_LENGTH, Tag};
use lipz_testkit::forge::{ForgedClip, bank};
use lipz_testkit::golden::{SMALL, changed, entry_of, put, record_of, refusal, section, u32_at};

/// Every reference is checked, including those of sections that only the compiler reads.
#[test]
fn optional_sections_lie_in_the_file() {
    let entry = entry_of(SMALL, Tag::SOURCES);
    assert!(refusal(&changed(SMALL, |bank| put(bank, entry + 4, u32::MAX.to_le_bytes()))).is_some());
    assert!(refusal(&changed(SMALL, |bank| put(bank, entry + 8, u32::MAX.to_le_bytes()))).is_some());
    let index = entry_of(SMALL, Tag::SOURCE_INDEX);
    assert!(refusal(&changed(SMALL, |bank| put(bank, index + 12, [3]))).is_some(), "entry size");
}

#[test]
fn optional_sections_appear_once() {
    let entry = entry_of(SMALL, Tag::SOURCE_INDEX);
    assert!(refusal(&changed(SMALL, |bank| put(bank, entry, b"SRCE"))).is_some());
}

/// The fingerprint identifies files that belong together.
#[test]
fn the_fingerprint_is_that_of_the_clips() {
    assert!(refusal(&changed(SMALL, |bank| put(bank, 24, [0]))).is_some());
}

/// Sections start at multiples of 64 and follow each other.
#[test]
fn sections_are_aligned_and_apart() {
    let entry = entry_of(SMALL, Tag::SOURCES);
    let (start, length) = (u32_at(SMALL, entry + 4), u32_at(SMALL, entry + 8));
    let odd = changed(SMALL, |bank| {
        put(bank, entry + 4, (start + 1).to_le_bytes());
        put(bank, entry + 8, (length - 1).to_le_bytes());
    });
    assert!(refusal(&odd).is_some(), "not at a multiple of 64");
    let shared = changed(SMALL, |bank| put(bank, entry + 4, 0_u32.to_le_bytes()));
    assert!(refusal(&shared).is_some(), "sources on top of the header");
}

/// With two default locales, `default_locale` would return the first one.
#[test]
fn one_locale_is_the_default() {
    let locales = section(SMALL, Tag::LOCALES).start;
    assert!(refusal(&changed(SMALL, |bank| put(bank, locales + 6, [1]))).is_some());
}

/// If clips could share frames, the same frames would be checked for each clip, and verification would take quadratic
/// time.
#[test]
fn clips_do_not_share_frames() {
    let (blair, nine) = (record_of(SMALL, "act1/blair"), record_of(SMALL, "act2/nine"));
    let shared = changed(SMALL, |bank| {
        let (offset, first) = (u32_at(SMALL, blair), u32_at(SMALL, blair + 8));
        put(bank, nine, offset.to_le_bytes());
        put(bank, nine + 8, first.to_le_bytes());
    });
    assert!(refusal(&shared).is_some());
}

/// Many locales share the texts of many segments. Verification then checks only the ends of each text.
#[test]
fn shared_texts_are_whole() {
    let clip = ForgedClip { key: "k", frames: vec![], starts: vec![0; 2999] };
    let with = |pool| bank(std::slice::from_ref(&clip), 300, &[TEXT_HAS_LENGTH; 3000], pool);
    assert_eq!(refusal(&with(b"\0\0\x04four")), None);
    assert_eq!(refusal(&with(b"\0\0\x05four")).map(Error::kind), Some(ErrorKind::TextReference));
}
