//! Layers: patches, downloads and mods over a bank or a set, and one bank of all of them.
//!
//! A layer is what two whole banks differ in, so that the reader's answers, the bank that a stack is merged into, and the
//! one that is packed from the sources in one go are the same by construction: `merge` makes a whole bank of a dialogue,
//! `between` a layer of two whole banks, and both go through the layout that every bank has.

mod between;
mod by_voice;
mod content;
mod keep;
mod links;
mod merge;
mod over;
mod stack;

pub use by_voice::VoiceBanks;
pub(crate) use keep::Kept;
pub use over::Over;
pub use stack::{Stack, dialogue_of};

use lipz_bank::Bank;

/// Whether the bank is a layer that has only the texts of some clips, or all but these.
pub(crate) fn has_parts(bank: &Bank<'_>) -> bool {
    let layer = bank.layer();
    layer.is_some_and(|layer| bank.clips().any(|clip| layer.parts(clip.slot()) != (true, true)))
}
