//! The recordings of a project: search, measurement and analysis; and the Lipz files to which they belong.

pub(crate) mod clip;
pub(crate) mod condition;
mod facts_cache;
pub(crate) mod file_facts;
pub(crate) mod finder;
mod in_bank;
pub(crate) mod inputs;
pub(crate) mod loudness;
pub(crate) mod originals;
pub(crate) mod paths;
pub(crate) mod places;
pub(crate) mod transcript;

pub use facts_cache::FactsCache;
pub use file_facts::{FileFacts, content_hash};
pub use finder::{Recordings, is_recording};
pub use in_bank::in_bank;
