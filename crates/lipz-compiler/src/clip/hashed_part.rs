//! Bytes with a stored hash, for tables of bytes that are looked up long after they were made.

use super::Part;
use std::hash::{Hash, Hasher};

/// Bytes with their [`hash`](crate::util::hash::hash). A lookup reads them only if others have the same hash.
#[derive(PartialEq, Eq)]
pub(crate) struct HashedPart<'b> {
    pub(crate) hash: u64,
    pub(crate) bytes: Part<'b>,
}

impl Hash for HashedPart<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash);
    }
}
