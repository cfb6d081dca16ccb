//! The exact starts of phones, once the sequence of phones is decided.
//!
//! The best path is one of many that are nearly as likely, whose phones start a little earlier or later. The median
//! over all paths is more accurate than the boundaries of the best one: it is the time before which a phone has started
//! with a probability of one half. It comes from the forward-backward algorithm (L. Rabiner, "A tutorial on hidden
//! Markov models", 1989), near the best path.

use super::emission::scores_near;
use super::history::PathStep;
use crate::Phone;
use crate::features::cepstra::{Frame, Vectors};
use crate::model::{Model, STATES};
use std::ops::Range;

/// The largest distance of a boundary from the best path, in frames.
const REACH: usize = 12;
/// The weight of the scores of frames. Neighbouring frames share samples, so their scores repeat the same evidence.
/// Unscaled, they would make the best path seem certain. Weights from 0.1 to 0.5 work equally well.
const SCALE: f32 = 0.25;
/// A phone is more likely to start where the spectrum changes: by this power of the change. Powers from 0.5 to 1 work
/// equally well.
const CHANGE_POWER: f32 = 0.7;
/// The least change that counts, because nothing changes in digital silence.
const LEAST_CHANGE: f32 = 0.03;
/// The most frames that are processed together.
const MOST_FRAMES: usize = 1_000;

/// Returns the starts of `steps`, in frames. Their phones are `phones`.
pub(super) fn starts(model: &Model, mut vectors: Vectors<'_>, phones: &[Phone], steps: &[PathStep]) -> Vec<f64> {
    let mut starts: Vec<f64> = steps.iter().map(|step| step.start as f64).collect();
    let (mut first, mut now) = (0, 0);
    while first + 1 < steps.len() {
        // All boundaries of a part are between its first and last step. Within these two, the path is certain.
        let from = if first == 0 && steps[0].end <= 2 * REACH { 0 } else { middle(&steps[first]).end };
        let fits = |last: &usize| middle(&steps[*last]).start <= from + MOST_FRAMES;
        let last = (first + 2..steps.len()).take_while(fits).last().unwrap_or(first + 1);
        let to = if last + 1 == steps.len() {
            steps[last].end.min(steps[last].start + REACH)
        } else {
            middle(&steps[last]).start
        };
        let frames: Vec<Frame> = vectors.by_ref().skip(from - now).take(to - from).collect();
        now = to;
        let part = AudioPart { model, phones: &phones[first..=last], steps: &steps[first..=last], from };
        if let Some(medians) = part.medians(&frames) {
            starts[first + 1..=last].copy_from_slice(&medians);
        }
        first = last;
    }
    starts
}

/// Returns the frames of a step that are too far from its ends for another phone, or its middle if there are none.
fn middle(step: &PathStep) -> Range<usize> {
    let middle = (step.start + step.end) / 2;
    middle.min(step.start + REACH)..middle.max(step.end.saturating_sub(REACH))
}

/// A part of the audio, with its phones. It starts in the first of them and ends in the last.
struct AudioPart<'a> {
    model: &'a Model,
    phones: &'a [Phone],
    steps: &'a [PathStep],
    /// The first frame of the part.
    from: usize,
}

/// The probabilities of a frame. States are counted from the first of the step `low`.
struct EdgeFrame {
    low: usize,
    /// By state: the likelihood of the frame.
    likelihoods: Vec<f64>,
    /// By state: its probability, given this frame and those before.
    forward: Vec<f64>,
    /// The relative probability that a phone starts in this frame.
    change: f64,
}

impl EdgeFrame {
    /// Returns the index in this row of a state of the part.
    fn index(&self, state: usize) -> Option<usize> {
        state.checked_sub(self.low * STATES)
    }

    /// Returns the relative probability of entering a state in this frame. Only the first state of a phone depends on
    /// the change of the spectrum.
    fn entering(&self, state: usize) -> f64 {
        if state.is_multiple_of(STATES) { self.change } else { 1.0 }
    }
}

