//! The costs of phones: how much less likely each is than the best one, frame by frame, and the cost of a script.

use super::tokens::Token;
use crate::Phone;
use crate::pronounce::ipa_phones;

/// The phones of speech, which come first in [`Phone::ALL`].
const SPEECH: usize = Phone::Sil.index();
/// The costs in a unit of cost: a nat has so many.
const UNITS: f32 = 16.0;
/// The most states of all frames that a comparison may have. Each takes a byte.
const MOST_STATES: usize = 16 << 20;

/// The tokens of a network that names every phone with a token of its own.
#[derive(Clone, Debug)]
pub(super) struct PhoneTokens {
    /// By phone: its token.
    phones: [usize; SPEECH],
    /// The tokens that are not phones: blanks and pauses.
    others: Vec<usize>,
}

impl PhoneTokens {
    /// Returns the tokens of all phones, or `None` if a phone has no token of its own.
    pub(super) fn new(tokens: &[Token]) -> Option<PhoneTokens> {
        let of_token = |token: &Token| match token {
            Token::Symbols(symbols) => ipa_phones(symbols).ok(),
            _ => None,
        };
        let names: Vec<Option<Vec<Phone>>> = tokens.iter().map(of_token).collect();
        let mut phones = [0; SPEECH];
        for (token, phone) in phones.iter_mut().zip(Phone::ALL) {
            *token = names.iter().position(|name| name.as_deref() == Some(&[phone]))?;
        }
        let others = (0..tokens.len()).filter(|token| names[*token].is_none()).collect();
        Some(PhoneTokens { phones, others })
    }
}

/// The costs of all phones in the frames of a recording.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct PhoneCosts {
    /// By frame: the cost of each phone, and of no phone.
    frames: Vec<[u8; SPEECH + 1]>,
}

/// A step of the best path into a state: from the same state, from the one before, or from the one before that.
const STAY: u8 = 0;
const NEXT: u8 = 1;
const SKIP: u8 = 2;

