//! The checksum of banks, compared with an independent XXH64, and tested with systematic changes.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::cast_possible_truncation, reason = "tests")]

use lipz_layout::{CHECKED_FROM, RunningChecksum, checksum};
use proptest::prelude::*;
use twox_hash::XxHash64;

const DRAMA: &[u8] = include_bytes!("../../../fixtures/banks/v1/drama.lipzbank");

#[test]
fn it_is_xxh64_of_the_padded_bytes() {
    for length in (0..300).chain([4095, 4096, 4097, DRAMA.len()]) {
        let mut padded = DRAMA[..length].to_vec();
        padded.push(1);
        padded.resize(padded.len().next_multiple_of(32), 0);
        assert_eq!(checksum(&DRAMA[..length]), XxHash64::oneshot(0, &padded), "{length} bytes");
    }
}

#[test]
fn pieces_have_the_checksum_of_the_whole() {
    for length in (0..300).chain([DRAMA.len()]) {
        for at_once in [1, 7, 31, 32, 33, 100, 4096] {
            let mut running = RunningChecksum::default();
            DRAMA[..length].chunks(at_once).for_each(|piece| running.add(piece));
            assert_eq!(running.finish(), checksum(&DRAMA[..length]), "{length} bytes, {at_once} at once");
        }
    }
}

/// Adds the numbers to bytes `stride` apart, starting at `start`.
fn with_added(bytes: &[u8], start: usize, stride: usize, numbers: &[i8]) -> Vec<u8> {
    let mut changed = bytes.to_vec();
    for (at, number) in (start..).step_by(stride).zip(numbers) {
        changed[at] = changed[at].wrapping_add_signed(*number);
    }
    changed
}

/// Fletcher's sums did not detect three changed visemes 32 bytes apart: +1, -2, +1. Sums of higher orders miss similar
/// changes.
#[test]
fn small_changes_at_equal_distances_do_not_cancel_out() {
    let bytes = &DRAMA[CHECKED_FROM..8192];
    let own = checksum(bytes);
    let differences: [&[i8]; 9] = [
        &[1, -1],
        &[1, 1],
        &[-128, -128],
        &[64, -128, 64],
        &[1, -2, 1],
        &[1, -3, 3, -1],
        &[1, -4, 6, -4, 1],
        &[1, -1, -1, 1],
        &[1, 0, -2, 0, 1],
    ];
    for stride in [1, 2, 4, 8, 16, 24, 32, 40, 64, 128, 256, 512, 1024] {
        for numbers in differences {
            for start in (0..64).chain([1000, 2001, 3002]) {
                let changed = with_added(bytes, start, stride, numbers);
                assert_ne!(checksum(&changed), own, "{numbers:?} every {stride} from {start}");
            }
        }
    }
}

/// The same bits of any two words, and two exchanged words.
#[test]
fn no_two_words_cancel_out() {
    let bytes = &DRAMA[CHECKED_FROM..1040];
    let own = checksum(bytes);
    for first in (0..bytes.len()).step_by(8) {
        for second in (first + 8..bytes.len()).step_by(8) {
            for bit in [0, 7, 31, 32, 62, 63] {
                let mut changed = bytes.to_vec();
                changed[first + bit / 8] ^= 1 << (bit % 8);
                changed[second + bit / 8] ^= 1 << (bit % 8);
                assert_ne!(checksum(&changed), own, "bit {bit} of {first} and {second}");
            }
            let mut changed = bytes.to_vec();
            (0..8).for_each(|at| changed.swap(first + at, second + at));
            assert!(changed == bytes || checksum(&changed) != own, "{first} and {second} exchanged");
        }
    }
}

/// The three bytes of a golden bank whose change `verify` missed.
#[test]
fn three_mouth_shapes_of_a_bank_are_noticed() {
    let places = (0..DRAMA.len() - 64).filter(|at| [0, 32, 64].map(|behind| DRAMA[at + behind]) == *b"EUE");
    let start = places.min().unwrap();
    let bank = with_added(DRAMA, start, 32, &[1, -2, 1]);
    assert_eq!([0, 32, 64].map(|behind| bank[start + behind]), *b"FSF");
    let error = lipz_bank::Bank::open(&bank).and_then(lipz_bank::Bank::verify).unwrap_err();
    assert_eq!(error.kind(), lipz_bank::ErrorKind::Checksum);
}

proptest! {
    #[test]
    fn random_changes_are_noticed(
        bytes in prop::collection::vec(any::<u8>(), 1..600),
        changes in prop::collection::vec((any::<prop::sample::Index>(), 1_u8..), 1..6),
    ) {
        let mut changed = bytes.clone();
        for (at, difference) in &changes {
            changed[at.index(bytes.len())] ^= difference;
        }
        prop_assert!(changed == bytes || checksum(&changed) != checksum(&bytes));
        prop_assert_ne!(checksum(&bytes), checksum(&bytes[..bytes.len() - 1]));
    }
}
