//! The file of a recogniser.
//!
//! It is little-endian: `LIPZ-NR1`; the hash of the rest (XXH3, 64 bits); seven 16-bit numbers ([`NetworkShape`]); for each
//! token, the length of its name in a byte, and the name; then all values of the network as 16-bit floats, in the order
//! in which [`Network`] reads them.

use super::network::{Network, NetworkShape};
use super::{Recogniser, tokens};
use half::f16;
use std::error::Error;
use std::fmt;
use twox_hash::XxHash3_64;

const MAGIC: &[u8; 8] = b"LIPZ-NR1";
const HASHED: usize = 16;

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
        if !bytes.starts_with(MAGIC) {
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
        let mut names = Vec::with_capacity(shape.tokens);
        for _ in 0..shape.tokens {
            let length = take(1)?.first().copied().unwrap_or_default();
            let name = std::str::from_utf8(take(length.into())?).map_err(|_| RecogniserError::Damaged)?;
            names.push(name.to_owned());
        }
        if rest.len() != 2 * shape.numbers() {
            return Err(RecogniserError::Damaged);
        }
        let mut numbers = rest.chunks_exact(2).map(|half| f16::from_le_bytes([half[0], half[1]]).to_f32());
        if numbers.clone().any(|number| !number.is_finite()) {
            return Err(RecogniserError::Damaged);
        }
        let network = Network::new(shape, &mut |count| numbers.by_ref().take(count).collect());
        let tokens = tokens::tokens(&names).ok_or(RecogniserError::OtherNetwork)?;
        Ok(Recogniser { network, tokens, hash })
    }
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
    let mut bytes = MAGIC.to_vec();
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
    fn no_file_that_ends_early_is_a_recogniser_although_its_hash_is_right() {
        let whole = file(&SHAPE, 0.5);
        for length in 0..whole.len() {
            let mut short = whole[..length].to_vec();
            if let Some((head, content)) = short.split_at_mut_checked(HASHED) {
                head[8..].copy_from_slice(&XxHash3_64::oneshot(content).to_le_bytes());
            }
            let expected = if length < MAGIC.len() { RecogniserError::OtherFile } else { RecogniserError::Damaged };
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
