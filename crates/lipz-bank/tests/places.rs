//! Places that were kept lead to the same bank, and to no other one.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::incompatible_msrv, clippy::cast_possible_truncation)]

use lipz_bank::{Bank, Places};
use lipz_testkit::exercise::{Effort, every_query};
use lipz_testkit::golden::{DRAMA, RECORDED, Random, SMALL, STRIPPED, WIDE, changed, dump, put, verified};

fn kept(bytes: &[u8]) -> Places {
    Places::from_words(Places::find(bytes).expect("a bank").to_words())
}

#[test]
fn a_bank_at_kept_places_answers_as_when_it_was_opened() {
    for bytes in [DRAMA, RECORDED, SMALL, STRIPPED, WIDE] {
        let bank = Bank::open_at(bytes, &kept(bytes)).expect("the same bytes");
        assert!(!bank.is_verified());
        let bank = bank.verify().expect("a golden bank");
        assert_eq!(dump(&bank), dump(&verified(bytes)));
    }
}

#[test]
fn what_open_refuses_has_no_places() {
    for length in 0..SMALL.len() {
        let cut = &SMALL[..length];
        assert_eq!(Places::find(cut).err(), Bank::open(cut).err());
    }
}

#[test]
fn places_of_other_bytes_lead_to_no_bank() {
    let newer = changed(SMALL, |bank| put(bank, 22, [9, 0]));
    assert!(Bank::open_at(&newer, &kept(SMALL)).is_none(), "another version");
    assert!(Bank::open_at(DRAMA, &kept(SMALL)).is_none());
    for length in 0..SMALL.len() {
        assert!(Bank::open_at(&SMALL[..length], &kept(SMALL)).is_none(), "{length}");
    }
}

/// Forged places are harmless: they lead to other bytes of the bank, or to nothing.
#[test]
fn forged_places_are_harmless() {
    let mut random = Random(16);
    let right = kept(SMALL).to_words();
    for _ in 0..3000 {
        let mut words = right;
        for _ in 0..=random.below(4) {
            let word = &mut words[2 + random.below(Places::WORDS - 2)];
            *word = match random.below(3) {
                0 => *word ^ 1 << random.below(12),
                1 => random.below(SMALL.len() + 2) as u32,
                _ => random.next_u64() as u32,
            };
        }
        let bank = Bank::open_at(SMALL, &Places::from_words(words)).expect("the same bytes");
        every_query(&bank, Effort::Few);
        let _ = bank.verify();
    }
}
