//! Packing on several machines: a plan, an object for each of its shards, and the bank linked from them.
//!
//! A shard contains the lines whose ids are in its range of ids. Therefore, a clip stays in its shard when other clips
//! are added or removed, and is in the same shard as its dubs. Each step is a function of files that the plan lists
//! with the hashes of their contents.

mod changed;
mod export;
mod hash;
mod link;
mod linked_object;
mod misfits;
mod object;
mod object_clips;
mod plan;
mod reading;
mod set;
mod set_files;
mod wire;

pub use hash::ContentHash;
pub use link::Link;
pub use linked_object::LinkedObject;
pub use object::Shard;
pub use plan::{CommonInputs, ExtraInputs, Plan, PlannedFile, PlannedShard, ShardPlan, Step, plan};
pub use set::LinkedSet;
pub use set_files::SetFiles;
pub use wire::WireReport;

use crate::project::Voices;
use lipz_bank::ClipId;
use std::num::NonZero;

/// The most shards of a plan.
pub const MAX_SHARDS: u16 = 4096;

/// The extension of objects, without a dot.
pub const OBJECT_EXTENSION: &str = "lipzobj";

/// The extension of files with the visemes of a shard, without a dot.
pub const MOUTHS_EXTENSION: &str = "lipzmouths";

/// The extension of indexes of sets, without a dot.
pub const SET_EXTENSION: &str = "lipzset";

/// Returns the shard of the clip with this key: that of the [id](shard_of) of its line, so that dubs are in the same
/// shard as their original. The line of a clip that is neither is its key.
///
/// ```
/// use lipz_compiler::Voices;
/// use lipz_compiler::shard::shard_of_key;
/// let many = std::num::NonZero::new(4096).unwrap();
/// let voices = Voices::new("en-us")?.dub("de-de", "de/{key}")?;
/// assert_eq!(shard_of_key("de/act1/hello", &voices, many), shard_of_key("act1/hello", &voices, many));
/// # Ok::<(), lipz_compiler::VoiceError>(())
/// ```
pub fn shard_of_key(key: &str, voices: &Voices, shards: NonZero<u16>) -> u16 {
    shard_of(ClipId::from_key(voices.line_of(key)), shards)
}

/// Returns the shard of an id: its top bits, or in proportion if the number of shards is not a power of two.
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
