//! The features that the acoustic model scores.

pub(crate) mod cepstra;
pub(crate) mod floor;
pub(crate) mod mel;
mod noise;
pub(crate) mod spectrogram;
mod temporary;
pub(crate) mod warp;
