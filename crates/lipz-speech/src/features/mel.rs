//! The mel spectrum of a recording: its energy in each of 25 bands, every 10 milliseconds.
//!
//! It is computed like that of CMU Sphinx, with which the acoustic model was trained: pre-emphasis, Hamming window,
//! power spectrum, triangular bands of unit area whose edges are rounded to bins (S. Davis and P. Mermelstein,
//! "Comparison of parametric representations for monosyllabic word recognition", 1980). All arithmetic uses operations
//! that IEEE 754 defines to the last bit, in a fixed order; logarithms and cosines come from `libm`, and the transform
//! is scalar. Therefore the result is the same on every machine.

use microfft::real::rfft_512;
use std::f64::consts::PI;

/// The input samples per second.
pub(crate) const RATE_HZ: u32 = 16_000;
/// The samples from one frame to the next: 10 milliseconds.
pub(crate) const HOP: usize = 160;
/// The samples in a frame: 25.6 milliseconds.
pub(crate) const WINDOW: usize = 410;
/// The number of bands of the spectrum.
pub(crate) const BANDS: usize = 25;

/// The logarithm of the power in each band, in steps of 1/1024 nat: a ratio of a thousandth, far below the precision of
/// a model. Integers hide differences between decoders and machines in the last bit of a sample.
pub(crate) type Spectrum = [i16; BANDS];

const STEPS: f32 = 1024.0;
/// The least power, which stands for silence: -9.2 nats.
const LEAST_POWER: f32 = 1e-4;

const TRANSFORM: usize = 512;
const PRE_EMPHASIS: f32 = 0.97;
const LOWEST_HZ: f64 = 130.0;
const HIGHEST_HZ: f64 = 6_800.0;

/// Converts samples to mel spectra, block by block.
pub(crate) struct MelFrontEnd {
    window: Vec<f32>,
    bands: Vec<Band>,
    /// The samples from the start of the next frame on, with pre-emphasis.
    pending: Vec<f32>,
    /// The last sample, before pre-emphasis.
    last: f32,
}

/// A triangle over the bins of the transform.
struct Band {
    first: usize,
    weights: Vec<f32>,
}

impl MelFrontEnd {
    pub(crate) fn new() -> MelFrontEnd {
        #[expect(clippy::cast_possible_truncation, reason = "coefficients are single")]
        let window =
            (0..WINDOW).map(|i| (0.54 - 0.46 * libm::cos(2.0 * PI * i as f64 / (WINDOW - 1) as f64)) as f32).collect();
        MelFrontEnd { window, bands: bands(), pending: Vec::new(), last: 0.0 }
    }

    /// Processes samples (from -32768 to 32767), and passes the spectrum of each complete frame to `take`.
    pub(crate) fn push(&mut self, samples: &[f32], mut take: impl FnMut(Spectrum)) {
        for &sample in samples {
            self.pending.push(sample - PRE_EMPHASIS * self.last);
            self.last = sample;
        }
        let mut start = 0;
        while let Some(frame) = self.pending.get(start..start + WINDOW) {
            take(self.spectrum(frame));
            start += HOP;
        }
        self.pending.drain(..start);
    }

    fn spectrum(&self, frame: &[f32]) -> Spectrum {
        let mut buffer = [0.0; TRANSFORM];
        for ((slot, sample), weight) in buffer.iter_mut().zip(frame).zip(&self.window) {
            *slot = sample * weight;
        }
        let spectrum = rfft_512(&mut buffer);
        let mut power = [0.0; TRANSFORM / 2];
        for (power, bin) in power.iter_mut().zip(spectrum.iter()) {
            *power = bin.re * bin.re + bin.im * bin.im;
        }
        std::array::from_fn(|band| {
            let Some(Band { first, weights }) = self.bands.get(band) else { return 0 };
            let power: f32 = power.iter().skip(*first).zip(weights).map(|(power, weight)| power * weight).sum();
            #[expect(
                clippy::cast_possible_truncation,
                reason = "from -9.2 to 31 nats; floats beyond become the nearest"
            )]
            let steps = libm::rintf(libm::logf(power + LEAST_POWER) * STEPS) as i16;
            steps
        })
    }
}

/// Returns the logarithm of the power in a band, in nats.
pub(crate) fn logarithm_of(band: i16) -> f32 {
    f32::from(band) / STEPS
}

/// Returns the power of white noise of variance 1 in each band.
pub(crate) fn white_noise() -> [f32; BANDS] {
    let front_end = MelFrontEnd::new();
    let energy: f32 = front_end.window.iter().map(|weight| weight * weight).sum();
    let emphasis = f64::from(PRE_EMPHASIS);
    let power = |bin: usize| {
        let angle = 2.0 * PI * bin as f64 / TRANSFORM as f64;
        #[expect(clippy::cast_possible_truncation, reason = "spectra are single")]
        let response = (1.0 + emphasis * emphasis - 2.0 * emphasis * libm::cos(angle)) as f32;
        energy * response
    };
    std::array::from_fn(|band| {
        let Some(Band { first, weights }) = front_end.bands.get(band) else { return 0.0 };
        weights.iter().zip(*first..).map(|(weight, bin)| weight * power(bin)).sum()
    })
}

