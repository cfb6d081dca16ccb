//! Writes the file of an acoustic model.

use super::file::{MAGIC, NAME, by_gaussian, weight_step};
use super::{DENSITIES, Model, STREAMS};
use crate::Phone;
use crate::features::cepstra::COEFFICIENTS;
use half::f16;

impl Model {
    /// Returns the file of the model for `from_bytes`, with numbers rounded to the precision of the format.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        for number in [Phone::COUNT, STREAMS, DENSITIES, COEFFICIENTS] {
            bytes.extend_from_slice(&number.to_le_bytes()[..2]);
        }
        for phone in Phone::ALL {
            let mut name = [0; NAME];
            name.iter_mut().zip(phone.name().bytes()).for_each(|(to, byte)| *to = byte);
            bytes.extend_from_slice(&name);
        }
        push_halves(&mut bytes, &by_gaussian(&self.means));
        let inverse_sigmas: Vec<f32> = self.scales.iter().map(|scale| scale * libm::sqrtf(2.0)).collect();
        push_halves(&mut bytes, &by_gaussian(&inverse_sigmas));
        let in_steps = |nats: f64, step: f64| -> u8 {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a byte")]
            let steps = libm::rint(nats / step).clamp(0.0, 255.0) as u8;
            steps
        };
        let weight = |&weight: &f32| in_steps(-libm::log(f64::from(weight)), weight_step());
        bytes.extend(self.weights.iter().map(weight));
        let stay: Vec<f32> = self.stay.iter().map(|&stay| libm::expf(stay)).collect();
        push_halves(&mut bytes, &stay);
        bytes.extend(self.pairs.iter().map(|&pair| in_steps(-f64::from(pair), 1.0 / 16.0)));
        bytes
    }
}

fn push_halves(bytes: &mut Vec<u8>, numbers: &[f32]) {
    bytes.extend(numbers.iter().flat_map(|&number| f16::from_f32(number).to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ENGLISH;

    #[test]
    fn what_is_read_is_written_again() {
        let model = Model::from_bytes(ENGLISH).unwrap();
        assert!(model.to_bytes() == ENGLISH);
    }
}
