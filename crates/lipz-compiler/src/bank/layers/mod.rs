//! Layers: patches, downloads and mods on top of a bank or a set, and merging them into one bank.
//!
//! A layer is the difference between two whole banks. This guarantees by construction that the answers of the reader,
//! the merged bank of a stack, and the bank packed from the sources in one go are the same: `merge` makes a whole bank
//! from a dialogue, `between` a layer from two whole banks, and both use the layout of every bank.

mod between;
mod by_voice;
mod content;
mod keep;
mod links;
mod merge;
mod stack;

pub(crate) use between::between;
pub use by_voice::VoiceBanks;
pub(crate) use content::Records;
pub(crate) use keep::KeptClips;
pub use stack::{Stack, dialogue_of};

use lipz_bank::Bank;

/// Whether the bank is a layer that has only the texts of some clips, or everything but these.
pub(crate) fn has_parts(bank: &Bank<'_>) -> bool {
    let layer = bank.layer();
    layer.is_some_and(|layer| bank.clips().any(|clip| layer.parts(clip.slot()) != (true, true)))
}
