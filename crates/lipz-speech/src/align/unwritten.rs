//! Unscripted speech, such as hesitations and extra words. The mouth does not rest during it, but shows the phones in
//! the audio.

use super::history::PathStep;
use super::loose_aligner::LooseAligner;
use super::{AlignedPhone, Path, quiet};
use crate::sound::level::voice_powers;
use crate::{Model, Phone, Sound};

/// Speech that fits no word and is so many decibels below the loud frames is treated as noise: a voice that fades, or a
/// hum.
const FAINT_DB: f32 = 15.0;

/// Replaces each unscripted speech in `aligned` with the phones in the audio. `aligned` was made from `path`.
pub(super) fn put_phones(model: &Model, sound: &Sound, path: &Path, aligned: Vec<AlignedPhone>) -> Vec<AlignedPhone> {
    if aligned.iter().all(|phone| phone.phone != Phone::Spoken) {
        return aligned;
    }
    let powers = voice_powers(sound.spectrum());
    let least = quiet::loud(&powers) * libm::powf(10.0, -FAINT_DB / 10.0);
    let is_loud = |step: &PathStep| {
        let powers = powers.get(step.start..step.end).unwrap_or_default();
        powers.iter().sum::<f32>() >= least * powers.len() as f32
    };
    let mut loose = LooseAligner::new(model, sound, path.warp);
    let put = |(phone, step): (AlignedPhone, &PathStep)| match phone.phone {
        Phone::Spoken if is_loud(step) => loose.phones(step.start..step.end, &phone),
        _ => vec![phone],
    };
    aligned.into_iter().zip(&path.steps).flat_map(put).collect()
}
