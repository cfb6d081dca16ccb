//! Conversion of the file of the package `hama` to the format of lipz.
//!
//! Its format: `HAMAPK`; two bytes of version; the number of tensors; for each tensor its name (length in 16 bits), a
//! byte for its type (0: 32-bit floats, 1: 16-bit floats), a byte for the number of dimensions, these in 32 bits each,
//! and its offset and length in bytes, 64 bits each. The values start at the next multiple of 16.

use super::file::{RecogniserError, write};
use super::network::NetworkShape;
use super::spectrum::{BINS, MELS};
use super::{Recogniser, tokens};
use half::f16;
use std::collections::HashMap;

const MAGIC: &[u8] = b"HAMAPK\x01\x02";
/// The alignment of the values in bytes.
const ALIGNMENT: usize = 16;
/// The number of attention heads, which is not in the file.
const HEADS: usize = 4;
/// The prefixes of tensors without individual names, in the order of the network.
const CONVOLUTIONS: &str = "onnx::Conv_";
const PRODUCTS: &str = "onnx::MatMul_";
/// The number of products of a block.
const PRODUCTS_OF_BLOCK: usize = 6;

impl Recogniser {
    /// Converts `asr_waveform.hama` of the Python package `hama`, whose tokens have these names, to the bytes of a file
    /// for [`Recogniser::from_bytes`].
    ///
    /// # Errors
    /// If the bytes are not such a file, or are damaged.
    pub fn convert(hama: &[u8], names: &[String]) -> Result<Vec<u8>, RecogniserError> {
        let tensors = Tensors::parse(hama)?;
        tokens::tokens(names).ok_or(RecogniserError::OtherNetwork)?;
        let shape = tensors.shape(names.len()).ok_or(RecogniserError::OtherNetwork)?;
        let numbers = tensors.numbers(&shape).ok_or(RecogniserError::OtherNetwork)?;
        if numbers.len() != shape.numbers() || numbers.iter().any(|number| !number.is_finite()) {
            return Err(RecogniserError::Damaged);
        }
        Ok(write(&shape, names, &numbers))
    }
}

struct Tensor<'b> {
    dimensions: Vec<usize>,
    is_half: bool,
    bytes: &'b [u8],
}

struct Tensors<'b> {
    by_name: HashMap<String, Tensor<'b>>,
    convolutions: Vec<String>,
    products: Vec<String>,
}

