//! The loudness of the voice.

use crate::features::mel::{BANDS, Spectrum, logarithm_of, white_noise};
use crate::features::spectrogram::Spectrogram;

/// Audio that is not louder than this is silent, in decibels relative to full scale.
pub(crate) const SILENT_DB: f32 = -60.0;

/// The number of bands of the voice: up to 4 kilohertz. Above are hisses, for which a mouth opens little.
const VOICE_BANDS: usize = 20;
/// The power of white noise at full scale, in the units of [`voice_power`].
const FULL_SCALE: f32 = 32_768.0 * 32_768.0;

/// The loudness of a recording.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Levels {
    /// The level of the loud frames: 95 in 100 frames are not louder.
    pub(crate) loud_db: f32,
    /// The level of the quiet frames: 5 in 100 frames are quieter.
    pub(crate) quiet_db: f32,
}

impl Levels {
    pub(crate) fn new(spectrum: &Spectrogram) -> Levels {
        let mut powers = voice_powers(spectrum);
        powers.sort_unstable_by(f32::total_cmp);
        let share = |percent: usize| powers.get(powers.len().saturating_sub(1) * percent / 100).copied().unwrap_or(0.0);
        Levels { loud_db: decibels(share(95)), quiet_db: decibels(share(5)) }
    }
}

/// Returns the power of the voice in each frame, without the pre-emphasis of the features; 1 is full scale.
pub(crate) fn voice_powers(spectrum: &Spectrogram) -> Vec<f32> {
    let white = white_noise();
    spectrum.iter().map(|frame| voice_power(&frame, &white)).collect()
}

fn voice_power(spectrum: &Spectrum, white: &[f32; BANDS]) -> f32 {
    let bands = spectrum.iter().zip(white).take(VOICE_BANDS);
    bands.map(|(&band, white)| libm::expf(logarithm_of(band)) / white).sum::<f32>() / VOICE_BANDS as f32 / FULL_SCALE
}

/// Converts a ratio of powers to decibels.
pub(crate) fn decibels(ratio: f32) -> f32 {
    10.0 * libm::log10f(ratio.max(1e-30))
}

#[cfg(test)]
mod tests {
    use crate::Sound;

    fn noise(amplitude: impl Fn(usize) -> f32) -> Sound {
        let mut state = 1_u32;
        let sample = |i: usize| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (f32::from(state.to_be_bytes()[0]) / 127.5 - 1.0) * amplitude(i)
        };
        Sound::from_samples(&(0..32_000).map(sample).collect::<Vec<_>>(), 16_000).unwrap()
    }

    #[test]
    fn levels_are_in_decibels() {
        let [loud, quiet] = [0.5, 0.05].map(|amplitude| noise(move |_| amplitude).level_db());
        assert!((loud - quiet - 20.0).abs() < 0.5, "{loud} {quiet}");
        // Noise from -0.5 to 0.5 has a power of 1/12.
        assert!((loud + 10.8).abs() < 2.0, "{loud}");
    }

    #[test]
    fn silence_and_noise_without_pauses_are_told_apart_from_speech() {
        assert!(noise(|_| 0.0).is_silent());
        assert!(noise(|_| 0.0005).is_silent());
        assert!(!noise(|_| 0.05).is_silent());
        assert!(noise(|_| 0.3).range_db() < 10.0);
        assert!(noise(|i| if i / 4_000 % 2 == 0 { 0.3 } else { 0.003 }).range_db() > 30.0);
    }
}
