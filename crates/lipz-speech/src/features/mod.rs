//! What the acoustic model sees of a sound.

pub(crate) mod cepstra;
pub(crate) mod floor;
pub(crate) mod mel;
mod noise;
