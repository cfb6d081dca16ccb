//! Mel cepstra and their changes: the vectors that the acoustic model scores.
//!
//! As in CMU Sphinx: cosine transform of the logarithms, lifter, and subtraction of the mean over the whole recording.
//! Each of the three streams has 13 values.

use super::floor::Floor;
use super::mel::BANDS;
use super::noise::NoiseTracker;
use super::spectrogram::{Spectrogram, SpectrogramFrames};
use super::warp::Warp;
use std::f64::consts::PI;

/// The number of coefficients of a cepstrum.
pub(crate) const COEFFICIENTS: usize = 13;
/// The number of values of a vector: cepstrum, change, change of the change.
pub(crate) const NUMBERS: usize = 3 * COEFFICIENTS;

pub(crate) type Cepstrum = [f32; COEFFICIENTS];

const LIFTER: f64 = 22.0;
/// The frames before and after that the changes need.
pub(crate) const REACH: usize = 3;
pub(crate) const RING: usize = 2 * REACH + 1;

/// Iterates over the vectors of a recording, without storing them.
#[derive(Clone)]
pub(crate) struct Vectors<'a> {
    cepstra: Cepstra<'a>,
    count: usize,
    means: Cepstrum,
    quiet: f32,
    loud: f32,
    /// Cepstra of the frames around the next, by their index modulo `RING`.
    ring: [Cepstrum; RING],
    made: usize,
    next: usize,
}

/// The features of a frame.
pub(crate) struct Frame {
    pub(crate) vector: [f32; NUMBERS],
    /// The loudness: 0 is that of the quiet frames of the recording, 1 that of the loud ones.
    pub(crate) loudness: f32,
}

impl Frame {
    /// Returns the change of the spectrum, independent of loudness: the length of the change vector over 40
    /// milliseconds.
    pub(crate) fn change(&self) -> f32 {
        let change = &self.vector[COEFFICIENTS + 1..2 * COEFFICIENTS];
        libm::sqrtf(change.iter().map(|number| number * number).sum())
    }
}

impl<'a> Vectors<'a> {
    /// Returns the vectors of the frames of `spectrum`, for a voice of this size.
    pub(crate) fn new(spectrum: &'a Spectrogram, warp: Warp) -> Vectors<'a> {
        let floor = Floor::new(spectrum);
        let mut sums = [0.0_f64; COEFFICIENTS];
        let mut loudness = Vec::with_capacity(spectrum.len());
        for cepstrum in Cepstra::new(spectrum, floor, warp) {
            for (sum, number) in sums.iter_mut().zip(&cepstrum) {
                *sum += f64::from(*number);
            }
            loudness.push(cepstrum[0]);
        }
        let count = spectrum.len();
        #[expect(clippy::cast_possible_truncation, reason = "cepstra are single")]
        let means = sums.map(|sum| (sum / count.max(1) as f64) as f32);
        loudness.sort_unstable_by(f32::total_cmp);
        let share = |percent: usize| loudness.get(count.saturating_sub(1) * percent / 100).copied().unwrap_or(0.0);
        Vectors {
            cepstra: Cepstra::new(spectrum, floor, warp),
            count,
            means,
            quiet: share(5) - means[0],
            loud: share(95) - means[0],
            ring: [[0.0; COEFFICIENTS]; RING],
            made: 0,
            next: 0,
        }
    }

    /// Returns the cepstrum of a frame around the next, which is that with the number `REACH`. The first and the last
    /// frame are repeated beyond the ends.
    fn cepstrum(&self, around: usize) -> &Cepstrum {
        let frame = (self.next + around).saturating_sub(REACH).min(self.count - 1);
        &self.ring[frame % RING]
    }
}

impl Iterator for Vectors<'_> {
    type Item = Frame;

