//! The files of recognisers.
//!
//! They are little-endian: `LIPZ-NR1` or `LIPZ-NR2`; the hash of the rest (XXH3, 64 bits); seven 16-bit numbers
//! ([`NetworkShape`]); in `LIPZ-NR2` the factor of blanks, in thousandths of a nat (16 bits, signed); for each token, the
//! length of its name in a byte, and the name; then all values of the network, in the order in which [`Network`] reads
//! them. `LIPZ-NR1` has 16-bit floats. `LIPZ-NR2` has blocks of 64 values: a 16-bit float, and a signed byte for each
//! value, which is a multiple of the float.

use super::network::{Network, NetworkShape};
use super::phone_costs::PhoneTokens;
use super::{Recogniser, tokens};
use half::f16;
use std::error::Error;
use std::fmt;
use twox_hash::XxHash3_64;

const HALVES: &[u8; 8] = b"LIPZ-NR1";
const BYTES: &[u8; 8] = b"LIPZ-NR2";
const HASHED: usize = 16;
/// The values of a block, and its bytes.
const BLOCK: usize = 64;
const BLOCK_BYTES: usize = BLOCK + 2;
/// The factor of blanks for networks whose files have none: that of the authors of `hama`.
const BLANK_NATS: f32 = -0.1;

/// The reason why bytes are not a recogniser.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum RecogniserError {
    /// The bytes are a different kind of file.
    OtherFile,
    /// The bytes are a recogniser, but truncated or altered.
    Damaged,
    /// The bytes are a network with a different structure.
    OtherNetwork,
}

impl Recogniser {
    /// The greatest size of a recogniser's file in bytes.
    pub const LONGEST_FILE: u64 = 64 << 20;

    /// Reads a file made by [`Recogniser::convert`]. Memory is proportional to its length.
    ///
    /// # Errors
    /// If the bytes are not a recogniser, or are damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Recogniser, RecogniserError> {
        let has_bytes = bytes.starts_with(BYTES);
        if !has_bytes && !bytes.starts_with(HALVES) {
            return Err(RecogniserError::OtherFile);
        }
        let (head, mut rest) = bytes.split_at_checked(HASHED).ok_or(RecogniserError::Damaged)?;
        let hash = XxHash3_64::oneshot(rest);
        if head.get(8..) != Some(&hash.to_le_bytes()[..]) {
            return Err(RecogniserError::Damaged);
        }
        let mut take = |count: usize| {
            let (taken, left) = rest.split_at_checked(count).ok_or(RecogniserError::Damaged)?;
            rest = left;
            Ok(taken)
        };
        let mut sizes = [0; NetworkShape::SIZES];
        for size in &mut sizes {
            *size = take(2)?.iter().rev().fold(0, |number, &byte| number << 8 | usize::from(byte));
        }
        let shape = NetworkShape::from_sizes(sizes).ok_or(RecogniserError::OtherNetwork)?;
        let blank_nats = match (has_bytes, has_bytes.then(|| take(2)).transpose()?) {
            (true, Some(&[low, high])) => f32::from(i16::from_le_bytes([low, high])) / 1000.0,
            _ => BLANK_NATS,
        };
        let mut names = Vec::with_capacity(shape.tokens);
        for _ in 0..shape.tokens {
            let length = take(1)?.first().copied().unwrap_or_default();
            let name = std::str::from_utf8(take(length.into())?).map_err(|_| RecogniserError::Damaged)?;
            names.push(name.to_owned());
        }
        let numbers = if has_bytes { of_blocks(rest, shape.numbers()) } else { of_halves(rest, shape.numbers()) };
        let numbers = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()));
        let mut numbers = numbers.ok_or(RecogniserError::Damaged)?.into_iter();
        let network = Network::new(shape, &mut |count| numbers.by_ref().take(count).collect());
        let tokens = tokens::tokens(&names).ok_or(RecogniserError::OtherNetwork)?;
        let phone_tokens = PhoneTokens::new(&tokens);
        Ok(Recogniser { network, tokens, phone_tokens, blank_nats, hash })
    }
}

/// Returns so many values, or `None` if there are more or fewer.
fn of_halves(bytes: &[u8], count: usize) -> Option<Vec<f32>> {
    let numbers = bytes.as_chunks().0.iter().map(|half| f16::from_le_bytes(*half).to_f32());
    (bytes.len() == 2 * count).then(|| numbers.collect())
}

/// Returns so many values from blocks, or `None` if there are more or fewer.
fn of_blocks(bytes: &[u8], count: usize) -> Option<Vec<f32>> {
    if bytes.len() != count + 2 * count.div_ceil(BLOCK) {
        return None;
    }
    let of_block = |block: &[u8]| {
        let (unit, steps) = block.split_first_chunk().unwrap_or((&[0; 2], &[]));
        let unit = f16::from_le_bytes(*unit).to_f32();
        steps.iter().map(|step| f32::from(step.cast_signed()) * unit).collect::<Vec<f32>>()
    };
    Some(bytes.chunks(BLOCK_BYTES).flat_map(of_block).collect())
}