impl AudioPart<'_> {
    /// Returns the start of each phone except the first, in frames of the audio; `None` if no path is possible.
    fn medians(&self, frames: &[Frame]) -> Option<Vec<f64>> {
        let (stay, leave) = (self.chances(&self.model.stay), self.chances(&self.model.leave));
        let mut rows: Vec<EdgeFrame> = Vec::with_capacity(frames.len());
        let mut steps = 0..0;
        for (t, frame) in (self.from..).zip(frames) {
            let is_over = |step: &PathStep| step.end + REACH <= t;
            steps.start +=
                self.steps[steps.start..self.steps.len() - 1].iter().take_while(|step| is_over(step)).count();
            steps.end = steps.end.max(steps.start);
            steps.end += self.steps[steps.end..].iter().take_while(|step| step.start <= t + REACH).count();
            let mut row = EdgeFrame {
                low: steps.start,
                likelihoods: self.likelihoods(frame, steps.clone()),
                forward: Vec::new(),
                change: f64::from(libm::powf(frame.change().max(LEAST_CHANGE), CHANGE_POWER)),
            };
            row.forward = self.forward(&row, rows.last(), &stay, &leave)?;
            rows.push(row);
        }
        self.backward(&rows, &stay, &leave)
    }

    /// Returns probabilities by state of the part, from the model's logarithms.
    fn chances(&self, logarithms: &[f32]) -> Vec<f64> {
        let of_phone = |phone: &Phone| &logarithms[phone.index() * STATES..][..STATES];
        self.phones.iter().flat_map(of_phone).map(|&logarithm| libm::exp(f64::from(logarithm))).collect()
    }

    /// Returns the likelihoods of a frame in the states of these steps, relative to the highest.
    fn likelihoods(&self, frame: &Frame, steps: Range<usize>) -> Vec<f64> {
        let scores = scores_near(self.model, frame, &self.phones[steps]);
        let best = scores.iter().copied().fold(f32::MIN, f32::max);
        scores.iter().map(|score| libm::exp(f64::from((score - best) * SCALE))).collect()
    }

    fn forward(&self, row: &EdgeFrame, before: Option<&EdgeFrame>, stay: &[f64], leave: &[f64]) -> Option<Vec<f64>> {
        let chance = |(state, likelihood): (usize, &f64)| match before {
            // The part starts in its first phone. The audio starts in the first state.
            None => f64::from(u8::from(state == 0 || (state < STATES && self.from > 0))) * likelihood,
            Some(before) => {
                let at = |state: usize| before.index(state).and_then(|index| before.forward.get(index)).copied();
                let entered = state.checked_sub(1).and_then(|last| Some(at(last)? * leave[last] * row.entering(state)));
                (at(state).unwrap_or(0.0) * stay[state] + entered.unwrap_or(0.0)) * likelihood
            }
        };
        normal((row.low * STATES..).zip(&row.likelihoods).map(chance).collect())
    }

    /// Iterates over the frames from last to first. The median of a phone is the frame in which the probability that it
    /// has started falls below one half.
    fn backward(&self, rows: &[EdgeFrame], stay: &[f64], leave: &[f64]) -> Option<Vec<f64>> {
        let mut medians = vec![None; self.steps.len()];
        // By step: the probability that it has started in the next frame.
        let mut later = vec![1.0; self.steps.len()];
        let mut backward: Vec<f64> = Vec::new();
        for (t, row) in rows.iter().enumerate().rev() {
            let states = row.low * STATES..row.low * STATES + row.forward.len();
            backward = normal(match rows.get(t + 1) {
                None => {
                    states.clone().map(|state| f64::from(u8::from(state / STATES + 1 == self.steps.len()))).collect()
                }
                Some(after) => {
                    let at = |state: usize| {
                        let index = after.index(state)?;
                        Some(backward.get(index)? * after.likelihoods.get(index)?)
                    };
                    let chance = |state: usize| {
                        let left = at(state + 1).unwrap_or(0.0) * leave[state] * after.entering(state + 1);
                        at(state).unwrap_or(0.0) * stay[state] + left
                    };
                    states.map(chance).collect()
                }
            })?;
            let chances =
                normal(row.forward.iter().zip(&backward).map(|(forward, backward)| forward * backward).collect())?;
            let mut started = 0.0;
            for step in (row.low + 1..self.steps.len()).rev() {
                let from = (step - row.low) * STATES;
                started += chances.get(from..from + STATES).map_or(0.0, |states| states.iter().sum::<f64>());
                if medians[step].is_none() && started < 0.5 {
                    let part = (0.5 - started) / (later[step] - started);
                    medians[step] = Some((self.from + t) as f64 + 0.5 + part);
                }
                later[step] = started;
            }
        }
        medians.into_iter().skip(1).collect()
    }
}

