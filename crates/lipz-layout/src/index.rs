//! The clip index: a minimal perfect hash from clip id to slot.
//!
//! Ids are divided into buckets. Each bucket has a *pilot*, a number that the compiler chose so that all ids of the
//! bucket get different free slots ("hash, displace"; Fox, Chen and Heath, SIGIR 1992; Belazzougui, Botelho and
//! Dietzfelbinger, ESA 2009). A look-up reads one pilot and one key record, and has no loop.

use lipz_types::hash::{STEP, mix};

/// Bit of a pilot whose bucket has one id: the other bits are the slot itself.
pub const DIRECT_SLOT: u32 = 1 << 31;

/// Spreads an id over 64 bits, differently for each `seed`.
///
/// The seed is 0 unless no pilot can separate two ids of one bucket.
#[inline]
pub const fn spread(id: u64, seed: u64) -> u64 {
    mix(id ^ seed, STEP)
}

/// Returns the bucket of a spread id.
#[inline]
pub const fn bucket_of(spread: u64, bucket_count: u32) -> u32 {
    scale((spread >> 32) as u32, bucket_count)
}

/// Returns the slot of a spread id, given its bucket's pilot. Any number, if `pilot` does not come from a compiler.
#[inline]
pub const fn slot_of(spread: u64, pilot: u32, slot_count: u32) -> u32 {
    if pilot & DIRECT_SLOT != 0 {
        return pilot ^ DIRECT_SLOT;
    }
    let mixed = (spread as u32 ^ pilot.wrapping_mul(0x9E37_79B9)).wrapping_mul(0x85EB_CA6B);
    scale((mixed ^ (mixed >> 15)).wrapping_mul(0xC2B2_AE35), slot_count)
}

/// Returns the shard of a clip, below `shard_count`: the top bits of its id, so that shards ascend with ids, and
/// doubling the count divides each shard in two.
#[inline]
pub const fn shard_of(id: u64, shard_count: u32) -> u32 {
    scale((id >> 32) as u32, shard_count)
}

/// Maps 0 up to, but not including, 2³² evenly onto 0 up to, but not including, `count`, without division.
#[inline]
const fn scale(value: u32, count: u32) -> u32 {
    ((value as u64).wrapping_mul(count as u64) >> 32) as u32
}
