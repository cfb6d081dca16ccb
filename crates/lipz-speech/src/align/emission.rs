//! How likely each frame of a sound is in each state, and how well phones fit in the end.

use super::history::Step;
use crate::features::cepstra::Frame;
use crate::model::{STATES, Scores};
use crate::{Model, Phone};

/// Quiet frames are more likely silence, loud ones less: so many nats per frame for a loudness of 1, which is that of the
/// loud frames of the sound.
const QUIET_NATS: f32 = 20.0;
/// The loudness at which silence is neither more nor less likely.
const QUIET: f32 = 0.1;
/// The most that loudness counts for or against silence, in nats per frame.
const MOST_NATS: f32 = 10.0;

/// How much less likely than its best phone a frame is as speech that is not in the script, in nats. At 3, the right words of
/// other languages, which fit the phones of English less, gave way to it; at 5.5, no words but wrong ones do.
const OTHER_SPEECH_NATS: f32 = 5.5;

/// How much more likely silence is, in nats per frame, in stretches far below the voice.
const QUIET_STRETCH_NATS: f32 = 5.0;

/// The scores of the frames of a sound.
pub(super) struct Emissions<'m, V> {
    model: &'m Model,
    vectors: V,
    /// By frame: whether nobody can be speaking.
    quiet: std::vec::IntoIter<bool>,
    /// Of the frames so far, the score of the best phone.
    pub(super) best: Vec<f32>,
    /// Is told every now and then how many frames are done.
    tell: Option<&'m dyn Fn(usize)>,
}

/// Frames after which somebody is told: ten seconds of sound.
const TOLD_FRAMES: usize = 1_000;

impl<'m, V: Iterator<Item = Frame>> Emissions<'m, V> {
    pub(super) fn new(model: &'m Model, vectors: V, quiet: Vec<bool>) -> Emissions<'m, V> {
        Emissions { model, vectors, quiet: quiet.into_iter(), best: Vec::new(), tell: None }
    }

    /// Tells every now and then how many frames are done.
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

/// The scores of a frame, with what is known beyond the model.
fn adjusted(mut scores: Scores, frame: &Frame) -> Scores {
    // Speech that is not in the script is as likely as the best phone, less a little.
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

/// The scores of a frame in the states of `phones`, one after the other.
pub(super) fn scores_near(model: &Model, frame: &Frame, phones: &[Phone]) -> Vec<f32> {
    let scores = if phones.contains(&Phone::Spoken) {
        // It is as likely as the best of all phones.
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

/// How much more likely the loudness of a frame makes silence, in nats.
fn prior_of_silence(frame: &Frame) -> f32 {
    (QUIET_NATS * (QUIET - frame.loudness)).clamp(-MOST_NATS, MOST_NATS)
}

/// How well each step fits: its score compared to the best phone's, in nats per frame.
pub(super) fn fits(
    model: &Model,
    vectors: impl Iterator<Item = Frame>,
    best: &[f32],
    phone_of: impl Fn(&Step) -> Phone,
    steps: &[Step],
) -> Vec<f32> {
    let mut frames = vectors.zip(best);
    let fit = |step: &Step| {
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