/// Scales numbers so that their sum is 1; `None` if it is 0.
fn normal(mut numbers: Vec<f64>) -> Option<Vec<f64>> {
    let sum: f64 = numbers.iter().sum();
    for number in &mut numbers {
        *number /= sum;
    }
    (sum > 0.0).then_some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::mel::{BANDS, Spectrum};
    use crate::features::spectrogram::Spectrogram;
    use crate::features::warp::Warp;

    /// Returns the spectra of sounds that change after so many frames.
    fn spectrum(lengths: &[usize]) -> Spectrogram {
        let sound = |number: usize| -> Spectrum {
            std::array::from_fn(|band| if band % 3 == number % 3 { 14_000 } else { 9_000 })
        };
        lengths.iter().enumerate().flat_map(|(number, &length)| vec![sound(number); length]).collect::<Vec<_>>().into()
    }

    fn steps(lengths: &[usize]) -> Vec<PathStep> {
        let mut start = 0;
        let step = |(node, &length): (usize, &usize)| {
            start += length;
            PathStep { node, start: start - length, end: start }
        };
        lengths.iter().enumerate().map(step).collect()
    }

    fn starts_of(lengths: &[usize]) -> Vec<f64> {
        let spectrum = spectrum(lengths);
        let phones: Vec<Phone> =
            [Phone::Sil, Phone::Aa, Phone::S, Phone::Iy].into_iter().cycle().take(lengths.len()).collect();
        starts(Model::english(), Vectors::new(&spectrum, Warp::NONE), &phones, &steps(lengths))
    }

    #[test]
    fn phones_start_near_the_best_path_one_after_the_other() {
        for lengths in
            [&[20, 8, 9, 30][..], &[3, 3, 3, 3, 3], &[400, 10, 2_000, 5], &[12; 300], &[7, 1], &[1, 1, 1], &[5], &[]]
        {
            let starts = starts_of(lengths);
            assert_eq!(starts.len(), lengths.len());
            for (start, step) in starts.iter().zip(steps(lengths)) {
                assert!((start - step.start as f64).abs() <= REACH as f64 + 0.5, "{lengths:?} {starts:?}");
            }
            assert!(starts.is_sorted(), "{lengths:?} {starts:?}");
        }
    }

    #[test]
    fn boundaries_move_to_where_the_sound_changes() {
        let silence = [2_000; BANDS];
        let vowel: Spectrum = std::array::from_fn(|band| [15_000, 13_000, 11_000][band / 9]);
        let spectrum = [vec![silence; 30], vec![vowel; 30], vec![silence; 30]].concat().into();
        // A path that is six frames late, then five frames early.
        let starts = starts(
            Model::english(),
            Vectors::new(&spectrum, Warp::NONE),
            &[Phone::Sil, Phone::Aa, Phone::Sil],
            &steps(&[36, 19, 35]),
        );
        assert!((starts[1] - 30.0).abs() < 3.0 && (starts[2] - 60.0).abs() < 3.0, "{starts:?}");
    }
}
