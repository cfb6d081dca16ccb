//! Forged banks: the checksum is right, and yet `verify` refuses them.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

mod common;

use common::forge::{ForgedClip, bank};
use common::{DRAMA, SMALL, changed, entry_of, finding, put, record_of, section, u32_at, verified};
use lipz_bank::layout::Tag;
use lipz_bank::{Error, ErrorKind};

/// Every reference is checked, also those of sections that only the compiler reads.
#[test]
fn optional_sections_lie_in_the_file() {
    let entry = entry_of(SMALL, Tag::SOURCES);
    assert!(finding(&changed(SMALL, |bank| put(bank, entry + 4, u32::MAX.to_le_bytes()))).is_some());
    assert!(finding(&changed(SMALL, |bank| put(bank, entry + 8, u32::MAX.to_le_bytes()))).is_some());
    let index = entry_of(SMALL, Tag::SOURCE_INDEX);
    assert!(finding(&changed(SMALL, |bank| put(bank, index + 12, [3]))).is_some(), "entry size");
}

#[test]
fn optional_sections_appear_once() {
    let entry = entry_of(SMALL, Tag::SOURCE_INDEX);
    assert!(finding(&changed(SMALL, |bank| put(bank, entry, b"SRCE"))).is_some());
}

/// The fingerprint tells which files belong together.
#[test]
fn the_fingerprint_is_that_of_the_clips() {
    assert!(finding(&changed(SMALL, |bank| put(bank, 24, [0]))).is_some());
}

/// Sections start at multiples of 64, one behind the other.
#[test]
fn sections_are_aligned_and_apart() {
    let entry = entry_of(SMALL, Tag::SOURCES);
    let (start, length) = (u32_at(SMALL, entry + 4), u32_at(SMALL, entry + 8));
    let odd = changed(SMALL, |bank| {
        put(bank, entry + 4, (start + 1).to_le_bytes());
        put(bank, entry + 8, (length - 1).to_le_bytes());
    });
    assert!(finding(&odd).is_some(), "not at a multiple of 64");
    let shared = changed(SMALL, |bank| put(bank, entry + 4, 0_u32.to_le_bytes()));
    assert!(finding(&shared).is_some(), "sources on top of the header");
}

/// With two default locales, `default_locale` would return the first of them.
#[test]
fn one_locale_is_the_default() {
    let locales = section(SMALL, Tag::LOCALES).start;
    assert!(finding(&changed(SMALL, |bank| put(bank, locales + 6, [1]))).is_some());
}

/// The ends in a text run are bytes of seven bits. With the eighth set in two neighbours the pool
/// is still UTF-8, and the reader would take the bits of the one into the other.
#[test]
fn ends_have_seven_bits() {
    // The last end of the run at the start of the pool: no text of another clip depends on it.
    let index = section(DRAMA, Tag::TEXT_INDEX);
    let place = index.clone().step_by(4).position(|at| u32_at(DRAMA, at) == 0).expect("the first run");
    let bank = verified(DRAMA);
    let clip = bank.clip_at((place % bank.clip_count()) as u32).expect("its clip");
    let end = section(DRAMA, Tag::TEXTS).start + 2 * (clip.segment_count() as usize - 1);
    for (low, high) in (0xC2..0xE0).flat_map(|low| (0x80..0xC0).map(move |high| (low, high))) {
        assert!(finding(&changed(DRAMA, |bank| put(bank, end, [low, high]))).is_some(), "{low:#x} {high:#x}");
    }
}

/// Were clips allowed to claim the same frames, each claim would be checked anew, and verification
/// would take time in the square of the length.
#[test]
fn clips_do_not_share_frames() {
    let (blair, nine) = (record_of(SMALL, "act1/blair"), record_of(SMALL, "act2/nine"));
    let shared = changed(SMALL, |bank| {
        let offset = u32_at(SMALL, blair + 24) + 1;
        put(bank, nine + 24, offset.to_le_bytes());
    });
    assert!(finding(&shared).is_some());
}

/// Many locales that share a few runs of many segments: each entry of four bytes would cost a check
/// of a whole run. The bank of 700 kB below would take 10⁹ steps.
#[test]
fn shared_runs_have_a_budget() {
    let with = |segments: usize, locales: usize, runs: usize| {
        let clip = ForgedClip { key: "k", frames: vec![], starts: vec![0; segments - 1], has_far_starts: true };
        let entries: Vec<u32> = (0..locales).map(|locale| (locale % runs) as u32).collect();
        bank(&[clip], locales, &entries, &vec![0; 2 * segments + runs])
    };
    assert_eq!(finding(&with(30_000, 30_000, 50)).map(Error::kind), Some(ErrorKind::TooManySteps));
    // Locales that fall back to one run are no cause for suspicion.
    assert_eq!(finding(&with(30_000, 30_000, 1)), None);
    assert_eq!(finding(&with(300, 100, 50)), None);
}