impl PhoneCosts {
    /// Adds a frame in which the tokens have these likelihoods, as logarithms up to a constant.
    pub(super) fn push(&mut self, tokens: &PhoneTokens, likely: &[f32]) {
        let of_token = |token: &usize| likely.get(*token).copied().unwrap_or(f32::MIN);
        let most = tokens.others.iter().map(of_token).fold(f32::MIN, f32::max);
        let others = tokens.others.iter().map(|token| libm::expf(of_token(token) - most)).sum::<f32>();
        let none = most + libm::logf(others.max(1.0));
        let best = tokens.phones.iter().map(of_token).fold(none, f32::max);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let cost = |likely: f32| ((best - likely) * UNITS).clamp(0.0, 255.0) as u8;
        let mut frame = [cost(none); SPEECH + 1];
        frame.iter_mut().zip(&tokens.phones).for_each(|(place, token)| *place = cost(of_token(token)));
        self.frames.push(frame);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Returns, by phone of `said`, how much less likely the frames are in which it is spoken, up to the next phone,
    /// than without a script, in nats. The phones are spoken in this order, at the likeliest time (the best path of CTC:
    /// A. Graves and others, "Connectionist Temporal Classification", 2006). Frames before the first phone count for it.
    ///
    /// Returns `None` if the comparison would take more than 16 megabytes.
    pub(super) fn of_script(&self, said: &[Phone]) -> Option<Vec<f32>> {
        // Every second state is a pause, which may be left out between different phones.
        let count = 2 * said.len() + 1;
        if said.is_empty() || count.saturating_mul(self.frames.len()) > MOST_STATES {
            return None;
        }
        let column = |state: usize| if state.is_multiple_of(2) { SPEECH } else { said[state / 2].index() };
        let may_skip = |state: usize| state % 2 == 1 && state > 1 && said[state / 2] != said[state / 2 - 1];
        let mut costs = vec![u32::MAX; count];
        let mut steps = Vec::with_capacity(count * self.frames.len());
        for (number, frame) in self.frames.iter().enumerate() {
            let before = costs.clone();
            for state in 0..count {
                let from = |by: usize| state.checked_sub(by).map_or(u32::MAX, |state| before[state]);
                let skip = if may_skip(state) { from(2) } else { u32::MAX };
                let ways = [(from(0), STAY), (from(1), NEXT), (skip, SKIP)];
                let (cost, step) = ways.into_iter().min().unwrap_or((u32::MAX, STAY));
                // The first frame is a pause or the first phone.
                let (cost, step) = match (number, state) {
                    (0, 0 | 1) => (0, STAY),
                    (0, _) => (u32::MAX, STAY),
                    _ => (cost, step),
                };
                costs[state] = cost.saturating_add(frame[column(state)].into());
                steps.push(step);
            }
        }
        let mut nats = vec![0.0; said.len()];
        let (last, before_last) = (costs[count - 1], costs[count - 2]);
        let mut state = if last <= before_last { count - 1 } else { count - 2 };
        if last.min(before_last) == u32::MAX {
            // The recording has fewer frames than the script has phones.
            return Some(vec![f32::from(u8::MAX) / UNITS; said.len()]);
        }
        for (frame, steps) in self.frames.iter().zip(steps.chunks_exact(count)).rev() {
            let phone = (state + state % 2).max(2) / 2 - 1;
            nats[phone] += f32::from(frame[column(state)]) / UNITS;
            state -= usize::from(steps[state]);
        }
        Some(nats)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Recogniser;

    /// Returns the costs of frames in which only these phones are likely; `Sil` stands for none.
    fn costs(names: &str) -> PhoneCosts {
        let frame = |name: &str| {
            let phone: Phone = name.parse().unwrap();
            let mut frame = [160; SPEECH + 1];
            frame[phone.index()] = 0;
            frame
        };
        PhoneCosts { frames: names.split(' ').map(frame).collect() }
    }

    fn phones(names: &str) -> Vec<Phone> {
        names.split(' ').map(|name| name.parse().unwrap()).collect()
    }

    #[test]
    fn the_script_that_is_spoken_costs_nothing() {
        let spoken = costs("SIL K K SIL AE T T SIL SIL T SIL");
        assert_eq!(spoken.of_script(&phones("K AE T T")), Some(vec![0.0; 4]));
        assert_eq!(costs("K AE T").of_script(&phones("K AE T")), Some(vec![0.0; 3]));
    }

    #[test]
    fn what_differs_costs_where_it_differs() {
        let spoken = costs("SIL K SIL AE SIL SIL T SIL S S SIL");
        assert_eq!(spoken.of_script(&phones("K AE T")), Some(vec![0.0, 0.0, 20.0]), "two frames more");
        assert_eq!(spoken.of_script(&phones("K EH T S")), Some(vec![0.0, 10.0, 0.0, 0.0]));
        assert_eq!(spoken.of_script(&phones("AE T S")), Some(vec![10.0, 0.0, 0.0]), "before the first");
        // Equal phones have a pause between them.
        assert_eq!(costs("T T T").of_script(&phones("T T")), Some(vec![10.0, 0.0]).or(Some(vec![0.0, 10.0])));
    }

    #[test]
    fn too_short_recordings_and_too_long_scripts_have_an_answer() {
        let short = costs("K AE").of_script(&phones("K AE T AE T")).unwrap();
        assert!(short.iter().all(|nats| *nats > 15.0), "{short:?}");
        assert_eq!(PhoneCosts::default().of_script(&phones("K")).map(|nats| nats[0] > 15.0), Some(true));
        assert_eq!(costs("K").of_script(&[]), None);
        assert_eq!(costs("K AE T AE").of_script(&vec![Phone::K; MOST_STATES / 8]), None);
    }

    #[test]
    fn costs_are_relative_to_the_best_and_blanks_count_together() {
        let names = &Recogniser::built_in().tokens;
        let tokens = PhoneTokens::new(names).unwrap();
        assert_eq!((names.len(), tokens.others.len()), (SPEECH + 2, 2), "a pause and a blank");
        assert!(PhoneTokens::new(&names[1..]).is_none());
        let mut likely = vec![-20.0; SPEECH + 2];
        likely[tokens.phones[0]] = -1.0;
        tokens.others.iter().for_each(|token| likely[*token] = -2.0);
        let mut costs = PhoneCosts::default();
        costs.push(&tokens, &likely);
        assert_eq!(costs.frames[0][..2], [0, 255]);
        assert_eq!(costs.frames[0][SPEECH], 4, "ln 2 less than two nats, times 16");
    }
}
