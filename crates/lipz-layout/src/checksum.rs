//! The checksum of format 1: XXH64 with seed 0, of the bytes and what fills their last stripe.
//!
//! It is the hash of <https://github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md>, for which most languages have a
//! library. Whole stripes keep the code small: that of a rest would be longer than all of this.
//!
//! Each step can be undone if the word that it takes in is known. So a change of one word of eight bytes never
//! goes unnoticed, and of other changes one in 2⁶⁴. A word is multiplied before it is added: changes that cancel out
//! look like noise, where sums of words let +1, −2, +1 pass.

/// Bytes that the lanes take at a time.
const STRIPE: usize = 32;
/// The bits of a length that are less than a stripe.
const REST: u64 = 31;

const PRIME_1: u64 = 0x9E37_79B1_85EB_CA87;
const PRIME_2: u64 = 0xC2B2_AE3D_27D4_EB4F;
const PRIME_3: u64 = 0x1656_67B1_9E37_79F9;
const PRIME_4: u64 = 0x85EB_CA77_C2B2_AE63;
/// Stands behind the bytes, and zeros behind it: so no two inputs are filled to the same one.
const END: u8 = 1;

/// Folds `bytes` into the checksum of format 1.
pub fn checksum(bytes: &[u8]) -> u64 {
    let stripes = bytes.chunks_exact(STRIPE);
    let rest = stripes.remainder();
    let mut last = [0; STRIPE];
    // The rest is shorter than a stripe.
    if let Some(start) = last.get_mut(..rest.len()) {
        start.copy_from_slice(rest);
    }
    if let Some(end) = last.get_mut(rest.len()) {
        *end = END;
    }
    let mut lanes = [PRIME_1.wrapping_add(PRIME_2), PRIME_2, 0, PRIME_1.wrapping_neg()];
    for stripe in stripes {
        add(&mut lanes, stripe);
    }
    add(&mut lanes, &last);
    let [a, b, c, d] = lanes;
    let turned = a.rotate_left(1).wrapping_add(b.rotate_left(7)).wrapping_add(c.rotate_left(12));
    let mut hash = turned.wrapping_add(d.rotate_left(18));
    for lane in &lanes {
        hash = (hash ^ round(0, *lane)).wrapping_mul(PRIME_1).wrapping_add(PRIME_4);
    }
    let length_bytes = (bytes.len() as u64 | REST).wrapping_add(1);
    hash = hash.wrapping_add(length_bytes);
    hash = (hash ^ (hash >> 33)).wrapping_mul(PRIME_2);
    hash = (hash ^ (hash >> 29)).wrapping_mul(PRIME_3);
    hash ^ (hash >> 32)
}

/// Takes in a stripe.
#[cfg_attr(target_pointer_width = "64", inline(always))]
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
fn add(lanes: &mut [u64; 4], stripe: &[u8]) {
    for (lane, word) in lanes.iter_mut().zip(stripe.chunks_exact(8)) {
        *lane = round(*lane, number(word));
    }
}

/// What a lane becomes with a word.
#[cfg_attr(target_pointer_width = "64", inline(always))]
#[cfg_attr(not(target_pointer_width = "64"), inline(never))] // long code where 64-bit products are not instructions
fn round(lane: u64, word: u64) -> u64 {
    lane.wrapping_add(word.wrapping_mul(PRIME_2)).rotate_left(31).wrapping_mul(PRIME_1)
}

/// The little-endian number in eight bytes.
#[inline(always)]
fn number(bytes: &[u8]) -> u64 {
    let mut word = [0; 8];
    word.copy_from_slice(bytes);
    u64::from_le_bytes(word)
}
