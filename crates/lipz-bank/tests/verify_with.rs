//! Verifies with the program's own UTF-8 check.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::{Bank, ErrorKind};

type Utf8Check = fn(&[u8]) -> Option<&str>;

const BANK: &[u8] = include_bytes!("../../../fixtures/banks/v1/drama.lipzbank");

fn texts(bank: &Bank<'_>) -> Vec<String> {
    let locale = bank.locale("en-us").unwrap();
    let segments = bank.clips().flat_map(|clip| clip.segments());
    segments.filter_map(|segment| Some(segment.text(locale)?.to_string())).collect()
}

#[test]
fn gives_the_same_texts() {
    let with_core = Bank::open(BANK).unwrap().verify().unwrap();
    let with_own = Bank::open(BANK).unwrap().verify_with(|bytes| std::str::from_utf8(bytes).ok()).unwrap();
    assert!(!texts(&with_core).is_empty());
    assert_eq!(texts(&with_core), texts(&with_own));
}

#[test]
fn a_check_that_is_wrong_changes_nothing() {
    let expected = texts(&Bank::open(BANK).unwrap().verify().unwrap());
    let wrong: [Utf8Check; 3] =
        [|_| None, |_| Some("something else"), |bytes| std::str::from_utf8(bytes).ok()?.get(1..)];
    for wrong in wrong {
        let bank = Bank::open(BANK).unwrap().verify_with(wrong).unwrap();
        assert_eq!(texts(&bank), expected);
    }
}

#[test]
fn damage_is_found_where_it_is() {
    let mut bytes = BANK.to_vec();
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    let error = Bank::open(&bytes).unwrap().verify_with(|bytes| std::str::from_utf8(bytes).ok()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Checksum);
}
