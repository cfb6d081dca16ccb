//! Clip ids: test vectors for other implementations, and tests of their distribution.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::ClipId;
use std::collections::HashSet;

/// The same vectors are in `docs/reference/bank-format.md`, for readers in other languages.
#[test]
fn vectors() {
    let vectors: [(&str, u64); 8] = [
        ("", 0),
        ("a", 0xdcf4_321d_1ec2_a02d),
        ("act1/abc", 0x9d11_056a_76f2_5b0e),
        ("act1/abcd", 0x1049_d8c4_f6b0_b054),
        ("act1/samson-hello", 0xffff_95a9_0441_eeda),
        ("act1/mara-good-evening", 0x6ce3_03e9_2778_96db),
        ("行", 0xb978_4075_49c4_75c1),
        ("0123456789abcdef", 0x1b82_c83d_851d_0470),
    ];
    for (key, id) in vectors {
        assert_eq!(ClipId::from_key(key).get(), id, "{key}");
    }
}

#[test]
fn the_same_while_compiling() {
    const ID: ClipId = ClipId::from_key("act1/samson-hello");
    static TABLE: [ClipId; 2] = [ID, ClipId::from_key("行")];
    let key = String::from("act1/samson-") + "hello";
    assert_eq!(TABLE, [ClipId::from_key(&key), ClipId::from_u64(0xb978_4075_49c4_75c1)]);
    assert_eq!(format!("{ID} {ID:?}"), "ffff95a90441eeda ClipId(0xffff95a90441eeda)");
}

/// Returns keys as in real projects: folders, speakers, and numbers that differ in few bits.
fn keys() -> impl Iterator<Item = String> {
    let count: u32 = if cfg!(miri) { 1_000 } else { 1_000_000 };
    (0..count).map(|n| match n % 4 {
        0 => format!("act{}/scene-{}/mara-{:05}", n % 9, n % 89, n),
        1 => format!("{n}"),
        2 => format!("vo/{}/{n:x}", ["mara", "otto", "nell", "ivo"][n as usize / 4 % 4]),
        _ => format!("quests/the-parcel-for-the-light/node_{n}_female_player_variant"),
    })
}

#[test]
fn a_million_keys_are_distinct() {
    let mut seen = HashSet::new();
    for key in keys() {
        assert!(seen.insert(ClipId::from_key(&key)), "{key}");
    }
}

/// Keys that differ only in length or in trailing spaces.
#[test]
fn length_counts() {
    let mut seen = HashSet::new();
    for filler in ["\0", " ", "a", "-"] {
        for length in 1..100 {
            assert!(seen.insert(ClipId::from_key(&filler.repeat(length))), "{length} times {filler:?}");
        }
    }
}

/// Each bit is set in half of the ids, within five standard deviations.
#[test]
#[cfg_attr(miri, ignore)]
fn every_bit_is_set_half_of_the_time() {
    let mut set = [0_u32; 64];
    let mut count = 0_u32;
    for key in keys() {
        let id = ClipId::from_key(&key).get();
        for (bit, set) in set.iter_mut().enumerate() {
            *set += u32::from(id >> bit & 1 == 1);
        }
        count += 1;
    }
    let allowed = 5.0 * (f64::from(count) / 4.0).sqrt();
    for (bit, set) in set.iter().enumerate() {
        let off = (f64::from(*set) - f64::from(count) / 2.0).abs();
        assert!(off < allowed, "bit {bit}: {set} of {count}");
    }
}

/// A change of one bit of the key changes each bit of the id half of the time, on average.
#[test]
#[cfg_attr(miri, ignore)]
fn every_bit_of_the_key_reaches_every_bit_of_the_id() {
    for length in [2_usize, 7, 8, 9, 16, 23] {
        for flipped in 0..length * 7 {
            let (byte, bit) = (flipped / 7, flipped % 7);
            let mut changes = [0_u32; 64];
            let rounds = 1000_u32;
            for round in 0..rounds {
                let mut key: Vec<u8> = (0..length).map(|at| mix(round, at) & 0x7F).collect();
                let before = id(&key);
                key[byte] ^= 1 << bit;
                let difference = before ^ id(&key);
                changes.iter_mut().enumerate().for_each(|(bit, count)| *count += (difference >> bit & 1) as u32);
            }
            // One-byte keys have only 128 values, and so few distinct pairs: a wide tolerance.
            assert!(
                changes.iter().all(|&count| (300..700).contains(&count)),
                "{length} bytes, {byte}.{bit}: {changes:?}"
            );
        }
    }
}

fn id(key: &[u8]) -> u64 {
    std::str::from_utf8(key).map_or(0, |key| ClipId::from_key(key).get())
}

fn mix(round: u32, at: usize) -> u8 {
    ((round.wrapping_mul(0x9E37_79B9) ^ (at as u32).wrapping_mul(0x85EB_CA6B)).wrapping_mul(0xC2B2_AE35) >> 24) as u8
}
