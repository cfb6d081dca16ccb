//! The size of a voice: the warp with which the audio is most likely.

use super::history::PathStep;
use crate::features::cepstra::{Cepstrum, CleanBands, REACH, RING, Transform, log_volume, vector};
use crate::features::floor::{Floor, level};
use crate::features::mel::BANDS;
use crate::features::spectrogram::Spectrogram;
use crate::features::warp::Warp;
use crate::model::{Model, STREAM_WEIGHTS};
use crate::{Phone, Sound};

/// The warps to choose from: 0.7 is a giant, 1.3 a small child.
const FACTORS: [f64; 11] = [1.0, 0.7, 0.76, 0.82, 0.88, 0.94, 1.06, 1.12, 1.18, 1.24, 1.3];
/// The most frames that are scored. With all frames, the share of right frames differs by at most 0.2 %.
const MOST_FRAMES: usize = 400;

/// A frame of speech: its phone, and the bands of the frames around it.
struct Sample {
    phone: Phone,
    bands: [[f32; BANDS]; RING],
}

/// Returns the warp that makes `steps`, the best path of the mean voice, most likely. `phone_of` returns the phone of a
/// step.
///
/// Only the linear map from bands to cepstra depends on the warp, so that all warps together take about as much time
/// as a second of audio in an alignment.
pub(super) fn warp(model: &Model, sound: &Sound, steps: &[PathStep], phone_of: impl Fn(&PathStep) -> Phone) -> Warp {
    let spectrum = sound.spectrum();
    let spoken = steps.iter().filter(|step| phone_of(step).is_speech());
    let frames = loud(spectrum, spoken.flat_map(|step| (step.start..step.end).map(|frame| (frame, phone_of(step)))));
    let (samples, means) = samples(spectrum, &frames);
    let likelihood = |factor: &f64| {
        let warp = Warp::new(*factor);
        let transform = Transform::new(warp);
        let mean = transform.cepstrum(&means);
        let of_sample = |sample: &Sample| {
            let cepstra = sample.bands.map(|bands| less(transform.cepstrum(&bands), &mean));
            let scores = model.score_phone(&vector(|frame| &cepstra[frame]), sample.phone.index());
            scores.into_iter().fold(f32::MIN, f32::max)
        };
        let sum: f32 = samples.iter().map(of_sample).sum();
        sum / samples.len().max(1) as f32 + STREAM_WEIGHTS.iter().sum::<f32>() * log_volume(warp)
    };
    let mut best = (f32::MIN, FACTORS[0]);
    for (value, factor) in FACTORS.iter().map(|factor| (likelihood(factor), *factor)) {
        if value > best.0 {
            best = (value, factor);
        }
    }
    Warp::new(best.1)
}

/// Returns the louder half of these frames, at regular intervals if they are many.
fn loud(spectrum: &Spectrogram, frames: impl Iterator<Item = (usize, Phone)>) -> Vec<(usize, Phone)> {
    let levels: Vec<i32> = spectrum.iter().map(|frame| level(&frame)).collect();
    let level = |frame: usize| levels.get(frame).copied().unwrap_or(i32::MIN);
    let frames: Vec<(usize, Phone)> = frames.collect();
    let mut levels: Vec<i32> = frames.iter().map(|(frame, _)| level(*frame)).collect();
    let middle = levels.len() / 2;
    let least = if levels.is_empty() { 0 } else { *levels.select_nth_unstable(middle).1 };
    let loud: Vec<(usize, Phone)> = frames.into_iter().filter(|(frame, _)| level(*frame) >= least).collect();
    let stride = loud.len().div_ceil(MOST_FRAMES).max(1);
    loud.into_iter().step_by(stride).collect()
}

/// Returns samples of these frames, and the mean of the bands of all frames.
fn samples(spectrum: &Spectrogram, frames: &[(usize, Phone)]) -> (Vec<Sample>, [f32; BANDS]) {
    let mut sums = [0.0_f64; BANDS];
    let mut around: Vec<[f32; BANDS]> = Vec::with_capacity(RING);
    let (mut samples, mut next) = (Vec::with_capacity(frames.len()), frames.iter().peekable());
    for (at, bands) in CleanBands::new(spectrum, Floor::new(spectrum)).enumerate() {
        sums.iter_mut().zip(&bands).for_each(|(sum, band)| *sum += f64::from(*band));
        if around.len() == RING {
            around.remove(0);
        }
        around.push(bands);
        // Frames at both ends, which lack neighbours, are left out.
        while let Some((_, phone)) = next.next_if(|(frame, _)| frame + REACH <= at) {
            if let Ok(bands) = around.as_slice().try_into() {
                samples.push(Sample { phone: *phone, bands });
            }
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "bands are single")]
    let means = sums.map(|sum| (sum / spectrum.len().max(1) as f64) as f32);
    (samples, means)
}

fn less(mut cepstrum: Cepstrum, mean: &Cepstrum) -> Cepstrum {
    cepstrum.iter_mut().zip(mean).for_each(|(number, mean)| *number -= mean);
    cepstrum
}
