//! The acoustic model: the likelihood of each vector in each phone.
//!
//! CMU Sphinx calls this model *phonetically tied*: each phone has 128 Gaussians for each of three streams (cepstrum,
//! change, change of the change), which each of its three states weights differently. Phones have no context, because
//! triphones did not improve alignments.
//!
//! The file, made by `cargo xtask speech-model`, is little-endian: `LIPZ-AM1`; four 16-bit numbers (phones, streams,
//! Gaussians, dimensions); the phones' names in 8 bytes each; for each phone, stream, Gaussian and dimension the mean,
//! and then likewise 1/σ, as 16-bit floats; for each state, stream and Gaussian the weight in a byte, as the negative
//! logarithm in steps of 1024 · ln 1.0001; for each state the probability of staying, as a 16-bit float; for each phone
//! of speech and silence, and each that may follow it, the negative logarithm of the probability in a byte, in
//! sixteenths.

mod adapt;
mod counts;
mod file;
mod score;
mod write;

use crate::Phone;
pub(crate) use counts::Counts;
pub(crate) use score::{STREAM_WEIGHTS, Scores, exp};
use std::sync::OnceLock;

/// The number of states of a phone. They are passed in order.
pub(crate) const STATES: usize = 3;
const STREAMS: usize = 3;
const DENSITIES: usize = 128;

/// The model of US English.
static ENGLISH: &[u8] = include_bytes!("../../model/en-us.bin");

/// An acoustic model.
#[derive(Clone, Debug)]
pub struct Model {
    /// By phone, stream, dimension, Gaussian: means, and 1/σ over the square root of 2.
    means: Vec<f32>,
    scales: Vec<f32>,
    /// By phone, stream, Gaussian: the logarithm of the density at the mean.
    heights: Vec<f32>,
    /// By state, stream, Gaussian.
    weights: Vec<f32>,
    /// By state: the logarithms of the probabilities of staying and of leaving.
    pub(crate) stay: Vec<f32>,
    pub(crate) leave: Vec<f32>,
    /// By phone, phone after it: the logarithm of the probability that it follows.
    pairs: Vec<f32>,
}

/// The number of phones that may follow each other: those of speech, and silence.
const PAIRED: usize = Phone::Sil.index() + 1;

impl Model {
    /// Returns the logarithm of the probability that the phone with index `next` follows the one with index `phone`.
    /// Silence counts as a phone.
    pub(crate) fn pair(&self, phone: usize, next: usize) -> f32 {
        self.pairs[phone * PAIRED + next]
    }

    /// Returns the built-in model: US English, from CMU Sphinx. Its notice is in `model/NOTICE`.
    ///
    /// Other languages use it as well, through its phones. It is unpacked once, which takes a few milliseconds and 1.8
    /// megabytes.
    pub fn english() -> &'static Model {
        static MODEL: OnceLock<Model> = OnceLock::new();
        // Cannot fail: the file is embedded, and a test reads it.
        MODEL.get_or_init(|| Model::from_bytes(ENGLISH).unwrap_or_else(|_| Model::nothing()))
    }
}
