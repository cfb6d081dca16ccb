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

/// What the lanes start with.
const START: [u64; 4] = [PRIME_1.wrapping_add(PRIME_2), PRIME_2, 0, PRIME_1.wrapping_neg()];

/// Folds `bytes` into the checksum of format 1.
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
    // Two stripes per round where code is cheap: the lanes stay in their registers.
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

/// The checksum of bytes that come piece by piece.
#[derive(Clone, Debug)]
pub struct RunningChecksum {
    lanes: [u64; 4],
    /// What does not fill a stripe yet.
    last: [u8; STRIPE],
    length_bytes: u64,
}

impl Default for RunningChecksum {
    fn default() -> Self {
        RunningChecksum { lanes: START, last: [0; STRIPE], length_bytes: 0 }
    }
}

impl RunningChecksum {
    /// Takes in what comes next.
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

    /// The checksum of all of them.
    pub fn finish(mut self) -> u64 {
        let behind = self.last.iter_mut().skip((self.length_bytes & REST) as usize);
        behind.zip(core::iter::once(END).chain(core::iter::repeat(0))).for_each(|(place, byte)| *place = byte);
        add(&mut self.lanes, &self.last);
        mix(self.lanes, self.length_bytes)
    }
}

/// Makes one number of the lanes, which have taken in so many bytes and what fills their last stripe.
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
