//! A noise floor for every recording.
//!
//! Digital silence, and quiet passages after lossy compression, are unlike anything in the training data of the
//! acoustic model, and ruin an alignment. Sphinx adds random noise to the samples (dither). Adding the expected power
//! of such noise to the power of each band has the same effect without randomness. The floor is relative to the
//! loudness of the speech, so that a recording aligns the same at every volume.

use super::mel::{BANDS, Spectrum, logarithm_of, white_noise};
use super::spectrogram::Spectrogram;

/// The distance between the loud frames and the floor, in nats of power: 40 decibels.
const DEPTH_NATS: f32 = 9.21;
/// The percentage of frames that are not louder than the loud ones.
const LOUD_PERCENT: usize = 95;

/// The power that is added to each band.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Floor([f32; BANDS]);

impl Floor {
    /// Returns the floor for a recording.
    pub(crate) fn new(spectrum: &Spectrogram) -> Floor {
        let mut levels: Vec<i32> = spectrum.iter().map(|frame| level(&frame)).collect();
        let loud = match levels.len() {
            0 => 0,
            count => *levels.select_nth_unstable((count - 1) * LOUD_PERCENT / 100).1,
        };
        let loud_nats = loud as f32 / (BANDS as f32 * 1024.0);
        let white = white_noise();
        let mean_nats = white.iter().map(|power| libm::logf(*power)).sum::<f32>() / BANDS as f32;
        let factor = libm::expf(loud_nats - DEPTH_NATS - mean_nats);
        Floor(white.map(|power| power * factor))
    }

    /// Returns the power of each band, including the floor.
    pub(crate) fn raise(&self, spectrum: &Spectrum) -> [f32; BANDS] {
        std::array::from_fn(|band| libm::expf(logarithm_of(spectrum[band])) + self.0[band])
    }
}

/// Returns the sum of the logarithms of all bands.
pub(crate) fn level(spectrum: &Spectrum) -> i32 {
    spectrum.iter().map(|&band| i32::from(band)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_follows_the_volume() {
        let sound: Vec<Spectrum> = (0..50).map(|t| [10_000 + 100 * t; BANDS]).collect();
        let louder: Vec<Spectrum> = sound.iter().map(|frame| frame.map(|band| band + 2_048)).collect();
        let (floor, higher) = (Floor::new(&sound.into()), Floor::new(&louder.into()));
        for (low, high) in floor.0.iter().zip(higher.0) {
            assert!((high / low - libm::expf(2.0)).abs() < 0.01, "{low} {high}");
        }
    }

    #[test]
    fn silence_has_a_floor() {
        let floor = Floor::new(&vec![[-9_431; BANDS]; 3].into());
        assert!(floor.0.iter().all(|power| power.is_finite() && *power > 0.0));
    }
}