    fn next(&mut self) -> Option<Frame> {
        if self.next >= self.count {
            return None;
        }
        while self.made < self.count && self.made <= self.next + REACH {
            let cepstrum = self.cepstra.next()?;
            self.ring[self.made % RING] = std::array::from_fn(|i| cepstrum[i] - self.means[i]);
            self.made += 1;
        }
        let vector = vector(|frame| self.cepstrum(frame));
        let loudness = (vector[0] - self.quiet) / (self.loud - self.quiet).max(1e-3);
        self.next += 1;
        Some(Frame { vector, loudness })
    }
}

/// The cepstra of a recording, before their mean is subtracted.
#[derive(Clone)]
struct Cepstra<'a> {
    bands: CleanBands<'a>,
    transform: Transform,
}

impl<'a> Cepstra<'a> {
    fn new(spectrum: &'a Spectrogram, floor: Floor, warp: Warp) -> Cepstra<'a> {
        Cepstra { bands: CleanBands::new(spectrum, floor), transform: Transform::new(warp) }
    }
}

impl Iterator for Cepstra<'_> {
    type Item = Cepstrum;

    fn next(&mut self) -> Option<Cepstrum> {
        self.bands.next().map(|bands| self.transform.cepstrum(&bands))
    }
}

/// The logarithm of the power in each band, without noise.
#[derive(Clone)]
pub(crate) struct CleanBands<'a> {
    spectrum: SpectrogramFrames<'a>,
    floor: Floor,
    noise: NoiseTracker,
}

impl<'a> CleanBands<'a> {
    pub(crate) fn new(spectrum: &'a Spectrogram, floor: Floor) -> CleanBands<'a> {
        CleanBands { spectrum: spectrum.iter(), floor, noise: NoiseTracker::default() }
    }
}

impl Iterator for CleanBands<'_> {
    type Item = [f32; BANDS];

    fn next(&mut self) -> Option<[f32; BANDS]> {
        let power = self.noise.clean(self.floor.raise(&self.spectrum.next()?));
        Some(power.map(libm::logf))
    }
}

/// The linear map from bands to cepstra: warp, orthonormal cosine transform and lifter.
#[derive(Clone)]
pub(crate) struct Transform(Vec<[f32; BANDS]>);

impl Transform {
    pub(crate) fn new(warp: Warp) -> Transform {
        Transform(transform().iter().map(|weights| warp.weights(weights)).collect())
    }

    pub(crate) fn cepstrum(&self, bands: &[f32; BANDS]) -> Cepstrum {
        let mut cepstrum = [0.0; COEFFICIENTS];
        for (number, weights) in cepstrum.iter_mut().zip(&self.0) {
            *number = bands.iter().zip(weights).map(|(band, weight)| band * weight).sum();
        }
        cepstrum
    }
}

/// Returns the vector of a frame from its cepstrum and those of the frames around it, without their mean.
pub(crate) fn vector<'c>(cepstrum: impl Fn(usize) -> &'c Cepstrum) -> [f32; NUMBERS] {
    let mut vector = [0.0; NUMBERS];
    for i in 0..COEFFICIENTS {
        let at = |frame: usize| cepstrum(frame)[i];
        vector[i] = at(REACH);
        vector[COEFFICIENTS + i] = at(REACH + 2) - at(REACH - 2);
        vector[2 * COEFFICIENTS + i] = (at(REACH + 3) - at(REACH - 1)) - (at(REACH + 1) - at(REACH - 3));
    }
    vector
}

/// Returns the logarithm of the factor by which a warp changes volumes in the space of cepstra. Warping averages
/// neighbouring bands, which alone makes vectors more likely. With this term, likelihoods of warps are comparable
/// (M. Pitz and H. Ney, "Vocal tract normalization equals linear transformation in cepstral space", 2005).
pub(crate) fn log_volume(warp: Warp) -> f32 {
    let rows = transform();
    let product = |one: &[f32; BANDS], other: &[f32; BANDS]| -> f64 {
        one.iter().zip(other).map(|(one, other)| f64::from(*one) * f64::from(*other)).sum()
    };
    // The rows are orthogonal, and the lifter cancels out.
    let of_row = |row: &[f32; BANDS]| -> [f64; COEFFICIENTS] {
        let warped = warp.weights(row);
        std::array::from_fn(|column| product(&warped, &rows[column]) / product(&rows[column], &rows[column]))
    };
    let matrix = rows.iter().map(of_row).collect();
    #[expect(clippy::cast_possible_truncation, reason = "likelihoods are single")]
    let volume = log_determinant(matrix) as f32;
    volume
}

