//! A model of the voices of a project, learnt from its own recordings and texts.

mod file;
mod states;

pub use file::{ModelError, TrainedModel};

use crate::features::cepstra::{NUMBERS, Vectors};
use crate::model::Counts;
use crate::{AlignOptions, Aligner, Model, Phone, Script, Sound};

/// Learns a model from recordings and what is said in them.
///
/// Starts with a model that is there: aligns the recordings with it, counts which numbers the frames of each phone have, and
/// moves the model towards them; then again with the new model.
#[derive(Clone, Debug)]
pub struct Training {
    first: Model,
    model: Model,
}

/// What recordings tell about a model: see [`Training::observe`].
#[derive(Clone, Debug)]
pub struct Observations {
    counts: Counts,
    speech_frames: u64,
    used: usize,
    left_out: usize,
}

impl Training {
    /// How often recordings are aligned and the model is moved: what comes after that changes nothing.
    pub const ROUNDS: usize = 3;

    /// A training that starts with `model`.
    pub fn new(model: &Model) -> Training {
        Training { first: model.clone(), model: model.clone() }
    }

    /// Adds a recording and what is said in it to `observations`. One whose script is not what is said is left out.
    pub fn observe(&self, sound: &Sound, script: &Script, observations: &mut Observations) {
        let aligner = Aligner::new(&self.model, AlignOptions::default());
        let phones = aligner.frames(sound, script);
        let Some(phones) = phones else {
            observations.left_out += 1;
            return;
        };
        observations.used += 1;
        let mut vectors = Vectors::new(sound.spectrum());
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

    /// Moves the model to what was observed.
    pub fn learn(&mut self, observations: &Observations) {
        self.model = self.first.adapted(&observations.counts);
    }

    /// The model as it is now.
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
    /// Adds those of other recordings.
    pub fn extend(&mut self, other: &Observations) {
        self.counts.extend(&other.counts);
        self.speech_frames += other.speech_frames;
        self.used += other.used;
        self.left_out += other.left_out;
    }

    /// How much speech was observed, in microseconds.
    pub fn speech_us(&self) -> u64 {
        self.speech_frames * 10_000
    }

    /// How many recordings were used.
    pub fn used(&self) -> usize {
        self.used
    }

    /// How many recordings were left out, because something else is said in them than their scripts say.
    pub fn left_out(&self) -> usize {
        self.left_out
    }
}
