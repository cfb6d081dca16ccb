//! The probabilities of all phones at a time, for mouths that move without a decision.

use super::emission::Emissions;
use super::{Aligner, quiet};
use crate::features::cepstra::Vectors;
use crate::features::warp::Warp;
use crate::model::STATES;
use crate::{Phone, Sound};

/// The exponent of the likelihoods. Gaussians are too certain: with 1, single frames jump between phones. From 0.2 to
/// 0.5, mouths are equally close to coils on jaw and lips (`cargo xtask mouth-score`).
const EXPONENT: f32 = 0.3;

impl Aligner<'_> {
    /// Returns the probability of each phone for every ten milliseconds of `sound`, in the order of [`Phone::ALL`].
    /// Noise and speech that is not in a script have the probability 0.
    ///
    /// Without a text, a wrong decision closes or opens the mouth visibly. A mouth that blends the targets of all phones
    /// by these probabilities moves less, but follows the opening of the lips better than the single best phones.
    pub fn posteriors(&self, sound: &Sound) -> impl Iterator<Item = [f32; Phone::COUNT]> {
        let vectors = Vectors::new(sound.spectrum(), Warp::NONE);
        Emissions::new(self.model, vectors, quiet::quiet(sound.spectrum())).map(|scores| {
            let of_phone = |phone: Phone| {
                let states = scores.get(phone.index() * STATES..(phone.index() + 1) * STATES).unwrap_or_default();
                states.iter().copied().fold(f32::MIN, f32::max)
            };
            let known = |phone: &Phone| phone.is_speech() || *phone == Phone::Sil;
            let best = Phone::ALL.into_iter().filter(known).map(of_phone).fold(f32::MIN, f32::max);
            let mut probabilities = Phone::ALL.map(|phone| match known(&phone) {
                true => libm::expf(EXPONENT * (of_phone(phone) - best)),
                false => 0.0,
            });
            let sum: f32 = probabilities.iter().sum();
            probabilities.iter_mut().for_each(|probability| *probability /= sum);
            probabilities
        })
    }
}
