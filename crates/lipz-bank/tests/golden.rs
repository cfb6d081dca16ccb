//! Golden banks of every format version: they open, verify, and return the same answers as ever.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_testkit::exercise;
use lipz_testkit::golden::dump;
use lipz_testkit::golden::{
    CURVES, DRAMA, DUBBED, FACES, LONG, PHONES, RECORDED, RIGS, SMALL, SPECIALS, STRIPPED, VARIANTS, WIDE, verified,
};
use std::path::Path;

/// Compares the answers of a bank with the committed ones, or commits them with `LIPZ_BLESS=1`.
fn check(bytes: &[u8], name: &str) {
    let bank = verified(bytes);
    exercise::verified_is_whole(&bank);
    exercise::every_query(&bank, exercise::Effort::All);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/banks/v1").join(name);
    let found = dump(&bank);
    if std::env::var_os("LIPZ_BLESS").is_some() {
        std::fs::write(&path, &found).expect("the dump can be written");
    }
    let expected = std::fs::read_to_string(&path).expect("a dump beside the bank (LIPZ_BLESS=1 writes it)");
    for (line, (found, expected)) in found.lines().zip(expected.lines()).enumerate() {
        assert_eq!(found, expected, "{name}, line {}", line + 1);
    }
    assert_eq!(found.len(), expected.len(), "{name}: the one is longer than the other");
}

#[test]
fn drama() {
    check(DRAMA, "drama.dump");
}

#[test]
fn small() {
    check(SMALL, "small.dump");
}

#[test]
fn wide() {
    check(WIDE, "wide.dump");
}

#[test]
fn long() {
    check(LONG, "long.dump");
}

#[test]
fn curves() {
    check(CURVES, "curves.dump");
}

#[test]
fn faces() {
    check(FACES, "faces.dump");
}

#[test]
fn phones() {
    check(PHONES, "phones.dump");
}

#[test]
fn rigs() {
    check(RIGS, "rigs.dump");
}

#[test]
fn specials() {
    check(SPECIALS, "specials.dump");
}

#[test]
fn recorded() {
    check(RECORDED, "recorded.dump");
    check(DUBBED, "dubbed.dump");
}

#[test]
fn variants() {
    check(VARIANTS, "variants.dump");
}

/// Stripping the sources changes no answer: the dump is that of the bank with sources.
#[test]
fn stripped() {
    check(STRIPPED, "small.dump");
    assert!(STRIPPED.len() < SMALL.len());
    assert_eq!(verified(STRIPPED).fingerprint(), verified(SMALL).fingerprint());
}

/// Tests that change each byte of this bank are only fast while it is small.
#[test]
fn small_is_small() {
    assert!(SMALL.len() < 4096, "{} bytes", SMALL.len());
}

/// The wide bank has long texts and final texts with counts, both own texts and fallbacks.
#[test]
fn wide_has_long_and_counted_texts() {
    use lipz_layout::{TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_OFFSET, Tag};
    let starts = &WIDE[lipz_testkit::golden::section(WIDE, Tag::TEXT_STARTS)];
    let entries = || (0..starts.len()).step_by(4).map(|at| lipz_testkit::golden::u32_at(starts, at));
    let count = |flags| entries().filter(|entry| entry & !TEXT_OFFSET == flags).count();
    assert_eq!((count(TEXT_HAS_LENGTH), count(TEXT_HAS_LENGTH | TEXT_FALLBACK)), (4, 2));
    assert!(count(0) > 0 && count(TEXT_FALLBACK) > 0);
    assert!(WIDE[lipz_testkit::golden::section(WIDE, Tag::TEXTS)].len() > 0xFFFF);
}
