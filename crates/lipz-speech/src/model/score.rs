//! The likelihood of a vector in each state: the inner loop of alignment.
//!
//! Each sum consists of eight partial sums, so that vector code does not change the order of any sum. The loops that take
//! half of the time of `lipz sync` use vectors of the crate `wide`, because the code that the compiler chose for plain
//! loops depended on the profile. Their operations are rounded as those of floats.

use super::{DENSITIES, Model, STATES, STREAMS};
use crate::Phone;
use crate::features::cepstra::{COEFFICIENTS, NUMBERS};
use wide::f32x8;

/// The logarithms of the likelihoods of a vector, by phone and state.
pub(crate) type Scores = [f32; Phone::COUNT * STATES];

const LANES: usize = 8;
/// The weights of the streams: cepstrum, change, change of the change. The changes overlap with those of the
/// neighbouring frames, so they repeat the same evidence.
pub(crate) const STREAM_WEIGHTS: [f32; STREAMS] = [1.0, 0.7, 0.5];
/// The least sum of densities, so that its logarithm is finite.
const LEAST: f32 = 1e-30;

impl Model {
    /// Returns the scores of a vector in all states.
    pub(crate) fn score(&self, vector: &[f32; NUMBERS]) -> Scores {
        let mut scores = [0.0; Phone::COUNT * STATES];
        for (phone, states) in scores.chunks_exact_mut(STATES).enumerate() {
            states.copy_from_slice(&self.score_phone(vector, phone));
        }
        scores
    }

    /// Returns the scores of a vector in the states of the phone with this index.
    pub(crate) fn score_phone(&self, vector: &[f32; NUMBERS], phone: usize) -> [f32; STATES] {
        let mut scores = [0.0; STATES];
        for ((stream, numbers), weight) in vector.chunks_exact(COEFFICIENTS).enumerate().zip(STREAM_WEIGHTS) {
            let mut densities = self.densities(phone * STREAMS + stream, numbers);
            let best = exponentiate(&mut densities);
            for (state, score) in scores.iter_mut().enumerate() {
                let book = (phone * STATES + state) * STREAMS + stream;
                let sum = dot(&self.weights[book * DENSITIES..][..DENSITIES], &densities);
                *score += weight * (best + libm::logf(sum.max(LEAST)));
            }
        }
        scores
    }

    /// Returns the logarithms of the densities of the Gaussians of a codebook.
    pub(super) fn densities(&self, book: usize, numbers: &[f32]) -> [f32; DENSITIES] {
        let mut densities = [0.0; DENSITIES];
        densities.copy_from_slice(&self.heights[book * DENSITIES..][..DENSITIES]);
        let range = book * DENSITIES * COEFFICIENTS..(book + 1) * DENSITIES * COEFFICIENTS;
        let means = self.means[range.clone()].as_chunks::<DENSITIES>().0;
        let scales = self.scales[range].as_chunks::<DENSITIES>().0;
        let heights = self.heights[book * DENSITIES..][..DENSITIES].as_chunks().0;
        let mut densities = [0.0; DENSITIES];
        for (block, (densities, &heights)) in densities.as_chunks_mut().0.iter_mut().zip(heights).enumerate() {
            let mut sums = f32x8::new(heights);
            for ((&number, means), scales) in numbers.iter().zip(means).zip(scales) {
                let [mean, scale] = [means, scales].map(|row| f32x8::new(row.as_chunks().0[block]));
                let distance = (f32x8::splat(number) - mean) * scale;
                sums -= distance * distance;
            }
            *densities = sums.to_array();
        }
        densities
    }
}

/// Replaces logarithms of densities by the densities, relative to the highest. Returns the logarithm of the highest.
pub(super) fn exponentiate(logarithms: &mut [f32; DENSITIES]) -> f32 {
    let best = best(logarithms);
    for density in logarithms {
        *density = exp(*density - best);
    }
    best
}

fn best(densities: &[f32; DENSITIES]) -> f32 {
    let mut best = [f32::MIN; LANES];
    for lanes in densities.chunks_exact(LANES) {
        for (best, &density) in best.iter_mut().zip(lanes) {
            *best = if density > *best { density } else { *best };
        }
    }
    best.into_iter().fold(f32::MIN, f32::max)
}

fn dot(weights: &[f32], densities: &[f32; DENSITIES]) -> f32 {
    let mut sums = f32x8::ZERO;
    for (&weights, &densities) in weights.as_chunks().0.iter().zip(densities.as_chunks().0) {
        sums += f32x8::new(weights) * f32x8::new(densities);
    }
    sums.to_array().iter().sum()
}

/// Returns e to the power of `x`, which is not positive, to six digits; e⁻⁸⁰ below -80.
///
/// The integral power of 2 becomes the exponent of the float, and five terms of the series compute the rest. libm's
/// function has branches, which prevent vector code.
pub(crate) fn exp(x: f32) -> f32 {
    /// Adding 1.5 · 2²³ rounds to an integer, which is then in the lowest bits.
    const SHIFT: f32 = 12_582_912.0;
    let x = if x < -80.0 { -80.0 } else { x };
    let powers = x * std::f32::consts::LOG2_E;
    let shifted = powers + SHIFT;
    let rest = (powers - (shifted - SHIFT)) * std::f32::consts::LN_2;
    let series = 1.0 + rest * (1.0 + rest * (0.5 + rest * (1.0 / 6.0 + rest * (1.0 / 24.0 + rest * (1.0 / 120.0)))));
    let exponent = (shifted.to_bits() << 23).wrapping_add(1.0_f32.to_bits());
    f32::from_bits(exponent) * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_function_has_six_digits() {
        for step in 0..8_000_u16 {
            let x = -f32::from(step) / 100.0;
            let expected = f64::from(x).exp();
            assert!((f64::from(exp(x)) / expected - 1.0).abs() < 5e-6, "{x}: {} {expected}", exp(x));
        }
        assert!(exp(-1e30) > 0.0 && exp(-1e30) < 1e-34);
        assert_eq!(exp(0.0), 1.0);
    }

    #[test]
    fn the_sum_over_gaussians_is_that_of_the_definition() {
        let model = Model::english();
        let vector: [f32; NUMBERS] = std::array::from_fn(|i| (i as f32 * 0.7).sin() * 3.0);
        let phone = Phone::Iy.index();
        for (state, &score) in model.score_phone(&vector, phone).iter().enumerate() {
            let mut expected = 0.0;
            for stream in 0..STREAMS {
                let book = phone * STREAMS + stream;
                let mut sum = 0.0;
                for density in 0..DENSITIES {
                    let mut exponent = f64::from(model.heights[book * DENSITIES + density]);
                    for dimension in 0..COEFFICIENTS {
                        let at = (book * COEFFICIENTS + dimension) * DENSITIES + density;
                        let distance =
                            f64::from((vector[stream * COEFFICIENTS + dimension] - model.means[at]) * model.scales[at]);
                        exponent -= distance * distance;
                    }
                    let weights = ((phone * STATES + state) * STREAMS + stream) * DENSITIES;
                    sum += f64::from(model.weights[weights + density]) * exponent.exp();
                }
                expected += f64::from(STREAM_WEIGHTS[stream]) * sum.ln();
            }
            assert!((f64::from(score) - expected).abs() < 0.01, "{score} {expected}");
        }
        assert_eq!(model.score(&vector)[phone * STATES..][..STATES], model.score_phone(&vector, phone));
    }
}
