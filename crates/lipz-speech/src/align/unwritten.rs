//! Speech that is not in the script: hesitations, words too many. The mouth does not rest there: it shows the phones that are
//! heard.

use super::history::Step;
use super::loose::Loose;
use super::{AlignedPhone, quiet};
use crate::sound::level::voice_powers;
use crate::{Model, Phone, Sound};

/// So many decibels below the loud frames of a sound, what no word of the script fits is no speech: it fades, or hums in a room.
const FAINT_DB: f32 = 15.0;

/// Puts the phones that are heard in place of each of `aligned` that is speech without words. These came from `steps`.
pub(super) fn put_phones(
    model: &Model,
    sound: &Sound,
    steps: &[Step],
    aligned: Vec<AlignedPhone>,
) -> Vec<AlignedPhone> {
    if aligned.iter().all(|phone| phone.phone != Phone::Spoken) {
        return aligned;
    }
    let powers = voice_powers(sound.spectrum());
    let least = quiet::loud(&powers) * libm::powf(10.0, -FAINT_DB / 10.0);
    let is_loud = |step: &Step| {
        let powers = powers.get(step.start..step.end).unwrap_or_default();
        powers.iter().sum::<f32>() >= least * powers.len() as f32
    };
    let mut loose = Loose::new(model, sound);
    let put = |(phone, step): (AlignedPhone, &Step)| match phone.phone {
        Phone::Spoken if is_loud(step) => loose.phones(step.start..step.end, &phone),
        _ => vec![phone],
    };
    aligned.into_iter().zip(steps).flat_map(put).collect()
}