impl<'b> Tensors<'b> {
    fn parse(bytes: &'b [u8]) -> Result<Tensors<'b>, RecogniserError> {
        let mut rest = bytes.strip_prefix(MAGIC).ok_or(RecogniserError::OtherFile)?;
        let mut take = |count: usize| {
            let (taken, left) = rest.split_at_checked(count).ok_or(RecogniserError::Damaged)?;
            rest = left;
            Ok(taken)
        };
        let whole = |bytes: &[u8]| bytes.iter().rev().fold(0, |number: u64, &byte| number << 8 | u64::from(byte));
        let size = |number: u64| usize::try_from(number).map_err(|_| RecogniserError::Damaged);
        let count = whole(take(4)?);
        let mut places = Vec::new();
        for _ in 0..count {
            let length = size(whole(take(2)?))?;
            let name = String::from_utf8_lossy(take(length)?).into_owned();
            let kind = take(2)?;
            let (is_half, depth) = (kind[0] == 1, kind[1]);
            let dimensions: Result<Vec<usize>, _> = (0..depth).map(|_| size(whole(take(4)?))).collect();
            let (start, length) = (size(whole(take(8)?))?, size(whole(take(8)?))?);
            places.push((name, is_half, dimensions?, start, length));
        }
        let base = (bytes.len() - rest.len()).next_multiple_of(ALIGNMENT);
        let mut tensors = Tensors { by_name: HashMap::new(), convolutions: Vec::new(), products: Vec::new() };
        for (name, is_half, dimensions, start, length) in places {
            let numbers = dimensions.iter().try_fold(1_usize, |product, &size| product.checked_mul(size));
            let start = start.checked_add(base).ok_or(RecogniserError::Damaged)?;
            let end = start.checked_add(length).ok_or(RecogniserError::Damaged)?;
            let bytes = bytes.get(start..end).ok_or(RecogniserError::Damaged)?;
            if numbers.and_then(|numbers| numbers.checked_mul(if is_half { 2 } else { 4 })) != Some(length) {
                return Err(RecogniserError::Damaged);
            }
            for (prefix, list) in [(CONVOLUTIONS, &mut tensors.convolutions), (PRODUCTS, &mut tensors.products)] {
                if name.starts_with(prefix) {
                    list.push(name.clone());
                }
            }
            tensors.by_name.insert(name, Tensor { dimensions, is_half, bytes });
        }
        Ok(tensors)
    }

    fn shape(&self, tokens: usize) -> Option<NetworkShape> {
        let dimensions = |name: &str| Some(self.by_name.get(name)?.dimensions.as_slice());
        let blocks = self.convolutions.len().checked_div(2)?.checked_sub(1)?;
        let [width, MELS, 3] = *dimensions(self.convolutions.first()?)? else { return None };
        let [_, 1, kernel] = *dimensions(self.convolutions.get(2)?)? else { return None };
        let [_, inner] = *dimensions(self.products.first()?)? else { return None };
        let shape = NetworkShape::from_sizes([MELS, width, inner, kernel, blocks, HEADS, tokens])?;
        (self.products.len() == blocks * PRODUCTS_OF_BLOCK).then_some(shape)
    }

    /// Returns all values in the order of the lipz format.
    fn numbers(&self, shape: &NetworkShape) -> Option<Vec<f16>> {
        let NetworkShape { width, inner, kernel, tokens, .. } = *shape;
        let mut numbers = Vec::with_capacity(shape.numbers());
        let mut add = |name: &str, dimensions: &[usize], order: &[usize]| {
            numbers.extend(self.by_name.get(name)?.transposed(dimensions, order)?);
            Some(())
        };
        let model = |name: &str| format!("acoustic_model.model.{name}");
        let (convolutions, products) = (&self.convolutions, &self.products);
        add("mel_fb", &[BINS, MELS], &[0, 1])?;
        add(&convolutions[0], &[width, MELS, 3], &[2, 1, 0])?;
        add(&convolutions[1], &[width], &[0])?;
        for block in 0..shape.blocks {
            let part = |name: &str| model(&format!("blocks.{block}.{name}"));
            let product = |number: usize| products[block * PRODUCTS_OF_BLOCK + number].as_str();
            for (first, name) in [(0, "ffn1"), (4, "ffn2")] {
                if name == "ffn2" {
                    add(&part("attn_norm.weight"), &[width], &[0])?;
                    add(&part("attn_norm.bias"), &[width], &[0])?;
                    add(product(2), &[width, 3 * width], &[0, 1])?;
                    add(&part("attn.in_proj_bias"), &[3 * width], &[0])?;
                    add(product(3), &[width, width], &[0, 1])?;
                    add(&part("attn.out_proj.bias"), &[width], &[0])?;
                    add(&part("conv.norm.weight"), &[width], &[0])?;
                    add(&part("conv.norm.bias"), &[width], &[0])?;
                    add(&part("conv.pointwise1.weight"), &[2 * width, width, 1], &[1, 0, 2])?;
                    add(&part("conv.pointwise1.bias"), &[2 * width], &[0])?;
                    add(&convolutions[2 + 2 * block], &[width, 1, kernel], &[2, 0, 1])?;
                    add(&convolutions[3 + 2 * block], &[width], &[0])?;
                    add(&part("conv.pointwise2.weight"), &[width, width, 1], &[1, 0, 2])?;
                    add(&part("conv.pointwise2.bias"), &[width], &[0])?;
                }
                add(&part(&format!("{name}.norm.weight")), &[width], &[0])?;
                add(&part(&format!("{name}.norm.bias")), &[width], &[0])?;
                add(product(first), &[width, inner], &[0, 1])?;
                add(&part(&format!("{name}.fc1.bias")), &[inner], &[0])?;
                add(product(first + 1), &[inner, width], &[0, 1])?;
                add(&part(&format!("{name}.fc2.bias")), &[width], &[0])?;
            }
            add(&part("norm.weight"), &[width], &[0])?;
            add(&part("norm.bias"), &[width], &[0])?;
        }
        add(&model("proj.weight"), &[tokens, width, 1], &[1, 0, 2])?;
        add(&model("proj.bias"), &[tokens], &[0])?;
        Some(numbers)
    }
}

impl Tensor<'_> {
    /// Returns the values with their dimensions in this order, or `None` if the tensor does not have these dimensions.
    fn transposed(&self, dimensions: &[usize], order: &[usize]) -> Option<Vec<f16>> {
        if self.dimensions != dimensions {
            return None;
        }
        let number = |at: usize| match self.is_half {
            true => Some(f16::from_le_bytes(self.bytes.get(2 * at..2 * at + 2)?.try_into().ok()?)),
            false => Some(f16::from_f32(f32::from_le_bytes(self.bytes.get(4 * at..4 * at + 4)?.try_into().ok()?))),
        };
        // The distance between neighbours in each dimension.
        let step = |dimension: usize| dimensions.iter().skip(dimension + 1).product::<usize>();
        let mut places = vec![0];
        for &dimension in order {
            let next = |&place: &usize| (0..dimensions[dimension]).map(move |at| place + at * step(dimension));
            places = places.iter().flat_map(next).collect();
        }
        places.into_iter().map(number).collect()
    }
}
