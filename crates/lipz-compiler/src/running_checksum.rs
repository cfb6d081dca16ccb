//! The checksum of a bank whose bytes come piece by piece.

use std::hash::Hasher;
use twox_hash::XxHash64;

/// Bytes that the checksum takes at a time.
const STRIPE: u64 = 32;

/// The checksum of the bytes so far.
pub(crate) struct RunningChecksum {
    hasher: XxHash64,
    length_bytes: u64,
}

impl RunningChecksum {
    /// That of no bytes.
    pub(crate) fn new() -> RunningChecksum {
        RunningChecksum { hasher: XxHash64::with_seed(0), length_bytes: 0 }
    }

    /// Takes in what comes next.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.hasher.write(bytes);
        self.length_bytes += bytes.len() as u64;
    }

    /// The checksum of all of them.
    pub(crate) fn finish(mut self) -> u64 {
        // What stands behind the bytes, as `docs/FORMAT.md` has it.
        let mut rest = vec![1];
        rest.resize(((self.length_bytes + 1).next_multiple_of(STRIPE) - self.length_bytes) as usize, 0);
        self.hasher.write(&rest);
        self.hasher.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_have_the_checksum_of_the_whole() {
        let bytes: Vec<u8> = (0..300_u32).map(|number| (number * 7) as u8).collect();
        for (length, at_once) in (0..bytes.len()).flat_map(|length| [1, 31, 32, 100].map(|at_once| (length, at_once))) {
            let mut running = RunningChecksum::new();
            bytes[..length].chunks(at_once).for_each(|piece| running.add(piece));
            assert_eq!(running.finish(), lipz_layout::checksum(&bytes[..length]), "{length} bytes");
        }
    }
}
