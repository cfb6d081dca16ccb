//! Noise that stays, tracked and taken away.
//!
//! As in PocketSphinx, whose model was made with it, after C. Kim and R. Stern, "Power-Normalized Cepstral Coefficients (PNCC)
//! for Robust Speech Recognition", 2016: the noise is the lower envelope of the power; what is below a second envelope, or
//! hidden behind a peak just before it, counts as noise, too. The gain is smoothed over the bands.

use super::mel::BANDS;

/// How much of the power of a frame is of the frames before it.
const POWER_MEMORY: f32 = 0.7;
/// How much of an envelope stays per frame where the power is above it, and where it is below.
const RISE_MEMORY: f32 = 0.995;
const FALL_MEMORY: f32 = 0.5;
/// How fast a peak fades per frame, and how much of it stands for what it hides.
const PEAK_MEMORY: f32 = 0.85;
const PEAK_SHARE: f32 = 0.2;
/// The most by which a band is weakened or strengthened.
const MOST_GAIN: f32 = 20.0;
/// Bands on each side over which the gain is smoothed.
const SMOOTHED: usize = 4;
/// The least power, in the units of 16-bit samples.
const LEAST: f32 = 1.0;

/// What is known of the noise so far.
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
    /// The power of the next frame without the noise; never 0.
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
    /// Takes in the power of a band; returns how much of it is signal.
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
