//! Motions of MikuMikuDance, `.vmd`: keys of morphs, with names in Shift JIS and 30 frames per second.

use super::keys::keys;
use super::{FaceAnimation, WeightFormat};
use encoding_rs::SHIFT_JIS;
use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::rate::Rate;

const SIGNATURE: &[u8] = b"Vocaloid Motion Data 0002";
const SIGNATURE_BYTES: usize = 30;
const MODEL_BYTES: usize = 20;
const MORPH_BYTES: usize = 15;
/// The sections without entries: bones before the morphs; cameras, lights, shadows and inverse kinematics after them.
const BONES: u32 = 0;
const SECTIONS_AFTER: usize = 4;

pub(super) const FORMAT: WeightFormat = WeightFormat {
    name: "vmd",
    about: "MikuMikuDance motions, .vmd, 30 frames per second",
    extension: "vmd",
    rig: "mmd",
    fixed_rate: Some(Rate { numerator: 30, denominator: 1, is_exact: true }),
    write,
};

fn write(animation: &FaceAnimation, diagnostics: &mut Vec<Diagnostic>) -> Vec<u8> {
    let mut file = padded(SIGNATURE, SIGNATURE_BYTES);
    // The model's name. Players compare it with their model, and play the motion for any.
    file.extend_from_slice(&padded(b"lipz", MODEL_BYTES));
    file.extend_from_slice(&BONES.to_le_bytes());
    let (mut count, mut morphs) = (0_u32, Vec::new());
    for weight in &animation.weights {
        let (name, _, is_lossy) = SHIFT_JIS.encode(&weight.name);
        if is_lossy || name.len() > MORPH_BYTES {
            let message = format!("the morph {} is left out", escape::quoted(&weight.name));
            let note = format!("names of morphs have at most {MORPH_BYTES} bytes in Shift JIS");
            let help = "choose a rig with such names, or shorten the name in your own rig";
            diagnostics.push(Diagnostic::new(Code::ExportLoss, message).note(note).help(help));
            continue;
        }
        for key in keys(animation, weight) {
            morphs.extend_from_slice(&padded(&name, MORPH_BYTES));
            morphs.extend_from_slice(&key.frame.to_le_bytes());
            #[expect(clippy::cast_possible_truncation, reason = "the format stores f32")]
            morphs.extend_from_slice(&(key.value as f32).to_le_bytes());
            count = count.saturating_add(1);
        }
    }
    file.extend_from_slice(&count.to_le_bytes());
    file.extend_from_slice(&morphs);
    file.resize(file.len() + SECTIONS_AFTER * size_of::<u32>(), 0);
    file
}

/// Returns text followed by zeros up to a length.
fn padded(text: &[u8], length: usize) -> Vec<u8> {
    let mut bytes = text.to_vec();
    bytes.resize(length, 0);
    bytes
}
