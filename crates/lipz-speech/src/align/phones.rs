//! The phones of a sound without a script: a loop of all phones, in which each may follow each.
//!
//! What is likely is summed over all paths (the forward-backward algorithm: L. Rabiner, "A tutorial on hidden Markov models",
//! 1989). Of the phones that look alike, only one has to be likely: where it is an m or a b, the lips are closed, even if an n
//! is more likely than either. So the look of the mouth is decided first, frame by frame, then the phone that has it.

use super::history::Step;
use crate::Phone;
use crate::model::{Model, STATES, Scores};
use crate::render::LOOKS;

/// The phones of the loop: those of speech, then silence.
const PHONES: usize = Phone::Sil.index() + 1;
/// Their states.
const ALL: usize = PHONES * STATES;
/// What logarithms count: neighbouring frames share samples, and so say the same several times.
const SCALE: f32 = 0.42;
/// How much what phones usually follow each other counts, compared to what is heard.
const PAIR_WEIGHT: f32 = 1.5;
/// What each phone costs, in nats: without it, a sound falls apart into phones of 30 milliseconds.
const PHONE_NATS: f32 = -2.5;
/// How much silence is favoured, in nats per frame: where no script says what is spoken, any noise is a phone of some sort.
const SILENCE_NATS: f32 = 1.0;
/// How much more it is favoured where the sound does not change: what hums and hisses does not speak.
const STEADY_NATS: f32 = 40.0;
/// Frames that are decided together, and how many after them are looked at for that.
const BLOCK_FRAMES: usize = 512;
const AHEAD_FRAMES: usize = 64;

/// A number by state.
type States = [f32; ALL];

/// A frame.
struct Row {
    /// How likely the sound is in each state, compared to the likeliest.
    likelihoods: States,
    /// How probable each state is, given this frame and those before.
    forward: States,
}

/// The loop as a Markov chain: how probable the ways between its states are.
struct Loop {
    stay: States,
    leave: States,
    /// By the phone that ends: that each other one follows.
    next: Vec<[f32; PHONES]>,
}

/// The most likely phones of a sound whose frames have these `scores`, and of which it is known which are `steady`; the node of
/// a step is the number of its phone.
pub(super) fn likely_phones(model: &Model, scores: impl Iterator<Item = Scores>, steady: &[bool]) -> Vec<Step> {
    let chain = Loop::new(model);
    let mut rows: Vec<Row> = Vec::with_capacity(BLOCK_FRAMES + AHEAD_FRAMES);
    let mut steps = Vec::new();
    for (scores, &is_steady) in scores.zip(steady) {
        let likelihoods = likelihoods(&scores, is_steady);
        let forward = chain.forward(&likelihoods, rows.last().map(|row| &row.forward));
        rows.push(Row { likelihoods, forward });
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

    /// How probable the states of a frame are, given the frame `before` it.
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

    /// How likely what comes after a frame is from each of its states, given the same for the frame `after` it.
    fn backward(&self, after: &Row, backward: &States) -> States {
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
    fn decide(&self, rows: &[Row], count: usize, steps: &mut Vec<Step>) {
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
        let from = steps.last().map_or(0, |step: &Step| step.end);
        for (frame, node) in (from..).zip(phones) {
            match steps.last_mut() {
                Some(step) if step.node == node => step.end += 1,
                _ => steps.push(Step { node, start: frame, end: frame + 1 }),
            }
        }
    }
}

/// The likeliest phone of those with the likeliest look.
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

/// Makes the sum of numbers 1.
fn normal(numbers: States) -> States {
    let sum: f32 = numbers.iter().sum();
    numbers.map(|number| number / sum.max(f32::MIN_POSITIVE))
}
