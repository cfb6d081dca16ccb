//! Packing on several machines: a plan, an object for each of its shards, and the bank that they are linked to.
//!
//! A shard has the clips whose ids lie in its part of all ids, so that a clip stays in its shard when others come and
//! go. Each step is a function of files that the plan names with the hashes of their contents.

mod changed;
mod export;
mod hash;
mod link;
mod object;
mod plan;
mod reading;
mod wire;

pub use hash::ContentHash;
pub use link::{Link, LinkedObject};
pub use object::Shard;
pub use plan::{Common, Plan, PlannedFile, PlannedShard, ShardPlan, plan};

use lipz_bank::ClipId;
use std::num::NonZero;

/// The most shards of a plan.
pub const MAX_SHARDS: u16 = 4096;

/// What the names of objects end with, behind a dot.
pub const OBJECT_EXTENSION: &str = "lipzobj";

/// The shard of so many to which a clip belongs: the top bits of its id, for numbers that are no power of two in proportion.
///
/// ```
/// use lipz_bank::ClipId;
/// use lipz_compiler::shard::shard_of;
/// let id = ClipId::from_key("act1/samson-hello"); // ffff95a90441eeda
/// let two = std::num::NonZero::new(2).unwrap();
/// assert_eq!(shard_of(id, two), 1);
/// ```
pub fn shard_of(id: ClipId, shards: NonZero<u16>) -> u16 {
    lipz_layout::shard_of(id.get(), u32::from(shards.get())) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_take_the_top_bits_and_shards_ascend_with_ids() {
        let at = |id: u64, shards: u16| shard_of(ClipId::from_u64(id), NonZero::new(shards).unwrap());
        for id in (0..u64::MAX).step_by(usize::MAX / 1000) {
            assert_eq!(at(id, 64), (id >> 58) as u16);
            assert!(at(id, 3) <= at(id.saturating_add(usize::MAX as u64 / 1000), 3));
        }
        assert_eq!((at(u64::MAX, MAX_SHARDS), at(u64::MAX, 7), at(0, 7), at(u64::MAX, 1)), (4095, 6, 0, 0));
    }
}
