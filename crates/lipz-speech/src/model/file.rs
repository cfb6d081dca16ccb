//! Reads the file of an acoustic model.

use super::{DENSITIES, Model, PAIRED, STATES, STREAMS};
use crate::Phone;
use crate::features::cepstra::COEFFICIENTS;
use half::f16;
use std::f64::consts::PI;

pub(super) const MAGIC: &[u8] = b"LIPZ-AM1";
/// The length of a name in bytes.
pub(super) const NAME: usize = 8;
/// The number of codebooks, and of values in each.
const BOOKS: usize = Phone::COUNT * STREAMS;
const BOOK: usize = DENSITIES * COEFFICIENTS;

/// Probabilities of staying that are closer to 0 or 1 are invalid.
const MOST_EXTREME: f32 = 1e-4;

/// The error for data that is not an acoustic model in this format.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct NoModel;

impl Model {
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Model, NoModel> {
        let mut rest = bytes.strip_prefix(MAGIC).ok_or(NoModel)?;
        let mut take = |count: usize| {
            let (taken, left) = rest.split_at_checked(count).ok_or(NoModel)?;
            rest = left;
            Ok(taken)
        };
        let shape = [Phone::COUNT, STREAMS, DENSITIES, COEFFICIENTS];
        if !take(2 * shape.len())?.chunks_exact(2).map(whole).eq(shape) {
            return Err(NoModel);
        }
        for (phone, name) in Phone::ALL.iter().zip(take(Phone::COUNT * NAME)?.chunks_exact(NAME)) {
            if name.strip_prefix(phone.name().as_bytes()).is_none_or(|padding| padding.iter().any(|&byte| byte != 0)) {
                return Err(NoModel);
            }
        }
        let means = halves(take(2 * BOOKS * BOOK)?);
        let inverse_sigmas = halves(take(2 * BOOKS * BOOK)?);
        let weights = take(Phone::COUNT * STATES * STREAMS * DENSITIES)?;
        let stay = halves(take(2 * Phone::COUNT * STATES)?);
        let pairs = take(PAIRED * PAIRED)?;
        let is_sigma = |inverse: &f32| inverse.is_finite() && *inverse > 0.0;
        let is_chance = |stay: &f32| (MOST_EXTREME..=1.0 - MOST_EXTREME).contains(stay);
        let makes_sense = means.iter().all(|mean| mean.is_finite())
            && inverse_sigmas.iter().all(is_sigma)
            && stay.iter().all(is_chance);
        if !rest.is_empty() || !makes_sense {
            return Err(NoModel);
        }
        #[expect(clippy::cast_possible_truncation, reason = "weights are single")]
        let weight = |&steps: &u8| libm::exp(-f64::from(steps) * weight_step()) as f32;
        let half = libm::sqrtf(0.5);
        Ok(Model {
            means: by_dimension(&means),
            heights: inverse_sigmas.chunks_exact(COEFFICIENTS).map(height).collect(),
            scales: by_dimension(&inverse_sigmas.iter().map(|inverse| inverse * half).collect::<Vec<_>>()),
            weights: weights.iter().map(weight).collect(),
            leave: stay.iter().map(|stay| libm::logf(1.0 - stay)).collect(),
            stay: stay.iter().map(|&stay| libm::logf(stay)).collect(),
            pairs: pairs.iter().map(|&sixteenths| -f32::from(sixteenths) / 16.0).collect(),
        })
    }

    /// Returns a model in which all sounds are equally likely.
    pub(super) fn nothing() -> Model {
        let states = Phone::COUNT * STATES;
        Model {
            means: vec![0.0; BOOKS * BOOK],
            scales: vec![0.0; BOOKS * BOOK],
            heights: vec![0.0; BOOKS * DENSITIES],
            weights: vec![1.0; states * STREAMS * DENSITIES],
            stay: vec![libm::logf(0.5); states],
            leave: vec![libm::logf(0.5); states],
            pairs: vec![0.0; PAIRED * PAIRED],
        }
    }
}

/// Returns the step of weights in the file, in nats.
pub(super) fn weight_step() -> f64 {
    1024.0 * libm::log(1.0001)
}

fn whole(bytes: &[u8]) -> usize {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | usize::from(byte))
}

fn halves(bytes: &[u8]) -> Vec<f32> {
    let half = |bytes: &[u8]| bytes.try_into().map_or(0.0, |bytes| f16::from_le_bytes(bytes).to_f32());
    bytes.chunks_exact(2).map(half).collect()
}

/// Returns the logarithm of a Gaussian's density at its mean.
pub(super) fn height(inverse_sigmas: &[f32]) -> f32 {
    let sum: f64 = inverse_sigmas.iter().map(|&inverse| libm::log(f64::from(inverse))).sum();
    #[expect(clippy::cast_possible_truncation, reason = "densities are single")]
    let height = (sum - 0.5 * COEFFICIENTS as f64 * libm::log(2.0 * PI)) as f32;
    height
}

/// Reorders each codebook by dimension instead of by Gaussian, because vector code reads all Gaussians of a dimension.
fn by_dimension(numbers: &[f32]) -> Vec<f32> {
    transposed(numbers, COEFFICIENTS)
}

/// Reverses [`by_dimension`].
pub(super) fn by_gaussian(numbers: &[f32]) -> Vec<f32> {
    transposed(numbers, DENSITIES)
}

/// Swaps the rows and the columns of each codebook. Every run that reads a model does this, so it is a plain loop, which
/// takes a tenth of the instructions of nested iterators.
fn transposed(numbers: &[f32], columns: usize) -> Vec<f32> {
    let mut transposed = Vec::with_capacity(numbers.len());
    for book in numbers.chunks_exact(BOOK) {
        for column in 0..columns {
            transposed.extend(book.chunks_exact(columns).map(|row| row[column]));
        }
    }
    transposed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ENGLISH;

    #[test]
    fn the_model_that_is_built_in_is_whole() {
        let model = Model::from_bytes(ENGLISH).unwrap();
        for numbers in [&model.means, &model.scales, &model.heights, &model.weights, &model.stay, &model.leave] {
            assert!(numbers.iter().all(|number| number.is_finite()));
        }
        assert!(model.scales.iter().all(|&scale| scale > 0.0));
        for weights in model.weights.chunks_exact(DENSITIES) {
            let sum: f32 = weights.iter().sum();
            assert!((0.9..1.2).contains(&sum), "{sum}: weights are in steps of a tenth");
        }
    }

    #[test]
    fn no_shorter_longer_or_other_file_is_a_model() {
        for length in [0, 5, 8, 15, 16, 400, ENGLISH.len() / 2, ENGLISH.len() - 1] {
            assert_eq!(Model::from_bytes(&ENGLISH[..length]).err(), Some(NoModel), "{length}");
        }
        let mut longer = ENGLISH.to_vec();
        longer.push(0);
        assert!(Model::from_bytes(&longer).is_err());
        for byte in 0..16 + Phone::COUNT * NAME {
            let mut other = ENGLISH.to_vec();
            other[byte] ^= 0x20;
            assert!(Model::from_bytes(&other).is_err(), "{byte}");
        }
    }
}
