//! The phones of a sound without a script: a loop of all phones, in which each may follow each.

use super::history::{History, Position, Row, Step};
use crate::Phone;
use crate::model::{Model, STATES, Scores};

/// The phones of the loop: those of speech, then silence.
const PHONES: usize = Phone::Sil.index() + 1;
/// No path.
const NEVER: f32 = -1e30;
/// How much what phones usually follow each other counts, compared to what is heard.
const PAIR_WEIGHT: f32 = 1.5;
/// What each phone costs, in nats: without it, a sound falls apart into phones of 30 milliseconds.
const PHONE_NATS: f32 = -1.5;
/// How much silence is favoured, in nats per frame: where no script says what is spoken, any noise is a phone of some sort.
const SILENCE_NATS: f32 = 1.0;
/// After how many frames what is common to all paths is decided, and how many are undecided at most.
const DECIDE_FRAMES: usize = 128;
const MOST_FRAMES: usize = 2_048;

/// What is remembered of a frame: for each phone, a bit per state that was entered, and the phone before it.
struct Decisions {
    entered: [u8; PHONES],
    before: [u8; PHONES],
}

impl Row for Decisions {
    fn back(&self, position: Position, _: Option<&Self>) -> (Position, bool) {
        let (phone, state) = (position.node(), position.0 % STATES);
        if self.entered[phone] >> state & 1 == 0 {
            (position, false)
        } else if state > 0 {
            (Position(position.0 - 1), false)
        } else {
            (Position(usize::from(self.before[phone]) * STATES + STATES - 1), true)
        }
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The most likely phones of a sound whose frames have these `scores`; the node of a step is the number of its phone.
pub(super) fn best_phones(model: &Model, scores: impl Iterator<Item = Scores>) -> Vec<Step> {
    let mut states = [[NEVER; STATES]; PHONES];
    let mut history = History::new();
    for (frame, scores) in scores.enumerate() {
        let scores = favouring_silence(scores);
        let decisions = advance(model, &mut states, &scores, frame == 0);
        history.push(decisions);
        if frame % DECIDE_FRAMES == DECIDE_FRAMES - 1 {
            let alive =
                (0..PHONES * STATES).filter(|&position| states[position / STATES][position % STATES] > NEVER / 2.0);
            history.decide_common(alive.map(Position).collect());
            if history.undecided() > MOST_FRAMES {
                let (decided, position) = history.decide_half(best(&states));
                for other in (0..PHONES * STATES).map(Position) {
                    if history.trace(other, decided) != position {
                        states[other.node()][other.0 % STATES] = NEVER;
                    }
                }
            }
        }
    }
    let end = history.last().is_some().then(|| best(&states));
    history.finish(end)
}

fn favouring_silence(mut scores: Scores) -> Scores {
    for score in &mut scores[Phone::Sil.index() * STATES..][..STATES] {
        *score += SILENCE_NATS;
    }
    scores
}

fn advance(model: &Model, states: &mut [[f32; STATES]; PHONES], scores: &Scores, is_first: bool) -> Decisions {
    let left: [f32; PHONES] = std::array::from_fn(|phone| states[phone][STATES - 1] + model.leave[phone * STATES + 2]);
    let mut decisions = Decisions { entered: [0; PHONES], before: [0; PHONES] };
    let mut top = NEVER;
    for (phone, states) in states.iter_mut().enumerate() {
        let (mut enter, mut before) = (if is_first { 0.0 } else { NEVER }, phone);
        for (other, left) in left.iter().enumerate() {
            let value = left + PAIR_WEIGHT * model.pair(other, phone) + PHONE_NATS;
            if value > enter {
                (enter, before) = (value, other);
            }
        }
        let [first, second, third] = *states;
        let base = phone * STATES;
        let mut bits = 0;
        let mut better = |stays: f32, enters: f32, state: usize| {
            if enters > stays {
                bits |= 1 << state;
            }
            stays.max(enters) + scores[base + state]
        };
        *states = [
            better(first + model.stay[base], enter, 0),
            better(second + model.stay[base + 1], first + model.leave[base], 1),
            better(third + model.stay[base + 2], second + model.leave[base + 1], 2),
        ];
        decisions.entered[phone] = bits;
        #[expect(clippy::cast_possible_truncation, reason = "40 phones")]
        let before = before as u8;
        decisions.before[phone] = before;
        top = states.iter().copied().fold(top, f32::max);
    }
    for value in states.as_flattened_mut() {
        *value = (*value - top).max(NEVER);
    }
    decisions
}

fn best(states: &[[f32; STATES]; PHONES]) -> Position {
    let value = |position: &Position| states[position.node()][position.0 % STATES];
    let best = (0..PHONES * STATES).map(Position).max_by(|a, b| value(a).total_cmp(&value(b)));
    best.unwrap_or(Position(0))
}
