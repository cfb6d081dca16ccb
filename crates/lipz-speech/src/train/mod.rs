//! Training of a model with a project's own recordings and texts.

mod file;
mod states;

pub use file::{ModelError, TrainedModel};

use crate::features::cepstra::{NUMBERS, Vectors};
use crate::features::warp::Warp;
use crate::model::Counts;
use crate::{AlignOptions, Aligner, Model, Phone, Script, Sound};

/// Trains a model on recordings and their transcripts.
///
/// Starts with an existing model: aligns the recordings with it, counts the values in the frames of each phone, and
/// moves the model towards them. This is repeated with the new model.
#[derive(Clone, Debug)]
pub struct Training {
    first: Model,
    model: Model,
}

/// The statistics of recordings for training: see [`Training::observe`].
#[derive(Clone, Debug)]
pub struct Observations {
    counts: Counts,
    speech_frames: u64,
    used: usize,
    left_out: usize,
}

impl Training {
    /// The number of rounds of aligning the recordings and moving the model. Further rounds change nothing.
    pub const ROUNDS: usize = 3;

    /// Returns a training that starts with `model`.
    pub fn new(model: &Model) -> Training {
        Training { first: model.clone(), model: model.clone() }
    }

    /// Adds a recording and its transcript to `observations`. A recording that does not match its script is skipped.
    pub fn observe(&self, sound: &Sound, script: &Script, observations: &mut Observations) {
        let aligner = Aligner::new(&self.model, AlignOptions::default());
        let phones = aligner.frames(sound, script);
        let Some(phones) = phones else {
            observations.left_out += 1;
            return;
        };
        observations.used += 1;
        let mut vectors = Vectors::new(sound.spectrum(), Warp::NONE);
        for (phone, frames) in phones {
            let vectors: Vec<[f32; NUMBERS]> = vectors.by_ref().take(frames.len()).map(|frame| frame.vector).collect();
            if matches!(phone, Phone::Noise | Phone::Spoken) {
                continue;
            }
            if phone.is_speech() {
                observations.speech_frames += vectors.len() as u64;
            }
            let mut rest = vectors.as_slice();
            for (state, count) in states::lengths(&self.model, phone, &vectors).into_iter().enumerate() {
                let (visit, after) = rest.split_at(count);
                if !visit.is_empty() {
                    observations.counts.visit(&self.model, phone, state, visit.iter());
                }
                rest = after;
            }
        }
    }

    /// Moves the model towards the observations.
    pub fn learn(&mut self, observations: &Observations) {
        self.model = self.first.adapted(&observations.counts);
    }

    /// Returns the current model.
    pub fn model(&self) -> &Model {
        &self.model
    }
}

impl Default for Observations {
    fn default() -> Observations {
        Observations { counts: Counts::new(), speech_frames: 0, used: 0, left_out: 0 }
    }
}

impl Observations {
    /// Adds the observations of other recordings.
    pub fn extend(&mut self, other: &Observations) {
        self.counts.extend(&other.counts);
        self.speech_frames += other.speech_frames;
        self.used += other.used;
        self.left_out += other.left_out;
    }

    /// Returns the length of the observed speech, in microseconds.
    pub fn speech_us(&self) -> u64 {
        self.speech_frames * 10_000
    }

    /// Returns the number of recordings used.
    pub fn used(&self) -> usize {
        self.used
    }

    /// Returns the number of recordings skipped because they do not match their scripts.
    pub fn left_out(&self) -> usize {
        self.left_out
    }
}