/// Returns the bands: half-overlapping triangles of equal width in mel.
fn bands() -> Vec<Band> {
    let bin_hz = f64::from(RATE_HZ) / TRANSFORM as f64;
    let (low, high) = (mel(LOWEST_HZ), mel(HIGHEST_HZ));
    // The model requires edges rounded to bins.
    let edge = |i: usize| {
        let hz = hertz(low + (high - low) * i as f64 / (BANDS + 1) as f64);
        libm::floor(hz / bin_hz + 0.5) * bin_hz
    };
    (0..BANDS)
        .map(|band| {
            let (left, centre, right) = (edge(band), edge(band + 1), edge(band + 2));
            let height = 2.0 / (right - left); // unit area
            let bins = 0..TRANSFORM / 2;
            let weight = |bin: usize| {
                let hz = bin as f64 * bin_hz;
                let rising = (hz - left) / (centre - left);
                let falling = (right - hz) / (right - centre);
                height * rising.min(falling).max(0.0)
            };
            let first = bins.clone().find(|&bin| weight(bin) > 0.0).unwrap_or(0);
            #[expect(clippy::cast_possible_truncation, reason = "coefficients are single")]
            let weights = (first..bins.end).map(weight).take_while(|&weight| weight > 0.0).map(|w| w as f32).collect();
            Band { first, weights }
        })
        .collect()
}

/// Returns the frequency of the centre of a band, in hertz.
pub(crate) fn centre_hz(band: usize) -> f64 {
    let (low, high) = (mel(LOWEST_HZ), mel(HIGHEST_HZ));
    hertz(low + (high - low) * (band + 1) as f64 / (BANDS + 1) as f64)
}

/// Returns the number of the band at a frequency, with the part of the way to the next.
pub(crate) fn band_at(hz: f64) -> f64 {
    let (low, high) = (mel(LOWEST_HZ), mel(HIGHEST_HZ));
    (mel(hz) - low) / (high - low) * (BANDS + 1) as f64 - 1.0
}

/// Returns the mel value of Davis and Mermelstein, as in CMU Sphinx.
fn mel(hz: f64) -> f64 {
    2595.0 * libm::log10(1.0 + hz / 700.0)
}

fn hertz(mel: f64) -> f64 {
    700.0 * (libm::pow(10.0, mel / 2595.0) - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectra(samples: &[f32], block: usize) -> Vec<Spectrum> {
        let mut front_end = MelFrontEnd::new();
        let mut spectra = Vec::new();
        for block in samples.chunks(block) {
            front_end.push(block, |spectrum| spectra.push(spectrum));
        }
        spectra
    }

    fn tone(hz: f32, samples: usize) -> Vec<f32> {
        let step = std::f32::consts::TAU * hz / 16_000.0;
        (0..samples).map(|i| 10_000.0 * libm::sinf(step * i as f32)).collect()
    }

    #[test]
    fn a_tone_is_loudest_in_its_band() {
        for (hz, band) in [(200.0, 0), (1_000.0, 8), (3_000.0, 17), (6_000.0, 23)] {
            let spectrum = spectra(&tone(hz, 4_000), 4_000)[10];
            let loudest = (0..BANDS).max_by_key(|&band| spectrum[band]);
            assert!(loudest.is_some_and(|found| found.abs_diff(band) <= 1), "{hz}: {loudest:?}");
        }
    }

    #[test]
    fn frames_come_every_ten_milliseconds_whatever_the_blocks() {
        let samples = tone(440.0, 16_000);
        let whole = spectra(&samples, 16_000);
        assert_eq!(whole.len(), (16_000 - WINDOW) / HOP + 1);
        for block in [1, 33, 160, 1_000] {
            assert_eq!(spectra(&samples, block), whole, "{block}");
        }
    }

    #[test]
    fn bands_have_unit_area_and_cover_the_range() {
        let bands = bands();
        assert_eq!(bands.len(), BANDS);
        for band in &bands {
            let area: f32 = band.weights.iter().sum::<f32>() * RATE_HZ as f32 / TRANSFORM as f32;
            assert!((area - 1.0).abs() < 0.02, "{area}");
        }
        assert!(bands.windows(2).all(|pair| pair[0].first < pair[1].first));
    }

    #[test]
    fn silence_and_the_loudest_noise_fit_the_numbers() {
        assert_eq!(spectra(&[0.0; 1_000], 1_000)[0], [-9_431; BANDS]);
        let square: Vec<f32> = (0..1_000).map(|i| if i % 16 < 8 { 32_767.0 } else { -32_768.0 }).collect();
        assert!(spectra(&square, 1_000)[0].iter().all(|&band| band > 0 && band < i16::MAX));
    }
}
