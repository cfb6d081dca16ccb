//! Bytes that know their hash, for tables of bytes that are met again long after they were made.

use crate::clip::Part;
use foldhash::fast::RandomState;
use std::hash::{BuildHasher, Hash, Hasher};
use std::sync::LazyLock;

/// The same for all threads; seeded anew in each process, so that nobody can prepare texts of one hash.
static HASHER: LazyLock<RandomState> = LazyLock::new(RandomState::default);

/// The hash of `bytes`, to be kept for [`Hashed`].
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    HASHER.hash_one(bytes)
}

/// Bytes with their [`hash`]: looking them up does not read them, unless others have the same hash.
#[derive(PartialEq, Eq)]
pub(crate) struct Hashed<'b> {
    pub(crate) hash: u64,
    pub(crate) bytes: Part<'b>,
}

impl Hash for Hashed<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash);
    }
}
