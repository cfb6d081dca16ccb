//! Tracking and removal of constant noise.
//!
//! As in PocketSphinx, with which the model was trained, after C. Kim and R. Stern, "Power-Normalized Cepstral
//! Coefficients (PNCC) for Robust Speech Recognition", 2016: the noise is the lower envelope of the power. Power below
//! a second envelope, or masked by a peak just before it, also counts as noise. The gain is smoothed over the bands.

use super::mel::BANDS;

/// The share of the previous frames in the power of a frame.
const POWER_MEMORY: f32 = 0.7;
/// The share of an envelope that remains per frame where the power is above it, and where it is below.
const RISE_MEMORY: f32 = 0.995;
const FALL_MEMORY: f32 = 0.5;
/// The share of a peak that remains per frame, and the share that replaces what it masks.
const PEAK_MEMORY: f32 = 0.85;
const PEAK_SHARE: f32 = 0.2;
/// The greatest factor by which a band is attenuated or amplified.
const MOST_GAIN: f32 = 20.0;
/// The number of bands on each side over which the gain is smoothed.
const SMOOTHED: usize = 4;
/// The least power, in the units of 16-bit samples.
const LEAST: f32 = 1.0;

/// The state of the noise estimate.
#[derive(Clone, Debug, Default)]
pub(crate) struct NoiseTracker(Option<Envelopes>);

#[derive(Clone, Debug)]
struct Envelopes {
    power: [f32; BANDS],
    noise: [f32; BANDS],
    floor: [f32; BANDS],
    peak: [f32; BANDS],
}

impl NoiseTracker {
    /// Returns the power of the next frame without the noise, which is never 0.
    pub(crate) fn clean(&mut self, frame: [f32; BANDS]) -> [f32; BANDS] {
        let envelopes =
            self.0.get_or_insert(Envelopes { power: frame, noise: frame, floor: frame, peak: [0.0; BANDS] });
        let gain: [f32; BANDS] = std::array::from_fn(|band| envelopes.gain(band, frame[band]));
        std::array::from_fn(|band| {
            let around = &gain[band.saturating_sub(SMOOTHED)..(band + SMOOTHED + 1).min(BANDS)];
            let mean = around.iter().sum::<f32>() / around.len() as f32;
            (frame[band] * mean).max(1e-4)
        })
    }
}

impl Envelopes {
    /// Updates the envelopes with the power of a band, and returns the share of the signal in it.
    fn gain(&mut self, band: usize, now: f32) -> f32 {
        let power = &mut self.power[band];
        *power = POWER_MEMORY * *power + (1.0 - POWER_MEMORY) * now;
        follow(&mut self.noise[band], *power);
        let mut signal = (*power - self.noise[band]).max(LEAST);
        follow(&mut self.floor[band], signal);
        let unmasked = signal;
        let peak = &mut self.peak[band];
        *peak *= PEAK_MEMORY;
        if signal < PEAK_MEMORY * *peak {
            signal = *peak * PEAK_SHARE;
        }
        *peak = peak.max(unmasked);
        (signal.max(self.floor[band]) / power.max(1e-4)).clamp(1.0 / MOST_GAIN, MOST_GAIN)
    }
}

/// Moves a lower envelope towards a value.
fn follow(envelope: &mut f32, value: f32) {
    let memory = if value >= *envelope { RISE_MEMORY } else { FALL_MEMORY };
    *envelope = memory * *envelope + (1.0 - memory) * value;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_that_stays_becomes_weaker_than_what_comes_and_goes() {
        let mut tracker = NoiseTracker::default();
        let noise = [1e6; BANDS];
        let mut last = [0.0; BANDS];
        for _ in 0..200 {
            last = tracker.clean(noise);
        }
        assert!(last[12] < 1e5, "{}", last[12]);
        let tone = tracker.clean([1e8; BANDS]);
        assert!(tone[12] > 5e7, "{}", tone[12]);
    }

    #[test]
    fn nothing_is_never_infinite() {
        let mut tracker = NoiseTracker::default();
        for frame in [[0.0; BANDS], [1e20; BANDS], [0.0; BANDS]] {
            assert!(tracker.clean(frame).iter().all(|power| power.is_finite() && *power > 0.0));
        }
    }
}
