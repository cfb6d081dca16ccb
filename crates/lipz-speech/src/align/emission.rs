//! The likelihood of each frame in each state, and the fit of the resulting phones.

use super::history::PathStep;
use crate::features::cepstra::Frame;
use crate::model::{STATES, Scores};
use crate::{Model, Phone};

/// Silence is more likely in quiet frames and less likely in loud ones: by so many nats per frame for a loudness of 1,
/// the loudness of loud frames.
const QUIET_NATS: f32 = 20.0;
/// The loudness that does not change the likelihood of silence.
const QUIET: f32 = 0.1;
/// The most that loudness adds to or subtracts from silence, in nats per frame.
const MOST_NATS: f32 = 10.0;

/// The difference between the best phone of a frame and speech that is not in the script, in nats. At 3, correct words
/// of other languages, which fit the English phones less well, lost to it. At 5.5, only wrong words do.
const OTHER_SPEECH_NATS: f32 = 5.5;

/// The bonus of silence in stretches far below the voice, in nats per frame.
const QUIET_STRETCH_NATS: f32 = 5.0;

/// The scores of the frames of a recording.
pub(super) struct Emissions<'m, V> {
    model: &'m Model,
    vectors: V,
    /// By frame: whether it is too quiet for speech.
    quiet: std::vec::IntoIter<bool>,
    /// By processed frame: the score of the best phone.
    pub(super) best: Vec<f32>,
    /// Receives the number of processed frames at intervals.
    tell: Option<&'m dyn Fn(usize)>,
}

/// The frames between two progress reports: ten seconds of audio.
const TOLD_FRAMES: usize = 1_000;

impl<'m, V: Iterator<Item = Frame>> Emissions<'m, V> {
    pub(super) fn new(model: &'m Model, vectors: V, quiet: Vec<bool>) -> Emissions<'m, V> {
        Emissions { model, vectors, quiet: quiet.into_iter(), best: Vec::new(), tell: None }
    }

    /// Reports the number of processed frames to `tell` at intervals.
    pub(super) fn telling(self, tell: Option<&'m dyn Fn(usize)>) -> Emissions<'m, V> {
        Emissions { tell, ..self }
    }
}

impl<V: Iterator<Item = Frame>> Iterator for Emissions<'_, V> {
    type Item = Scores;

    fn next(&mut self) -> Option<Scores> {
        let frame = self.vectors.next()?;
        let scores = self.model.score(&frame.vector);
        self.best.push(scores.iter().copied().fold(f32::MIN, f32::max));
        if let Some(tell) = self.tell.filter(|_| self.best.len().is_multiple_of(TOLD_FRAMES)) {
            tell(self.best.len());
        }
        let mut scores = adjusted(scores, &frame);
        if self.quiet.next() == Some(true) {
            let silence = Phone::Sil.index() * STATES;
            scores[silence..silence + STATES].iter_mut().for_each(|score| *score += QUIET_STRETCH_NATS);
        }
        Some(scores)
    }
}

/// Returns the scores of a frame, adjusted by information that the model does not have.
fn adjusted(mut scores: Scores, frame: &Frame) -> Scores {
    // Speech that is not in the script is almost as likely as the best phone.
    let speech = scores[..Phone::Sil.index() * STATES].iter().copied().fold(f32::MIN, f32::max);
    let spoken = Phone::Spoken.index() * STATES;
    for score in &mut scores[spoken..spoken + STATES] {
        *score = score.max(speech - OTHER_SPEECH_NATS);
    }
    let silence = Phone::Sil.index() * STATES;
    let prior = prior_of_silence(frame);
    for score in &mut scores[silence..silence + STATES] {
        *score += prior;
    }
    scores
}

/// Returns the scores of a frame in the states of `phones`, phone by phone.
pub(super) fn scores_near(model: &Model, frame: &Frame, phones: &[Phone]) -> Vec<f32> {
    let scores = if phones.contains(&Phone::Spoken) {
        // Its score depends on the best of all phones.
        model.score(&frame.vector)
    } else {
        let mut scores = [f32::MIN; Phone::COUNT * STATES];
        for phone in phones {
            let states = &mut scores[phone.index() * STATES..][..STATES];
            if states[0] == f32::MIN {
                states.copy_from_slice(&model.score_phone(&frame.vector, phone.index()));
            }
        }
        scores
    };
    let scores = adjusted(scores, frame);
    phones.iter().flat_map(|phone| scores[phone.index() * STATES..][..STATES].iter().copied()).collect()
}

/// Returns the bonus of silence from the loudness of a frame, in nats.
fn prior_of_silence(frame: &Frame) -> f32 {
    (QUIET_NATS * (QUIET - frame.loudness)).clamp(-MOST_NATS, MOST_NATS)
}

/// Returns the fit of each step: its score minus that of the best phone, in nats per frame.
pub(super) fn fits(
    model: &Model,
    vectors: impl Iterator<Item = Frame>,
    best: &[f32],
    phone_of: impl Fn(&PathStep) -> Phone,
    steps: &[PathStep],
) -> Vec<f32> {
    let mut frames = vectors.zip(best);
    let fit = |step: &PathStep| {
        let phone = phone_of(step).index();
        let frames = frames.by_ref().take(step.end - step.start);
        let fit = |(frame, best): (Frame, &f32)| {
            let [first, second, third] = model.score_phone(&frame.vector, phone);
            first.max(second).max(third) - best
        };
        let count = (step.end - step.start) as f32;
        frames.map(fit).sum::<f32>() / count
    };
    steps.iter().map(fit).collect()
}
