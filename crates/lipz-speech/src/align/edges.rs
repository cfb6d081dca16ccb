//! Where exactly each phone starts, once it is decided which phones there are.
//!
//! The best path is one of many that are nearly as likely, whose phones start a little earlier or later. Better than its
//! boundaries is their median over all paths: the time before which a phone has started as likely as not. It comes from the
//! forward-backward algorithm (L. Rabiner, "A tutorial on hidden Markov models", 1989), near the best path.

use super::emission::scores_near;
use super::history::Step;
use crate::Phone;
use crate::features::cepstra::{Frame, Vectors};
use crate::model::{Model, STATES};
use std::ops::Range;

/// How many frames from the best path a boundary may be.
const REACH: usize = 12;
/// What the scores of frames count. Neighbouring frames share samples, and so say the same several times: as they are, scores
/// would make the best path seem certain. A tenth to a half do equally well.
const SCALE: f32 = 0.25;
/// How much more likely a phone starts where the spectrum changes: this power of the change. From a half to one does equally
/// well.
const CHANGE_POWER: f32 = 0.7;
/// The least change that counts: nothing changes in digital silence.
const LEAST_CHANGE: f32 = 0.03;
/// The most frames that are looked at together.
const MOST_FRAMES: usize = 1_000;

/// The starts of `steps`, which are of these `phones`, in frames.
pub(super) fn starts(model: &Model, mut vectors: Vectors<'_>, phones: &[Phone], steps: &[Step]) -> Vec<f64> {
    let mut starts: Vec<f64> = steps.iter().map(|step| step.start as f64).collect();
    let (mut first, mut now) = (0, 0);
    while first + 1 < steps.len() {
        // Between the first and the last step are all boundaries of a part; within these two, it is certain where the path is.
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
        let part = Part { model, phones: &phones[first..=last], steps: &steps[first..=last], from };
        if let Some(medians) = part.medians(&frames) {
            starts[first + 1..=last].copy_from_slice(&medians);
        }
        first = last;
    }
    starts
}

/// The frames of a step that are too far from its ends for another phone; if there are none, its middle.
fn middle(step: &Step) -> Range<usize> {
    let middle = (step.start + step.end) / 2;
    middle.min(step.start + REACH)..middle.max(step.end.saturating_sub(REACH))
}

/// A part of a sound, with the phones in it. It starts in the first of them and ends in the last.
struct Part<'a> {
    model: &'a Model,
    phones: &'a [Phone],
    steps: &'a [Step],
    /// Its first frame.
    from: usize,
}

/// What is known of a frame. States are counted from the first of the step `low`.
struct Row {
    low: usize,
    /// By state: how likely the frame is in it.
    likelihoods: Vec<f64>,
    /// By state: how probable it is, given this frame and those before.
    forward: Vec<f64>,
    /// How much more likely a phone starts in this frame than in others.
    change: f64,
}

impl Row {
    /// The number of a state of the part in this row.
    fn index(&self, state: usize) -> Option<usize> {
        state.checked_sub(self.low * STATES)
    }

    /// How much more likely a state is entered in this frame: the first states of phones where the spectrum changes.
    fn entering(&self, state: usize) -> f64 {
        if state.is_multiple_of(STATES) { self.change } else { 1.0 }
    }
}

impl Part<'_> {
    /// Where each phone but the first starts, in frames of the sound; nothing if no path comes through.
    fn medians(&self, frames: &[Frame]) -> Option<Vec<f64>> {
        let (stay, leave) = (self.chances(&self.model.stay), self.chances(&self.model.leave));
        let mut rows: Vec<Row> = Vec::with_capacity(frames.len());
        let mut steps = 0..0;
        for (t, frame) in (self.from..).zip(frames) {
            let is_over = |step: &Step| step.end + REACH <= t;
            steps.start +=
                self.steps[steps.start..self.steps.len() - 1].iter().take_while(|step| is_over(step)).count();
            steps.end = steps.end.max(steps.start);
            steps.end += self.steps[steps.end..].iter().take_while(|step| step.start <= t + REACH).count();
            let mut row = Row {
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

    /// By state of the part, probabilities of which the model knows the logarithms.
    fn chances(&self, logarithms: &[f32]) -> Vec<f64> {
        let of_phone = |phone: &Phone| &logarithms[phone.index() * STATES..][..STATES];
        self.phones.iter().flat_map(of_phone).map(|&logarithm| libm::exp(f64::from(logarithm))).collect()
    }

    /// How likely a frame is in the states of these steps, compared to the most likely.
    fn likelihoods(&self, frame: &Frame, steps: Range<usize>) -> Vec<f64> {
        let scores = scores_near(self.model, frame, &self.phones[steps]);
        let best = scores.iter().copied().fold(f32::MIN, f32::max);
        scores.iter().map(|score| libm::exp(f64::from((score - best) * SCALE))).collect()
    }

    fn forward(&self, row: &Row, before: Option<&Row>, stay: &[f64], leave: &[f64]) -> Option<Vec<f64>> {
        let chance = |(state, likelihood): (usize, &f64)| match before {
            // It starts in the first phone; the sound, in its first state.
            None => f64::from(u8::from(state == 0 || (state < STATES && self.from > 0))) * likelihood,
            Some(before) => {
                let at = |state: usize| before.index(state).and_then(|index| before.forward.get(index)).copied();
                let entered = state.checked_sub(1).and_then(|last| Some(at(last)? * leave[last] * row.entering(state)));
                (at(state).unwrap_or(0.0) * stay[state] + entered.unwrap_or(0.0)) * likelihood
            }
        };
        normal((row.low * STATES..).zip(&row.likelihoods).map(chance).collect())
    }

    /// Goes through the frames from the last to the first; wherever it becomes less likely than not that a phone has started,
    /// that is its median.
    fn backward(&self, rows: &[Row], stay: &[f64], leave: &[f64]) -> Option<Vec<f64>> {
        let mut medians = vec![None; self.steps.len()];
        // By step: the probability that it has started, in the frame after this.
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

/// Makes the sum of numbers 1; nothing if it is 0.
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

    /// Sounds that change from one to another every so many frames.
    fn spectrum(lengths: &[usize]) -> Vec<Spectrum> {
        let sound = |number: usize| -> Spectrum {
            std::array::from_fn(|band| if band % 3 == number % 3 { 14_000 } else { 9_000 })
        };
        lengths.iter().enumerate().flat_map(|(number, &length)| vec![sound(number); length]).collect()
    }

    fn steps(lengths: &[usize]) -> Vec<Step> {
        let mut start = 0;
        let step = |(node, &length): (usize, &usize)| {
            start += length;
            Step { node, start: start - length, end: start }
        };
        lengths.iter().enumerate().map(step).collect()
    }

    fn starts_of(lengths: &[usize]) -> Vec<f64> {
        let spectrum = spectrum(lengths);
        let phones: Vec<Phone> =
            [Phone::Sil, Phone::Aa, Phone::S, Phone::Iy].into_iter().cycle().take(lengths.len()).collect();
        starts(Model::english(), Vectors::new(&spectrum), &phones, &steps(lengths))
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
        let spectrum = [vec![silence; 30], vec![vowel; 30], vec![silence; 30]].concat();
        // A path that is six frames late, then five early.
        let starts = starts(
            Model::english(),
            Vectors::new(&spectrum),
            &[Phone::Sil, Phone::Aa, Phone::Sil],
            &steps(&[36, 19, 35]),
        );
        assert!((starts[1] - 30.0).abs() < 3.0 && (starts[2] - 60.0).abs() < 3.0, "{starts:?}");
    }
}
