//! Recognition of phones without a script, with a loop in which each phone may follow any other.
//!
//! Probabilities are summed over all paths (the forward-backward algorithm: L. Rabiner, "A tutorial on hidden Markov
//! models", 1989). For the mouth, only the look of a phone matters: in an m or a b, the lips are closed, even if an n
//! is more likely than either. So the look is decided first, frame by frame, and then the phone with that look.

use super::history::PathStep;
use crate::Phone;
use crate::model::{Model, STATES, Scores};
use crate::render::LOOKS;

/// The phones of the loop: those of speech, then silence.
const PHONES: usize = Phone::Sil.index() + 1;
/// The number of their states.
const ALL: usize = PHONES * STATES;
/// The weight of scores. Neighbouring frames share samples, so their scores repeat the same evidence.
const SCALE: f32 = 0.42;
/// The weight of phone pair statistics, relative to the audio.
const PAIR_WEIGHT: f32 = 1.5;
/// The cost of each phone, in nats. Without it, the result consists of phones of 30 milliseconds.
const PHONE_NATS: f32 = -2.5;
/// The bonus of silence, in nats per frame. Without a script, any noise would become some phone.
const SILENCE_NATS: f32 = 1.0;
/// The additional bonus where the audio does not change, because humming and hissing are not speech.
const STEADY_NATS: f32 = 40.0;
/// Frames that are decided together, and the frames after them that are considered.
const BLOCK_FRAMES: usize = 512;
const AHEAD_FRAMES: usize = 64;

/// One number per state.
type States = [f32; ALL];

/// A frame.
struct PhoneFrame {
    /// By state: the likelihood of the audio, relative to the highest.
    likelihoods: States,
    /// By state: its probability, given this frame and those before.
    forward: States,
}

/// The loop as a Markov chain, with the probabilities of its transitions.
struct Loop {
    stay: States,
    leave: States,
    /// By ending phone: the probability of each phone that may follow.
    next: Vec<[f32; PHONES]>,
}

/// Returns the most likely phones of audio whose frames have these `scores`. `steady` states which frames do not
/// change. The node of a step is the index of its phone.
pub(super) fn likely_phones(model: &Model, scores: impl Iterator<Item = Scores>, steady: &[bool]) -> Vec<PathStep> {
    let chain = Loop::new(model);
    let mut rows: Vec<PhoneFrame> = Vec::with_capacity(BLOCK_FRAMES + AHEAD_FRAMES);
    let mut steps = Vec::new();
    for (scores, &is_steady) in scores.zip(steady) {
        let likelihoods = likelihoods(&scores, is_steady);
        let forward = chain.forward(&likelihoods, rows.last().map(|row| &row.forward));
        rows.push(PhoneFrame { likelihoods, forward });
        if rows.len() == BLOCK_FRAMES + AHEAD_FRAMES {
            chain.decide(&rows, BLOCK_FRAMES, &mut steps);
            rows.drain(..BLOCK_FRAMES);
        }
    }
    chain.decide(&rows, rows.len(), &mut steps);
    steps
}

fn likelihoods(scores: &Scores, is_steady: bool) -> States {
    let mut scores: States = std::array::from_fn(|state| scores[state]);
    for score in &mut scores[Phone::Sil.index() * STATES..] {
        *score += SILENCE_NATS + if is_steady { STEADY_NATS } else { 0.0 };
    }
    let best = scores.iter().copied().fold(f32::MIN, f32::max);
    scores.map(|score| libm::expf((score - best) * SCALE))
}

impl Loop {
    fn new(model: &Model) -> Loop {
        let chance = |nats: f32| libm::expf(nats * SCALE);
        let of_states = |nats: &[f32]| std::array::from_fn(|state| chance(nats[state]));
        let leave = of_states(&model.leave);
        let follow = |phone: usize, other: usize| {
            leave[phone * STATES + STATES - 1] * chance(PAIR_WEIGHT * model.pair(phone, other) + PHONE_NATS)
        };
        let next = (0..PHONES).map(|phone| std::array::from_fn(|other| follow(phone, other))).collect();
        Loop { stay: of_states(&model.stay), leave, next }
    }

    /// Returns the probabilities of the states of a frame, given the frame `before` it.
    fn forward(&self, likelihoods: &States, before: Option<&States>) -> States {
        let mut entered = [1.0; PHONES];
        if let Some(before) = before {
            entered = [0.0; PHONES];
            for (next, last) in self.next.iter().zip(before.chunks_exact(STATES).map(|states| states[STATES - 1])) {
                for (entered, chance) in entered.iter_mut().zip(next) {
                    *entered += chance * last;
                }
            }
        }
        let at = |state: usize| before.map_or(0.0, |before| before[state]);
        normal(std::array::from_fn(|state| {
            let enters = match state % STATES {
                0 => entered[state / STATES],
                _ => at(state - 1) * self.leave[state - 1],
            };
            (at(state) * self.stay[state] + enters) * likelihoods[state]
        }))
    }

    /// Returns, by state, the likelihood of all frames after a frame, from that of the frame `after` it.
    fn backward(&self, after: &PhoneFrame, backward: &States) -> States {
        let ahead: States = std::array::from_fn(|state| after.likelihoods[state] * backward[state]);
        let followed = |phone: usize| {
            let firsts = ahead.chunks_exact(STATES).map(|states| states[0]);
            self.next[phone].iter().zip(firsts).map(|(chance, first)| chance * first).sum::<f32>()
        };
        normal(std::array::from_fn(|state| {
            let left = match state % STATES {
                last if last == STATES - 1 => followed(state / STATES),
                _ => self.leave[state] * ahead[state + 1],
            };
            ahead[state] * self.stay[state] + left
        }))
    }

    /// Adds the phones of the first `count` frames to `steps`.
    fn decide(&self, rows: &[PhoneFrame], count: usize, steps: &mut Vec<PathStep>) {
        let mut phones = vec![0; count];
        let mut backward = [1.0; ALL];
        for (frame, row) in rows.iter().enumerate().rev() {
            if let Some(after) = rows.get(frame + 1) {
                backward = self.backward(after, &backward);
            }
            if let Some(phone) = phones.get_mut(frame) {
                *phone = likeliest(&row.forward, &backward);
            }
        }
        let from = steps.last().map_or(0, |step: &PathStep| step.end);
        for (frame, node) in (from..).zip(phones) {
            match steps.last_mut() {
                Some(step) if step.node == node => step.end += 1,
                _ => steps.push(PathStep { node, start: frame, end: frame + 1 }),
            }
        }
    }
}

/// Returns the most likely phone with the most likely look.
fn likeliest(forward: &States, backward: &States) -> usize {
    let mut chances = [0.0; PHONES];
    for (state, (forward, backward)) in forward.iter().zip(backward).enumerate() {
        chances[state / STATES] += forward * backward;
    }
    let chance_of_look = |look: &[Phone]| look.iter().map(|phone| chances[phone.index()]).sum::<f32>();
    let look = LOOKS.iter().max_by(|a, b| chance_of_look(a).total_cmp(&chance_of_look(b)));
    let likeliest = |a: &&Phone, b: &&Phone| chances[a.index()].total_cmp(&chances[b.index()]);
    look.and_then(|look| look.iter().max_by(likeliest)).map_or(Phone::Sil.index(), |phone| phone.index())
}

/// Scales numbers so that their sum is 1.
fn normal(numbers: States) -> States {
    let sum: f32 = numbers.iter().sum();
    numbers.map(|number| number / sum.max(f32::MIN_POSITIVE))
}
