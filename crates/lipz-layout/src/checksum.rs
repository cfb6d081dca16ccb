//! The checksum of format 1: XXH64 with seed 0, of the bytes and the padding of their last stripe.
//!
//! It is the hash of <https://github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md>, for which most languages have a
//! library. Only whole stripes are hashed, because the code for a remainder would be longer than all of this.
//!
//! Each step can be inverted if its input word is known. A change of one word of eight bytes is therefore always
//! detected, and one in 2⁶⁴ of all other changes is missed. A word is multiplied before it is added, so that changes
//! that cancel out look like noise. Sums of words would miss +1, −2, +1.
//! goes unnoticed, and of other changes one in 2⁶⁴. A word is multiplied before it is added: changes that cancel out
//! look like noise, where sums of words let +1, −2, +1 pass.

/// The bytes that the lanes hash at a time.
const STRIPE: usize = 32;
/// Masks the part of a length that is less than a stripe.
const REST: u64 = 31;

const PRIME_1: u64 = 0x9E37_79B1_85EB_CA87;
const PRIME_2: u64 = 0xC2B2_AE3D_27D4_EB4F;
const PRIME_3: u64 = 0x1656_67B1_9E37_79F9;
const PRIME_4: u64 = 0x85EB_CA77_C2B2_AE63;
/// Follows the bytes, and is followed by zeros, so that different inputs never have the same padded form.
const END: u8 = 1;

/// The initial values of the lanes.
const START: [u64; 4] = [PRIME_1.wrapping_add(PRIME_2), PRIME_2, 0, PRIME_1.wrapping_neg()];

/// Returns the checksum of `bytes` in format 1.
pub fn checksum(bytes: &[u8]) -> u64 {
    let rest = bytes.chunks_exact(STRIPE).remainder();
    let mut last = [0; STRIPE];
    // The rest is shorter than a stripe.
    if let Some(start) = last.get_mut(..rest.len()) {
        start.copy_from_slice(rest);
    }
    if let Some(end) = last.get_mut(rest.len()) {
        *end = END;
    }
    let mut lanes = START;
    let mut left = bytes;
    // Two stripes per round where code is cheap, because the lanes stay in their registers.
    if cfg!(target_pointer_width = "64") {
        let pairs = bytes.chunks_exact(STRIPE * 2);
        left = pairs.remainder();
        for pair in pairs {
            let (stripe, next) = pair.split_at(STRIPE);
            add(&mut lanes, stripe);
            add(&mut lanes, next);
        }
    }
    left.chunks_exact(STRIPE).for_each(|stripe| add(&mut lanes, stripe));
    add(&mut lanes, &last);
    mix(lanes, bytes.len() as u64)
}

/// A checksum of bytes that arrive in pieces.
#[derive(Clone, Debug)]
pub struct RunningChecksum {
    lanes: [u64; 4],
    /// The bytes that do not fill a stripe yet.
    last: [u8; STRIPE],
    length_bytes: u64,
}

impl Default for RunningChecksum {
    fn default() -> Self {
        RunningChecksum { lanes: START, last: [0; STRIPE], length_bytes: 0 }
    }
}

impl RunningChecksum {
    /// Adds the next bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        let filled = (self.length_bytes & REST) as usize;
        self.length_bytes = self.length_bytes.wrapping_add(bytes.len() as u64);
        let mut rest = bytes;
        if filled > 0 {
            let room = self.last.get_mut(filled..).unwrap_or_default();
            let (own, behind) = bytes.split_at(room.len().min(bytes.len()));
            room.iter_mut().zip(own).for_each(|(place, byte)| *place = *byte);
            if own.len() < room.len() {
                return;
            }
            add(&mut self.lanes, &self.last);
            rest = behind;
        }
        let stripes = rest.chunks_exact(STRIPE);
        let remainder = stripes.remainder();
        stripes.for_each(|stripe| add(&mut self.lanes, stripe));
        self.last.iter_mut().zip(remainder).for_each(|(place, byte)| *place = *byte);
    }

    /// Returns the checksum of all bytes.
    pub fn finish(mut self) -> u64 {
        let behind = self.last.iter_mut().skip((self.length_bytes & REST) as usize);
        behind.zip(core::iter::once(END).chain(core::iter::repeat(0))).for_each(|(place, byte)| *place = byte);
        add(&mut self.lanes, &self.last);
        mix(self.lanes, self.length_bytes)
    }
}

/// Combines the lanes to one number. `length_bytes` is the length without padding.
#[inline(always)]
fn mix(lanes: [u64; 4], length_bytes: u64) -> u64 {
    let [a, b, c, d] = lanes;
    let turned = a.rotate_left(1).wrapping_add(b.rotate_left(7)).wrapping_add(c.rotate_left(12));
    let mut hash = turned.wrapping_add(d.rotate_left(18));
    for lane in &lanes {
        hash = (hash ^ round(0, *lane)).wrapping_mul(PRIME_1).wrapping_add(PRIME_4);
    }
    hash = hash.wrapping_add((length_bytes | REST).wrapping_add(1));
    hash = (hash ^ (hash >> 33)).wrapping_mul(PRIME_2);
    hash = (hash ^ (hash >> 29)).wrapping_mul(PRIME_3);
    hash ^ (hash >> 32)
}

/// Adds a stripe.
#[cfg_attr(target_pointer_width = "64", inline(always))]
#[cfg_attr(not(target_pointer_width = "64"), inline(never))]
fn add(lanes: &mut [u64; 4], stripe: &[u8]) {
    for (lane, word) in lanes.iter_mut().zip(stripe.chunks_exact(8)) {
        *lane = round(*lane, number(word));
    }
}

/// Returns a lane after adding a word.
#[cfg_attr(target_pointer_width = "64", inline(always))]
#[cfg_attr(not(target_pointer_width = "64"), inline(never))] // long code where 64-bit products are not instructions
fn round(lane: u64, word: u64) -> u64 {
    lane.wrapping_add(word.wrapping_mul(PRIME_2)).rotate_left(31).wrapping_mul(PRIME_1)
}

/// Returns the little-endian number in eight bytes.
#[inline(always)]
fn number(bytes: &[u8]) -> u64 {
    let mut word = [0; 8];
    word.copy_from_slice(bytes);
    u64::from_le_bytes(word)
}
