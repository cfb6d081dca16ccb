//! Estimating which hashes occur more than once, without storing them.

/// The bits per hash. One in fifteen of the hashes that occur once appears as repeated.
const BITS_PER_HASH: usize = 16;

/// The most bits in total, shared by more hashes, so that they stay in a cache.
const MOST_BITS: usize = 1 << 26;

/// Hashes, most of which occur once. The data for all of them is small, because a table of all hashes would take many
/// times as long: each lookup would wait for memory.
pub(super) struct RepeatedHashes {
    seen: Vec<u64>,
    again: Vec<u64>,
}

impl RepeatedHashes {
    /// Creates an empty set for this number of hashes.
    pub(super) fn among(count: usize) -> RepeatedHashes {
        let words = count.saturating_mul(BITS_PER_HASH).min(MOST_BITS).next_power_of_two().div_ceil(64);
        RepeatedHashes { seen: vec![0; words], again: vec![0; words] }
    }

    /// Adds a hash.
    pub(super) fn add(&mut self, hash: u32) {
        let (word, bit) = self.place(hash);
        self.again[word] |= self.seen[word] & bit;
        self.seen[word] |= bit;
    }

    /// Whether a hash may have been added more than once. It has no false negatives.
    pub(super) fn has(&self, hash: u32) -> bool {
        let (word, bit) = self.place(hash);
        self.again[word] & bit != 0
    }

    /// Returns the index of the word with the bit of a hash, and the bit. The number of words is a power of two.
    fn place(&self, hash: u32) -> (usize, u64) {
        ((hash / 64) as usize & (self.seen.len() - 1), 1 << (hash % 64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_added_twice_is_found_and_little_else() {
        for count in [0, 1, 2, 3, 1000, 50_000] {
            let hashes: Vec<u32> = (0..count).map(|number: u32| number.wrapping_mul(0x9E37_79B1)).collect();
            let mut repeated = RepeatedHashes::among(hashes.len());
            hashes.iter().for_each(|hash| repeated.add(*hash));
            let found = hashes.iter().filter(|hash| repeated.has(**hash)).count();
            assert!(found <= hashes.len() / 10, "{found} of {count}");
            hashes.iter().step_by(7).for_each(|hash| repeated.add(*hash));
            assert!(hashes.iter().step_by(7).all(|hash| repeated.has(*hash)));
        }
    }
}
