//! The spectrum that the network reads: the logarithm of the power in 80 bands, every 10 milliseconds.
//!
//! Windows of 25 milliseconds (Hann), centred on the frame. At both ends, the audio is mirrored.

use super::math::Matrix;
use std::f64::consts::PI;

/// The number of bands, and of the transform's bins from which they are computed.
pub(super) const MELS: usize = 80;
pub(super) const BINS: usize = WINDOW / 2 + 1;
/// The samples in a window, and from one window to the next, at 16,000 per second.
const WINDOW: usize = 400;
const HOP: usize = 160;
/// The least power in a band.
const LEAST: f32 = 1e-10;
/// The number of windows that are transformed at a time.
const BLOCK: usize = 64;

/// Converts samples to spectra, block by block.
pub(super) struct Spectra {
    /// The real and imaginary parts of each bin of a window.
    transform: Matrix,
    /// The samples from the start of the next window on.
    pending: Vec<f32>,
    started: bool,
}

impl Spectra {
    pub(super) fn new() -> Spectra {
        #[expect(clippy::cast_possible_truncation, reason = "coefficients are single")]
        let part = |sample: usize, part: usize| {
            let hann = 0.5 - 0.5 * libm::cos(2.0 * PI * sample as f64 / WINDOW as f64);
            // The angle is reduced with integers, so that it is exact.
            let angle = 2.0 * PI * (sample * (part % BINS) % WINDOW) as f64 / WINDOW as f64;
            (hann * if part < BINS { libm::cos(angle) } else { -libm::sin(angle) }) as f32
        };
        Spectra { transform: Matrix::of(WINDOW, 2 * BINS, part), pending: Vec::new(), started: false }
    }

    /// Processes samples from -1 to 1, and appends the bands of each complete window.
    pub(super) fn push(&mut self, samples: &[f32], bands: &Matrix, out: &mut Vec<f32>) {
        self.pending.extend_from_slice(samples);
        if !self.started && self.pending.len() > WINDOW / 2 {
            let mirrored: Vec<f32> = self.pending[1..=WINDOW / 2].iter().rev().copied().collect();
            self.pending.splice(..0, mirrored);
            self.started = true;
        }
        if self.started {
            self.windows(bands, out);
        }
    }

    /// Appends the bands of the last windows.
    pub(super) fn finish(&mut self, bands: &Matrix, out: &mut Vec<f32>) {
        if !self.started {
            // Too short to be mirrored, so it is padded with silence.
            self.pending.splice(..0, [0.0; WINDOW / 2]);
            self.started = true;
        }
        let end = self.pending.len();
        let mirrored: Vec<f32> = (2..=WINDOW / 2 + 1)
            .map(|back| end.checked_sub(back).and_then(|at| self.pending.get(at)).copied().unwrap_or(0.0))
            .collect();
        self.pending.extend(mirrored);
        self.windows(bands, out);
    }

    fn windows(&mut self, bands: &Matrix, out: &mut Vec<f32>) {
        let count = if self.pending.len() < WINDOW { 0 } else { (self.pending.len() - WINDOW) / HOP + 1 };
        for first in (0..count).step_by(BLOCK) {
            let windows = first..(first + BLOCK).min(count);
            let samples: Vec<f32> =
                windows.flat_map(|window| self.pending[window * HOP..][..WINDOW].iter().copied()).collect();
            let parts = self.transform.product(&samples);
            let power = |parts: &[f32]| -> Vec<f32> {
                let (real, imaginary) = parts.split_at(BINS);
                real.iter().zip(imaginary).map(|(real, imaginary)| real * real + imaginary * imaginary).collect()
            };
            let powers: Vec<f32> = parts.chunks_exact(2 * BINS).flat_map(power).collect();
            out.extend(bands.product(&powers).into_iter().map(|power| libm::logf(power.max(LEAST))));
        }
        self.pending.drain(..count * HOP);
    }
}
