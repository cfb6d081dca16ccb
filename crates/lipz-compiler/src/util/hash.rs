//! The hash of bytes, the same for all threads of a process.

use foldhash::fast::RandomState;
use std::hash::BuildHasher;
use std::sync::LazyLock;

/// Shared by all threads. Seeded randomly in each process, so that texts with equal hashes cannot be prepared.
static HASHER: LazyLock<RandomState> = LazyLock::new(RandomState::default);

/// Returns the hash of `bytes`, to be stored with them.
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    HASHER.hash_one(bytes)
}
