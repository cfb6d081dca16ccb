//! Vocal tracts of different lengths: children and small creatures have higher formants, large men and monsters lower
//! ones.
//!
//! The spectrum is stretched along the axis of frequency before it is scored, as in L. Lee and R. Rose, "Speaker
//! normalization using efficient frequency warping procedures", 1996: piecewise linearly, so that the highest band stays.
//! Stretching logarithms of bands is a linear map, so it becomes part of the cosine transform and takes no time.

use super::mel::{BANDS, band_at, centre_hz};

/// The frequencies of a voice as a multiple of those of the model's mean voice: below 1 for a longer vocal tract.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Warp(f64);

/// The frequency above which the stretching fades out, in hertz, for the mean voice.
const STRETCHED_HZ: f64 = 4_800.0;

impl Warp {
    /// The mean voice.
    pub(crate) const NONE: Warp = Warp(1.0);

    pub(crate) const fn new(factor: f64) -> Warp {
        Warp(factor)
    }

    /// Returns the frequency of this voice that corresponds to one of the mean voice.
    fn hz(self, hz: f64) -> f64 {
        let highest_hz = centre_hz(BANDS - 1);
        // Higher voices fade out earlier, so that their frequencies stay below the highest.
        let limit_hz = STRETCHED_HZ.min(STRETCHED_HZ / self.0);
        if hz <= limit_hz {
            return hz * self.0;
        }
        let slope = (highest_hz - limit_hz * self.0) / (highest_hz - limit_hz);
        limit_hz * self.0 + (hz - limit_hz) * slope
    }

    /// Returns weights for the bands of this voice, from weights for the bands of the mean voice.
    pub(crate) fn weights(self, weights: &[f32; BANDS]) -> [f32; BANDS] {
        if self == Warp::NONE {
            return *weights;
        }
        let mut warped = [0.0; BANDS];
        for (band, weight) in weights.iter().enumerate() {
            let place = band_at(self.hz(centre_hz(band))).clamp(0.0, (BANDS - 1) as f64);
            let below = libm::floor(place);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a band")]
            let (at, share) = (below as usize, (place - below) as f32);
            warped[at] += weight * (1.0 - share);
            if let Some(above) = warped.get_mut(at + 1) {
                *above += weight * share;
            }
        }
        warped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_ascend_to_the_highest_band() {
        for factor in [0.7, 0.94, 1.0, 1.3] {
            let warp = Warp::new(factor);
            let warped: Vec<f64> = (0..BANDS).map(|band| warp.hz(centre_hz(band))).collect();
            assert!(warped.is_sorted(), "{factor}");
            assert!((warped[BANDS - 1] - centre_hz(BANDS - 1)).abs() < 1.0, "{factor}");
            assert!((warped[4] / centre_hz(4) - factor).abs() < 1e-9, "{factor}");
        }
    }

    #[test]
    fn weights_move_and_keep_their_sum() {
        let mut weights = [0.0; BANDS];
        weights[10] = 1.0;
        for (factor, expected) in [(0.7, 7..9), (1.0, 10..11), (1.3, 12..14)] {
            let warped = Warp::new(factor).weights(&weights);
            assert!((warped.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{factor}");
            assert!(
                warped.iter().enumerate().all(|(band, &weight)| weight == 0.0 || expected.contains(&band)),
                "{factor}: {warped:?}"
            );
        }
    }
}