/// Returns the file of a network of this shape, with these names of tokens and these values.
pub(super) fn write(shape: &NetworkShape, names: &[String], numbers: &[f16]) -> Vec<u8> {
    let mut content = Vec::with_capacity(2 * numbers.len() + 4096);
    shape.sizes().iter().for_each(|size| content.extend_from_slice(&size.to_le_bytes()[..2]));
    for name in names {
        let length = u8::try_from(name.len()).unwrap_or(u8::MAX);
        content.push(length);
        content.extend(name.bytes().take(length.into()));
    }
    content.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    let mut bytes = HALVES.to_vec();
    bytes.extend_from_slice(&XxHash3_64::oneshot(&content).to_le_bytes());
    bytes.extend_from_slice(&content);
    bytes
}

impl fmt::Display for RecogniserError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            RecogniserError::OtherFile => "it is not a recogniser",
            RecogniserError::Damaged => "it is damaged",
            RecogniserError::OtherNetwork => "it contains an unknown kind of network",
        })
    }
}

impl Error for RecogniserError {}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: NetworkShape = NetworkShape { width: 4, inner: 2, kernel: 3, blocks: 1, heads: 2, tokens: 3 };

    /// Returns a file of this shape in which all values are `number`.
    fn file(shape: &NetworkShape, number: f32) -> Vec<u8> {
        let names = ["a", "<wb>", "<blank>"].map(str::to_owned);
        write(shape, &names, &vec![f16::from_f32(number); SHAPE.numbers()])
    }

    #[test]
    fn sizes_that_no_network_has_are_refused_although_the_hash_is_right() {
        assert!(Recogniser::from_bytes(&file(&SHAPE, 0.5)).is_ok());
        let others = [
            NetworkShape { width: 65_535, ..SHAPE },
            NetworkShape { inner: 0, ..SHAPE },
            NetworkShape { kernel: 4, ..SHAPE },
            NetworkShape { blocks: 60_000, ..SHAPE },
            NetworkShape { heads: 3, ..SHAPE },
            NetworkShape { heads: 0, ..SHAPE },
            NetworkShape { tokens: 65_535, ..SHAPE },
        ];
        for shape in others {
            let refused = Recogniser::from_bytes(&file(&shape, 0.5)).err();
            assert_eq!(refused, Some(RecogniserError::OtherNetwork), "{shape:?}");
        }
        for shape in [
            NetworkShape { blocks: 2, ..SHAPE },
            NetworkShape { inner: 4_096, ..SHAPE },
            NetworkShape { tokens: 4, ..SHAPE },
        ] {
            assert_eq!(Recogniser::from_bytes(&file(&shape, 0.5)).err(), Some(RecogniserError::Damaged), "{shape:?}");
        }
    }

    #[test]
    fn blocks_have_multiples_of_their_units() {
        let block = |unit: f32, steps: &[i8]| {
            let steps = steps.iter().map(|step| step.cast_unsigned());
            f16::from_f32(unit).to_le_bytes().into_iter().chain(steps).collect::<Vec<u8>>()
        };
        let bytes = [block(0.5, &[2; BLOCK]), block(2.0, &[-127, 1])].concat();
        let numbers = of_blocks(&bytes, BLOCK + 2).unwrap();
        assert_eq!((numbers.len(), numbers[BLOCK - 1], &numbers[BLOCK..]), (BLOCK + 2, 1.0, &[-254.0, 2.0][..]));
        for other in [BLOCK + 1, BLOCK + 3, 0] {
            assert_eq!(of_blocks(&bytes, other), None);
        }
    }

    #[test]
    fn the_built_in_recogniser_is_small_and_damage_is_found() {
        let bytes = include_bytes!("../../model/phones.bin");
        assert!(bytes.len() <= 1_000_000 && Recogniser::from_bytes(bytes).is_ok());
        for length in [8, 16, 30, 40, 200, bytes.len() - 1] {
            let mut short = bytes[..length].to_vec();
            if let Some((head, content)) = short.split_at_mut_checked(HASHED) {
                head[8..].copy_from_slice(&XxHash3_64::oneshot(content).to_le_bytes());
            }
            assert_eq!(Recogniser::from_bytes(&short).err(), Some(RecogniserError::Damaged), "{length}");
        }
    }

    #[test]
    fn no_file_that_ends_early_is_a_recogniser_although_its_hash_is_right() {
        let whole = file(&SHAPE, 0.5);
        for length in 0..whole.len() {
            let mut short = whole[..length].to_vec();
            if let Some((head, content)) = short.split_at_mut_checked(HASHED) {
                head[8..].copy_from_slice(&XxHash3_64::oneshot(content).to_le_bytes());
            }
            let expected = if length < HALVES.len() { RecogniserError::OtherFile } else { RecogniserError::Damaged };
            assert_eq!(Recogniser::from_bytes(&short).err(), Some(expected), "{length}");
        }
    }

    #[test]
    fn numbers_that_are_none_are_refused_and_large_ones_are_no_trouble() {
        for number in [f32::NAN, f32::INFINITY] {
            assert_eq!(Recogniser::from_bytes(&file(&SHAPE, number)).err(), Some(RecogniserError::Damaged));
        }
        let samples: Vec<f32> = (0..20_000_u16).map(|at| f32::from(at % 100) / 100.0 - 0.5).collect();
        for number in [65_504.0, -65_504.0, 0.0] {
            let _ = Recogniser::from_bytes(&file(&SHAPE, number)).unwrap().hear_samples(&samples); // no panic
        }
    }
}