/// Returns the logarithm of the absolute value of a determinant, by Gaussian elimination.
fn log_determinant(mut rows: Vec<[f64; COEFFICIENTS]>) -> f64 {
    let mut sum = 0.0;
    for pivot in 0..COEFFICIENTS {
        let largest = (pivot..COEFFICIENTS).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()));
        rows.swap(pivot, largest.unwrap_or(pivot));
        let (done, rest) = rows.split_at_mut(pivot + 1);
        let first = done[pivot];
        sum += libm::log(first[pivot].abs());
        for row in rest {
            let share = row[pivot] / first[pivot];
            row.iter_mut().zip(&first).for_each(|(number, first)| *number -= share * first);
        }
    }
    sum
}

/// Returns the orthonormal cosine transform and the lifter, combined in one table.
fn transform() -> Vec<[f32; BANDS]> {
    #[expect(clippy::cast_possible_truncation, reason = "coefficients are single")]
    let row = |i: usize| -> [f32; BANDS] {
        let norm = libm::sqrt(if i == 0 { 1.0 } else { 2.0 } / BANDS as f64);
        let lift = 1.0 + LIFTER / 2.0 * libm::sin(PI * i as f64 / LIFTER);
        std::array::from_fn(|band| (norm * lift * libm::cos(PI * i as f64 * (band as f64 + 0.5) / BANDS as f64)) as f32)
    };
    (0..COEFFICIENTS).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(frames: i16) -> Spectrogram {
        let band = |t: i16, band: usize| 8_000 + 40 * (t % 13) * [0, 1, 2, 3, 4][band % 5];
        (0..frames).map(|t| std::array::from_fn(|number| band(t, number))).collect::<Vec<_>>().into()
    }

    #[test]
    fn every_frame_has_a_vector_whose_mean_is_zero() {
        let spectrum = ramp(100);
        let vectors: Vec<Frame> = Vectors::new(&spectrum, Warp::NONE).collect();
        assert_eq!(vectors.len(), 100);
        for i in 0..COEFFICIENTS {
            let mean = vectors.iter().map(|frame| frame.vector[i]).sum::<f32>() / 100.0;
            assert!(mean.abs() < 1e-3, "{i}: {mean}");
        }
    }

    #[test]
    fn changes_are_differences_of_neighbours() {
        let spectrum = ramp(30);
        let vectors: Vec<Frame> = Vectors::new(&spectrum, Warp::NONE).collect();
        for i in 0..COEFFICIENTS {
            let at = |t: usize| vectors[t].vector[i];
            let close = |a: f32, b: f32| (a - b).abs() < 1e-3;
            assert!(close(vectors[10].vector[13 + i], at(12) - at(8)), "{i}");
            assert!(close(vectors[10].vector[26 + i], at(13) - at(9) - at(11) + at(7)), "{i}");
            assert!(close(vectors[0].vector[13 + i], at(2) - at(0)), "{i}: the first frame stands for those before it");
        }
    }

    #[test]
    fn averaging_bands_makes_volumes_smaller() {
        assert!(log_volume(Warp::NONE).abs() < 1e-6);
        for factor in [0.7, 0.94, 1.06, 1.3] {
            assert!(log_volume(Warp::new(factor)) < -0.1, "{factor}: {}", log_volume(Warp::new(factor)));
        }
    }

    #[test]
    fn short_and_silent_sounds_are_no_trouble() {
        for spectrum in [vec![], vec![[0; BANDS]], vec![[-9_000; BANDS]; 5]] {
            for frame in Vectors::new(&spectrum.into(), Warp::NONE) {
                assert!(frame.vector.iter().all(|number| number.is_finite()));
            }
        }
    }
}
