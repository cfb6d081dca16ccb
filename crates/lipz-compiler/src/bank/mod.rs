//! Banks: made from clips, split, stacked, measured, and converted back to documents.

mod clip_weights;
pub(crate) mod coverage;
pub(crate) mod decompile;
pub(crate) mod dialogue;
pub(crate) mod layers;
pub(crate) mod lower;
pub(crate) mod source_index;
pub(crate) mod split;
#[cfg(feature = "unpack")]
mod unpack;
pub(crate) mod verify;
mod voice_coverage;

pub use clip_weights::ClipWeights;
pub(crate) use clip_weights::bake;
pub use coverage::{Coverage, coverage, shortfalls};
pub use decompile::Documents;
pub use layers::{Stack, VoiceBanks, dialogue_of};
pub use split::SplitBank;
#[cfg(feature = "unpack")]
pub use unpack::{Unpacked, unpack};
pub use voice_coverage::{VoiceCoverage, voice_coverage, voice_coverage_of};
