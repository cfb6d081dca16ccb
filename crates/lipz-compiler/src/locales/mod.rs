//! The locales and voices of a bank, and the texts or dubs used in place of missing ones.

pub(crate) mod dubs;
pub(crate) mod fallback;
pub(crate) mod localise;
mod packed_texts;
pub(crate) mod pseudo;
