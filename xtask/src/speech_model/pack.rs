//! Writes an acoustic model in the format of `lipz_speech::Model`, whose documentation describes it.

use super::pairs;
use super::sphinx::Model;
use crate::Failure;
use half::f16;

const MAGIC: &[u8; 8] = b"LIPZ-AM1";

/// The least variance of a Gaussian: that of CMU Sphinx (`-varfloor`). Some in the file are 0.
const LEAST_VARIANCE: f32 = 1e-4;

pub(super) fn pack(model: &Model, dictionary: &str) -> Result<Vec<u8>, Failure> {
    let mut order: Vec<usize> = (0..model.phones.len()).collect();
    // Phones of speech by name, then silence, then noises.
    order.sort_by_key(|&phone| {
        let name = &model.phones[phone];
        (name.starts_with('+'), name == "SIL", name)
    });
    let mut bytes = MAGIC.to_vec();
    for number in [model.phones.len(), model.streams, model.densities, model.dimensions] {
        let number = u16::try_from(number).map_err(|_| "the model is too large".to_owned())?;
        bytes.extend(number.to_le_bytes());
    }
    for &phone in &order {
        let mut name = [0; 8];
        let spelt = model.phones[phone].as_bytes();
        name.get_mut(..spelt.len()).ok_or("a name is too long")?.copy_from_slice(spelt);
        bytes.extend(name);
    }
    let per_phone = model.streams * model.densities * model.dimensions;
    let half = |number: f32| f16::from_f32(number).to_le_bytes();
    for &phone in &order {
        bytes.extend(model.means[phone * per_phone..][..per_phone].iter().flat_map(|&mean| half(mean)));
    }
    for &phone in &order {
        let variances = &model.variances[phone * per_phone..][..per_phone];
        bytes.extend(variances.iter().flat_map(|&variance| half(1.0 / variance.max(LEAST_VARIANCE).sqrt())));
    }
    let states = |phone: usize| phone * Model::STATES..(phone + 1) * Model::STATES;
    for &phone in &order {
        let weights = model.streams * model.densities;
        let range = states(phone);
        bytes.extend(&model.weights[range.start * weights..range.end * weights]);
    }
    for &phone in &order {
        bytes.extend(model.stay[states(phone)].iter().flat_map(|&stay| half(stay)));
    }
    let names: Vec<&str> = order.iter().map(|&phone| model.phones[phone].as_str()).collect();
    let paired = names.iter().position(|&name| name == "SIL").ok_or("no silence")? + 1;
    bytes.extend(pairs::costs(&names[..paired], dictionary));
    Ok(bytes)
}
