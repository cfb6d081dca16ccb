//! A tiny network in the format of the package `hama`, with reproducible random values. Its output has no meaning.

use std::collections::BTreeMap;

/// The number of values per frame, and inside feed-forward layers; the frames of a convolution; the blocks.
const WIDTH: usize = 8;
const INNER: usize = 12;
const KERNEL: usize = 5;
const BLOCKS: usize = 2;

/// The names of its tokens.
pub(crate) const TOKENS: [&str; 9] = ["<pad>", "a", "m", "ʃ", "u", "ː", "f", "<wb>", "<blank>"];

/// The names of its tokens, in the format of the package.
#[allow(dead_code, reason = "not every test needs it")]
pub(crate) fn vocabulary() -> String {
    let own = TOKENS.len() - 2;
    format!("{{\"encoder\": [], \"decoder\": {:?}}}", &TOKENS[..own])
}

/// Returns the file. `seed` selects the values.
pub(crate) fn hama(seed: u32) -> Vec<u8> {
    let mut chance = seed;
    let mut number = move || {
        chance = chance.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f32::from(u8::try_from(chance >> 24).unwrap()) / 128.0 - 1.0
    };
    let (mut head, mut numbers) = (Vec::new(), Vec::new());
    let tensors = tensors();
    for (name, (dimensions, is_half)) in &tensors {
        let count: usize = dimensions.iter().product();
        let start = numbers.len();
        for at in 0..count {
            let value = number() * size(name, at);
            let value = if name == "mel_fb" { value.abs() } else { value };
            match is_half {
                true => numbers.extend(half(value)),
                false => numbers.extend(value.to_le_bytes()),
            }
        }
        head.extend(u16::try_from(name.len()).unwrap().to_le_bytes());
        head.extend(name.bytes());
        head.extend([u8::from(*is_half), u8::try_from(dimensions.len()).unwrap()]);
        dimensions.iter().for_each(|size| head.extend(u32::try_from(*size).unwrap().to_le_bytes()));
        head.extend((start as u64).to_le_bytes());
        head.extend(((numbers.len() - start) as u64).to_le_bytes());
    }
    let mut file = b"HAMAPK\x01\x02".to_vec();
    file.extend(u32::try_from(tensors.len()).unwrap().to_le_bytes());
    file.extend(head);
    file.resize(file.len().next_multiple_of(16), 0);
    file.extend(numbers);
    file
}

/// Returns the largest value of a tensor, chosen so that the output depends on the audio.
fn size(name: &str, at: usize) -> f32 {
    match name {
        // Each band has its own few bins, all with positive power.
        "mel_fb" if (at / 80 * 2 / 5).abs_diff(at % 80) > 1 => 0.0,
        "onnx::Conv_100" => 0.05,
        name if name.ends_with("bias") || name == "onnx::Conv_101" => 0.1,
        _ => 1.0,
    }
}

/// Returns a number from -1 to 1 as a 16-bit float, rounded down: sign, exponent, ten bits.
fn half(value: f32) -> [u8; 2] {
    let bits = value.to_bits();
    let (sign, exponent) = ((bits >> 16 & 0x8000) as u16, (bits >> 23 & 0xff) as u16);
    let small = if exponent < 113 { 0 } else { (exponent - 112) << 10 | (bits >> 13 & 0x3ff) as u16 };
    (sign | small).to_le_bytes()
}

/// Returns all tensors: dimensions, and whether their values have 16 bits. They are sorted by name; those without
/// individual names are in the order of the network.
fn tensors() -> BTreeMap<String, (Vec<usize>, bool)> {
    let mut all = BTreeMap::new();
    let mut add = |name: String, dimensions: &[usize]| {
        all.insert(name.clone(), (dimensions.to_vec(), name != "mel_fb"));
    };
    add("mel_fb".into(), &[201, 80]);
    add("onnx::Conv_100".into(), &[WIDTH, 80, 3]);
    add("onnx::Conv_101".into(), &[WIDTH]);
    for block in 0..BLOCKS {
        let part = |name: &str| format!("acoustic_model.model.blocks.{block}.{name}");
        for norm in ["ffn1.norm", "attn_norm", "conv.norm", "ffn2.norm", "norm"] {
            add(part(&format!("{norm}.weight")), &[WIDTH]);
            add(part(&format!("{norm}.bias")), &[WIDTH]);
        }
        for feed in ["ffn1", "ffn2"] {
            add(part(&format!("{feed}.fc1.bias")), &[INNER]);
            add(part(&format!("{feed}.fc2.bias")), &[WIDTH]);
        }
        add(part("attn.in_proj_bias"), &[3 * WIDTH]);
        add(part("attn.out_proj.bias"), &[WIDTH]);
        add(part("conv.pointwise1.weight"), &[2 * WIDTH, WIDTH, 1]);
        add(part("conv.pointwise1.bias"), &[2 * WIDTH]);
        add(part("conv.pointwise2.weight"), &[WIDTH, WIDTH, 1]);
        add(part("conv.pointwise2.bias"), &[WIDTH]);
        add(format!("onnx::Conv_{}", 102 + 2 * block), &[WIDTH, 1, KERNEL]);
        add(format!("onnx::Conv_{}", 103 + 2 * block), &[WIDTH]);
        let products =
            [[WIDTH, INNER], [INNER, WIDTH], [WIDTH, 3 * WIDTH], [WIDTH, WIDTH], [WIDTH, INNER], [INNER, WIDTH]];
        for (number, dimensions) in products.iter().enumerate() {
            add(format!("onnx::MatMul_{}", 200 + 6 * block + number), dimensions);
        }
    }
    add("acoustic_model.model.proj.weight".into(), &[TOKENS.len(), WIDTH, 1]);
    add("acoustic_model.model.proj.bias".into(), &[TOKENS.len()]);
    all
}
