//! Which hashes there are more than once, as far as one sees that without keeping them.

/// Bits for each hash: of those that are there once, one in fifteen looks as if it were there again.
const BITS_PER_HASH: usize = 16;

/// Most bits, which then have more hashes: they are to stay in a cache.
const MOST_BITS: usize = 1 << 26;

/// Hashes of which most are there once. What is asked for all of them is kept small: a table of all hashes takes many
/// times the time, because each look into it waits for memory.
pub(super) struct Repeated {
    seen: Vec<u64>,
    again: Vec<u64>,
}

impl Repeated {
    /// None of so many hashes yet.
    pub(super) fn among(count: usize) -> Repeated {
        let words = count.saturating_mul(BITS_PER_HASH).min(MOST_BITS).next_power_of_two().div_ceil(64);
        Repeated { seen: vec![0; words], again: vec![0; words] }
    }

    /// Adds a hash.
    pub(super) fn add(&mut self, hash: u32) {
        let (word, bit) = self.place(hash);
        self.again[word] |= self.seen[word] & bit;
        self.seen[word] |= bit;
    }

    /// Whether a hash may have been added more than once. If it was, it may.
    pub(super) fn has(&self, hash: u32) -> bool {
        let (word, bit) = self.place(hash);
        self.again[word] & bit != 0
    }

    /// The word with the bit of a hash, and the bit. There are as many words as a power of two.
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
            let mut repeated = Repeated::among(hashes.len());
            hashes.iter().for_each(|hash| repeated.add(*hash));
            let found = hashes.iter().filter(|hash| repeated.has(**hash)).count();
            assert!(found <= hashes.len() / 10, "{found} of {count}");
            hashes.iter().step_by(7).for_each(|hash| repeated.add(*hash));
            assert!(hashes.iter().step_by(7).all(|hash| repeated.has(*hash)));
        }
    }
}
