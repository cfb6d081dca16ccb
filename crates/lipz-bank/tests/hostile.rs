//! Damaged and forged banks: nothing panics, nothing reads outside the bytes, and every change is detected.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::Bank;
use lipz_layout::Tag;
use lipz_testkit::exercise::{Effort, every_query, provoke, verified_is_whole};
use lipz_testkit::golden::{
    CURVES, Random, SMALL, STRIPPED, WIDE, changed, directory, put, refusal, reseal, section, u32_at,
};
use std::ops::Range;

/// The step between changes, because interpreted and emulated runs only have time for a sample.
const STEP: usize = match () {
    () if cfg!(miri) => 997,
    () if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) => 1,
    () => 61,
};

/// Runs `work` on parts of `range`, one thread per core.
fn in_parallel(range: Range<usize>, work: impl Fn(usize) + Sync) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for thread in 0..threads {
            let (range, work) = (range.clone(), &work);
            scope.spawn(move || range.skip(thread).step_by(threads).for_each(work));
        }
    });
}

#[test]
fn every_truncation() {
    for bank in [SMALL, STRIPPED, &WIDE[..2000]] {
        for length in (0..bank.len()).step_by(STEP) {
            assert!(refusal(&bank[..length]).is_some(), "{length} bytes");
            // The header of a forger: correct length and checksum.
            let mut forged = bank[..length].to_vec();
            if length >= 64 {
                put(&mut forged, 16, (length as u32).to_le_bytes());
                reseal(&mut forged);
            }
            provoke(&forged, Effort::Few);
        }
    }
}

#[test]
fn appended_bytes_are_noticed() {
    for length in [1, 3, 64, 4096] {
        let mut longer = SMALL.to_vec();
        longer.resize(SMALL.len() + length, 0);
        assert!(refusal(&longer).is_some());
    }
}

/// `verify` detects each of the 255 other values of each byte. Before it, no query panics.
#[test]
fn every_change_of_a_byte() {
    in_parallel(0..SMALL.len(), |at| {
        let mut bytes = SMALL.to_vec();
        for change in (1..=255).step_by(STEP) {
            bytes[at] = SMALL[at] ^ change;
            if let Ok(bank) = Bank::open(&bytes) {
                every_query(&bank, Effort::Few);
                assert!(bank.verify().is_err(), "byte {at} ^ {change:#x} goes unnoticed");
            }
        }
    });
}

/// The same with a corrected checksum: `verify` decides, and each bank that passes answers every query.
#[test]
fn every_forged_byte() {
    let of_curves = section(CURVES, Tag::CURVE_CLIPS).start..section(CURVES, Tag::CURVE_KEYS).end;
    for (original, range) in [(SMALL, 16..SMALL.len()), (CURVES, of_curves)] {
        in_parallel(range, |at| {
            let mut bytes = original.to_vec();
            for change in (1..=255).step_by(STEP) {
                bytes[at] = original[at] ^ change;
                reseal(&mut bytes);
                if let Ok(bank) = Bank::open(&bytes).and_then(Bank::verify) {
                    every_query(&bank, Effort::Few);
                    verified_is_whole(&bank);
                }
            }
        });
    }
}

/// Changes every number in the sections of curves, verified or not.
#[test]
fn every_forged_field_of_curves() {
    for range in [Tag::CURVE_CLIPS, Tag::CURVES, Tag::CURVE_KEYS].map(|tag| section(CURVES, tag)) {
        in_parallel(range.start / 4..range.end / 4, |word| {
            for number in interesting(CURVES, u32_at(CURVES, word * 4)).into_iter().step_by(STEP) {
                provoke(&changed(CURVES, |bytes| put(bytes, word * 4, number.to_le_bytes())), Effort::Few);
            }
        });
    }
}

/// Returns numbers that are likely to cause errors.
fn interesting(bytes: &[u8], old: u32) -> Vec<u32> {
    let length = bytes.len() as u32;
    let mut numbers = vec![0, 1, 2, 0xFF, 0xFFFF, 0x1_0000, 1 << 30, (1 << 31) - 1, 1 << 31, (1 << 31) + 1];
    numbers.extend([u32::MAX - 1, u32::MAX, length - 1, length, length + 1]);
    numbers.extend([old.wrapping_sub(1), old.wrapping_add(1), old.wrapping_mul(2), old.wrapping_neg(), !old]);
    for entry in directory(SMALL) {
        let (offset, size) = (entry.offset_bytes.get(), entry.length_bytes.get());
        numbers.extend([offset, size, size / 4, size + 1, length.wrapping_sub(offset)]);
    }
    numbers
}

