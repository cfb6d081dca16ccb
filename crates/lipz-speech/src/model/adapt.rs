//! Adaptation of a model to counted frames: the more frames a Gaussian has, the less its old position counts.
//!
//! Uses maximum a posteriori estimation, after J.-L. Gauvain and C.-H. Lee, "Maximum a Posteriori Estimation for
//! Multivariate Gaussian Mixture Observations of Markov Chains", 1994: the old model counts as a number of frames.

use super::counts::Counts;
use super::file::height;
use super::{DENSITIES, Model, STATES, STREAMS};
use crate::Phone;
use crate::features::cepstra::COEFFICIENTS;

/// The weight of a Gaussian's old position, in frames. With five minutes of a voice, values from 10 to 100 work equally
/// well, and also with half a minute.
const PLACE_FRAMES: f64 = 30.0;
/// The weight of the common old position of all Gaussians of a phone, in frames.
const SHIFT_FRAMES: f64 = 50.0;
/// The weight of a state's old weights, in frames.
const WEIGHT_FRAMES: f64 = 100.0;
/// The weight of a state's old length, in frames.
const LENGTH_FRAMES: f64 = 20.0;
/// The least variance, relative to the old one.
const LEAST_VARIANCE: f64 = 0.3;
/// The highest probability of staying in a state, and of leaving it.
const MOST_LIKELY: f64 = 0.999;

impl Model {
    /// Returns this model, adapted to `counts`.
    pub(crate) fn adapted(&self, counts: &Counts) -> Model {
        let mut model = self.clone();
        for book in 0..Phone::COUNT * STREAMS {
            for dimension in 0..COEFFICIENTS {
                model.move_gaussians(counts, book, dimension);
            }
            model.set_heights(book);
        }
        for state in 0..Phone::COUNT * STATES {
            for stream in 0..STREAMS {
                model.weigh(counts, (state * STREAMS + stream) * DENSITIES);
            }
            model.set_length(counts, state);
        }
        model
    }

    /// Moves the Gaussians of a codebook in one dimension: first together, then individually.
    fn move_gaussians(&mut self, counts: &Counts, book: usize, dimension: usize) {
        let at = (book * COEFFICIENTS + dimension) * DENSITIES;
        let frames = &counts.frames[book * DENSITIES..][..DENSITIES];
        let (sums, squares) = (&counts.sums[at..][..DENSITIES], &counts.squares[at..][..DENSITIES]);
        let (means, scales) = (&mut self.means[at..][..DENSITIES], &mut self.scales[at..][..DENSITIES]);
        let expected: f64 = frames.iter().zip(&*means).map(|(frames, mean)| frames * f64::from(*mean)).sum();
        let shift = (sums.iter().sum::<f64>() - expected) / (frames.iter().sum::<f64>() + SHIFT_FRAMES);
        for (number, (mean, scale)) in means.iter_mut().zip(scales).enumerate() {
            let (old_mean, old_scale) = (f64::from(*mean) + shift, f64::from(*scale));
            let old_variance = 0.5 / (old_scale * old_scale);
            let all = frames[number] + PLACE_FRAMES;
            let new_mean = (PLACE_FRAMES * old_mean + sums[number]) / all;
            let square = (PLACE_FRAMES * (old_variance + old_mean * old_mean) + squares[number]) / all;
            let variance = (square - new_mean * new_mean).max(LEAST_VARIANCE * old_variance);
            #[expect(clippy::cast_possible_truncation, reason = "models are single")]
            {
                *mean = new_mean as f32;
                *scale = libm::sqrt(0.5 / variance) as f32;
            }
        }
    }

    fn set_heights(&mut self, book: usize) {
        for density in 0..DENSITIES {
            let scale = |dimension| self.scales[(book * COEFFICIENTS + dimension) * DENSITIES + density];
            let inverse: [f32; COEFFICIENTS] = std::array::from_fn(|dimension| scale(dimension) * libm::sqrtf(2.0));
            self.heights[book * DENSITIES + density] = height(&inverse);
        }
    }

    /// Sets the weights of the Gaussians of a state.
    fn weigh(&mut self, counts: &Counts, at: usize) {
        let shares = &counts.shares[at..][..DENSITIES];
        let weights = &mut self.weights[at..][..DENSITIES];
        let old: f64 = weights.iter().map(|weight| f64::from(*weight)).sum();
        let all = shares.iter().sum::<f64>() + WEIGHT_FRAMES;
        for (weight, share) in weights.iter_mut().zip(shares) {
            #[expect(clippy::cast_possible_truncation, reason = "models are single")]
            let new = ((f64::from(*weight) / old * WEIGHT_FRAMES + share) / all) as f32;
            *weight = new;
        }
    }

    /// Sets the length of a state.
    fn set_length(&mut self, counts: &Counts, state: usize) {
        let left = libm::exp(f64::from(self.leave[state]));
        let left = (counts.entered[state] + LENGTH_FRAMES * left) / (counts.stays[state] + LENGTH_FRAMES);
        let left = left.clamp(1.0 - MOST_LIKELY, MOST_LIKELY);
        #[expect(clippy::cast_possible_truncation, reason = "models are single")]
        {
            self.leave[state] = libm::log(left) as f32;
            self.stay[state] = libm::log(1.0 - left) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::cepstra::NUMBERS;

    /// Returns a model after `visits` of the first state of `AA`, each with five frames of this vector.
    fn after(visits: usize, vector: &[f32; NUMBERS]) -> Model {
        let (model, mut counts) = (Model::english(), Counts::new());
        for _ in 0..visits {
            counts.visit(model, Phone::Aa, 0, [vector; 5].into_iter());
        }
        model.adapted(&counts)
    }

    #[test]
    fn what_was_counted_becomes_more_likely_the_more_often_the_more() {
        let vector: [f32; NUMBERS] = std::array::from_fn(|number| (number as f32 * 1.3).sin() * 4.0);
        let score = |model: &Model| model.score_phone(&vector, Phone::Aa.index())[0];
        let scores = [score(Model::english()), score(&after(2, &vector)), score(&after(200, &vector))];
        assert!(scores[0] + 1.0 < scores[1] && scores[1] + 1.0 < scores[2], "{scores:?}");
        let other = |model: &Model| model.score_phone(&vector, Phone::Iy.index());
        let (old, new) = (other(Model::english()), other(&after(200, &vector)));
        assert!(old.iter().zip(new).all(|(old, new)| (old - new).abs() < 0.3), "no other phone moves: {old:?} {new:?}");
    }

    #[test]
    fn lengths_follow_the_visits() {
        let model = after(1_000, &[0.5; NUMBERS]);
        let state = Phone::Aa.index() * STATES;
        assert!((libm::expf(model.leave[state]) - 0.2).abs() < 0.01, "five frames a visit");
        assert!((libm::expf(model.leave[state]) + libm::expf(model.stay[state]) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn nothing_counted_changes_nothing() {
        let (vector, model) = ([0.7; NUMBERS], Model::english().adapted(&Counts::new()));
        let pairs = Model::english().score(&vector).into_iter().zip(model.score(&vector));
        assert!(pairs.into_iter().all(|(old, new)| (old - new).abs() < 0.2), "weights now add up to 1");
    }
}
