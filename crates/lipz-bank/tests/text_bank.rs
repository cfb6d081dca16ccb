//! Text banks return the same answers as the bank from which they were split, match one bank only, and have their
//! damage detected like any bank.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Bank, Error, ErrorKind};
use lipz_layout::{NO_TEXT, Tag};
use lipz_testkit::exercise::every_text_query;
use lipz_testkit::golden::{DRAMA, SMALL, changed, directory, put, reseal, section, u32_at, verified};
use lipz_testkit::texts::{with_texts, with_texts_unverified};

static BASE: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.lipzbank");
static GERMAN: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.de-de.lipztexts");
static ENGLISH: &[u8] = include_bytes!("../../../fixtures/banks/v1/split.en-us.lipztexts");

/// Returns the error of opening and verifying the texts.
fn refusal(bank: &Bank<'_>, bytes: &[u8]) -> Option<Error> {
    with_texts(bank, bytes).err()
}

#[test]
fn answers_are_those_of_the_bank_with_texts() {
    let (whole, base) = (verified(SMALL), verified(BASE));
    assert_eq!(base.locales().count(), 0);
    assert_eq!(base.fingerprint(), whole.fingerprint());
    let mut compared = 0;
    for bytes in [GERMAN, ENGLISH] {
        let opened = with_texts(&base, bytes).expect("a golden text bank");
        for locale in opened.locales() {
            let same = whole.locale(opened.locale_tag(locale)).expect("a locale of the whole bank");
            assert_eq!(opened.default_locale() == Some(locale), whole.default_locale() == Some(same));
            for clip in opened.clips() {
                let other = whole.clip(clip.id()).expect("a clip of the whole bank");
                assert_eq!(clip.frames(), other.frames());
                for (segment, other) in clip.segments().zip(other.segments()) {
                    assert_eq!(segment.text(locale), other.text(same));
                    assert_eq!(segment.text_bytes(locale), other.text_bytes(same));
                    assert_eq!(segment.event(), other.event());
                    compared += usize::from(segment.text(locale).is_some());
                }
            }
        }
    }
    assert!(compared > 40, "{compared} texts");
}

#[test]
fn texts_belong_to_one_bank() {
    let other = verified(DRAMA);
    for opened in [with_texts(&other, GERMAN), with_texts_unverified(&other, GERMAN)] {
        let error = opened.expect_err("texts of other clips");
        assert_eq!((error.kind(), error.offset_bytes()), (ErrorKind::OtherClips, 24));
    }
}

#[test]
fn a_text_bank_is_no_bank() {
    assert_eq!(Bank::open(GERMAN).expect_err("no clips").kind(), ErrorKind::TextsOnly);
}

/// A complete bank of the same clips can serve as a text bank for all its locales.
#[test]
fn a_bank_with_texts_is_a_text_bank() {
    let base = verified(BASE);
    let opened = with_texts(&base, SMALL).expect("the same clips");
    assert!(opened.locales().map(|locale| opened.locale_tag(locale)).eq(["de-de", "en-us"]));
    assert!(every_text_query(&opened));
}

#[test]
fn every_truncation_and_every_change_is_noticed() {
    let base = verified(BASE);
    for length in 0..GERMAN.len() {
        assert!(refusal(&base, &GERMAN[..length]).is_some(), "{length} bytes");
    }
    let mut bytes = GERMAN.to_vec();
    for at in 0..bytes.len() {
        for change in 1..=255 {
            bytes[at] ^= change;
            if let Ok(opened) = with_texts_unverified(&base, &bytes) {
                every_text_query(&opened);
                assert!(refusal(&base, &bytes).is_some(), "byte {at} ^ {change:#x} goes unnoticed");
            }
            bytes[at] ^= change;
        }
    }
}

/// After the checksum is corrected, `verify` decides, and each file that passes is consistent.
#[test]
fn every_forged_byte() {
    let base = verified(BASE);
    for at in 16..GERMAN.len() {
        for change in 1..=255 {
            let mut bytes = GERMAN.to_vec();
            bytes[at] ^= change;
            reseal(&mut bytes);
            let Ok(opened) = with_texts_unverified(&base, &bytes) else { continue };
            every_text_query(&opened);
            if let Ok(opened) = with_texts(&base, &bytes) {
                assert!(every_text_query(&opened), "byte {at} ^ {change:#x}");
            }
        }
    }
}

#[test]
fn forged_references_are_named() {
    let base = verified(BASE);
    let starts = section(GERMAN, Tag::TEXT_STARTS);
    let own = starts.clone().step_by(4).find(|&at| u32_at(GERMAN, at) != NO_TEXT).expect("a text");
    let reference = changed(GERMAN, |bytes| put(bytes, own, 0x3FFF_FFFF_u32.to_le_bytes()));
    let error = refusal(&base, &reference).expect("past the pool");
    assert_eq!((error.kind(), error.offset_bytes()), (ErrorKind::TextReference, own as u32));
    let shorter = changed(GERMAN, |bytes| {
        let entry = 64 + 16 * directory(GERMAN).iter().position(|entry| entry.tag == Tag::TEXT_STARTS.0).expect("TXST");
        put(bytes, entry + 8, ((starts.len() - 4) as u32).to_le_bytes());
    });
    assert_eq!(refusal(&base, &shorter).map(Error::kind), Some(ErrorKind::TextReference));
}