/// Changes every 32-bit or 16-bit field of header, directory and records, all of which are aligned. The pools after the
/// records only get the 32-bit numbers.
#[test]
fn every_forged_field() {
    let records_end = section(SMALL, Tag::RATES).end;
    in_parallel(4..SMALL.len() / 4, |word| {
        let at = word * 4;
        let mut numbers = interesting(SMALL, u32_at(SMALL, at));
        numbers.sort_unstable();
        numbers.dedup();
        for number in numbers.into_iter().step_by(STEP) {
            let is_record = at < records_end;
            let bytes = changed(SMALL, |bytes| put(bytes, at, number.to_le_bytes()));
            provoke(&bytes, if is_record { Effort::All } else { Effort::Few });
            for half in [at, at + 2].into_iter().filter(|_| is_record && number <= 0xFFFF) {
                provoke(&changed(SMALL, |bytes| put(bytes, half, (number as u16).to_le_bytes())), Effort::Few);
            }
        }
    });
}

/// Cuts off each section at every point, and moves each towards the end of the file.
#[test]
fn every_shortened_section() {
    for index in 0..directory(SMALL).len() {
        let entry = 64 + 16 * index;
        let length = u32_at(SMALL, entry + 8);
        for shorter in (0..length).step_by(STEP) {
            provoke(&changed(SMALL, |bytes| put(bytes, entry + 8, shorter.to_le_bytes())), Effort::Few);
            let by = length - shorter;
            let moved = u32_at(SMALL, entry + 4) + by;
            provoke(&changed(SMALL, |bytes| put(bytes, entry + 4, moved.to_le_bytes())), Effort::Few);
        }
    }
}

/// Makes several changes at once: bytes, numbers, copied ranges, swapped sections.
#[test]
fn forged_at_random() {
    in_parallel(0..20_000 / STEP, |seed| {
        let mut random = Random(seed as u64);
        let mut bytes = if seed % 2 == 0 { SMALL } else { STRIPPED }.to_vec();
        for _ in 0..=random.below(6) {
            one_change(&mut bytes, &mut random);
        }
        reseal(&mut bytes);
        provoke(&bytes, Effort::Few);
    });
}

fn one_change(bytes: &mut [u8], random: &mut Random) {
    // Half of the changes are in the clip records and the directory, which are trusted most.
    let end = if random.below(2) == 0 { section(STRIPPED, Tag::RATES).end } else { bytes.len() };
    let at = random.below(end - 64).max(16);
    match random.below(5) {
        0 => bytes[at] = random.next_u64() as u8,
        1 => {
            let numbers = interesting(bytes, u32_at(bytes, at / 4 * 4));
            put(bytes, at / 4 * 4, numbers[random.below(numbers.len())].to_le_bytes());
        }
        2 => {
            let from = random.below(bytes.len() - 64);
            bytes.copy_within(from..from + 1 + random.below(64), at);
        }
        3 => {
            let entries = directory(STRIPPED).len();
            let (a, b) = (64 + 16 * random.below(entries), 64 + 16 * random.below(entries));
            for byte in 4..12 {
                bytes.swap(a + byte, b + byte);
            }
        }
        _ => put(bytes, at / 4 * 4, (random.next_u64() as u32).to_le_bytes()),
    }
}

/// Bytes that were never a bank.
#[test]
fn noise() {
    let mut random = Random(7);
    for length in 0..600 {
        let mut bytes: Vec<u8> = (0..length).map(|_| random.next_u64() as u8).collect();
        assert!(refusal(&bytes).is_some());
        // After a valid header, so that the directory is noise as well.
        if length >= 64 {
            bytes[..64].copy_from_slice(&SMALL[..64]);
            put(&mut bytes, 16, (length as u32).to_le_bytes());
            reseal(&mut bytes);
            provoke(&bytes, Effort::Few);
        }
    }
}
