//! The origin of a handle: a bank or a dialogue.

use lipz_layout::Header;
use lipz_types::hash::{FINISH, STEP, mix};

/// The bank or the dialogue that a handle comes from, as 32 bits made of checksums. These differ between files of
/// different contents.
///
/// Each bit of a checksum depends on all of the contents. A forged bank can have any checksum: a handle then leads to
/// wrong contents, but never out of the bank.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) struct Origin(u32);

impl Origin {
    /// An origin that no handle has.
    pub(crate) const NONE: Origin = Origin(0);

    /// Returns the origin from a stored number.
    pub(crate) const fn from_u32(number: u32) -> Origin {
        Origin(number)
    }

    /// Returns a number to store.
    pub(crate) const fn to_u32(self) -> u32 {
        self.0
    }

    /// Returns the origin of the file with this header.
    #[inline]
    pub(crate) fn of_file(header: &Header) -> Origin {
        Origin::of_hash(header.checksum.get())
    }

    /// Returns the origin of the files whose checksums have this hash.
    #[inline]
    pub(crate) fn of_hash(hash: u64) -> Origin {
        Origin((hash as u32).max(1))
    }

    /// Returns the origin of handles into the list with this hash.
    #[inline]
    pub(crate) fn with_list(self, list: u32) -> Origin {
        Origin(self.0 ^ list)
    }
}

/// Adds a checksum to the hash of those before it.
pub(crate) fn add_checksum(hash: u64, checksum: u64) -> u64 {
    mix(mix(hash, STEP) ^ checksum, FINISH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_are_never_none() {
        assert_ne!(Origin::of_hash(1 << 32), Origin::NONE);
        assert_ne!(Origin::of_hash(7).with_list(1), Origin::of_hash(7).with_list(2));
        assert_ne!(add_checksum(add_checksum(0, 1), 2), add_checksum(add_checksum(0, 2), 1));
    }
}
