//! Assignment of the frames of a phone to its states.

use crate::features::cepstra::NUMBERS;
use crate::model::STATES;
use crate::{Model, Phone};

/// Returns the number of frames of a phone in each of its states, along the best path. If there are fewer frames than
/// states, all are 0, because the search was cut off there.
pub(super) fn lengths(model: &Model, phone: Phone, vectors: &[[f32; NUMBERS]]) -> [usize; STATES] {
    if vectors.len() < STATES {
        return [0; STATES];
    }
    // The best value of each state, and the frame at which its path entered it.
    let base = phone.index() * STATES;
    let mut values = [f32::NEG_INFINITY; STATES];
    let mut entries = [[0; STATES]; STATES];
    for (frame, vector) in vectors.iter().enumerate() {
        let scores = model.score_phone(vector, phone.index());
        for state in (0..STATES).rev() {
            let stays = values[state] + model.stay[base + state];
            let enters = match state.checked_sub(1) {
                Some(before) => values[before] + model.leave[base + before],
                None if frame == 0 => 0.0,
                None => f32::NEG_INFINITY,
            };
            if enters > stays {
                entries[state] = state.checked_sub(1).map_or([0; STATES], |before| entries[before]);
                entries[state][state] = frame;
            }
            values[state] = enters.max(stays) + scores[state];
        }
    }
    let [_, second, third] = entries[STATES - 1];
    [second, third - second, vectors.len() - third]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_frame_is_in_one_state_and_every_state_has_one() {
        let vectors: Vec<[f32; NUMBERS]> = (0..20_u8).map(|frame| [f32::from(frame) / 5.0 - 2.0; NUMBERS]).collect();
        for count in 0..vectors.len() {
            let lengths = lengths(Model::english(), Phone::M, &vectors[..count]);
            match count {
                0..STATES => assert_eq!(lengths, [0; STATES]),
                _ => assert!(lengths.iter().all(|&length| length > 0), "{count}: {lengths:?}"),
            }
            assert_eq!(lengths.iter().sum::<usize>(), if count < STATES { 0 } else { count });
        }
    }
}
