//! The file of a trained model: its head, and the acoustic model.
//!
//! It is little-endian: `LIPZ-TM1`; the hash of the rest (XXH3, 64 bits); the hash of the training data; the seconds of
//! speech and the number of recordings, 32 bits each; the code of the language in 8 bytes; then the file of the
//! acoustic model.

use crate::{Language, Model};
use std::error::Error;
use std::fmt;
use twox_hash::XxHash3_64;

const MAGIC: &[u8; 8] = b"LIPZ-TM1";
const HEAD: usize = 8 + 8 + 8 + 4 + 4 + 8;

/// An acoustic model that was trained on recordings: see [`Training`](crate::Training).
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct TrainedModel {
    /// The model.
    pub model: Model,
    /// The language of the recordings.
    pub language: Language,
    /// A hash of the training data, which the caller of the training defines.
    pub origin: u64,
    /// The amount of speech in the training data, in seconds.
    pub speech_s: u32,
    /// The number of recordings in the training data.
    pub recordings: u32,
}

/// The reason why bytes are not a trained model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum ModelError {
    /// The bytes are a different kind of file.
    OtherFile,
    /// The bytes are a model, but truncated or altered.
    Damaged,
}

impl TrainedModel {
    /// The greatest size of a model's file in bytes.
    pub const LONGEST_FILE: u64 = 1 << 20;

    /// Returns a model that was trained on `speech_s` seconds of speech in so many recordings.
    pub fn new(model: Model, language: Language, origin: u64, speech_s: u32, recordings: u32) -> TrainedModel {
        TrainedModel { model, language, origin, speech_s, recordings }
    }

    /// Returns the bytes of the file. The values are slightly rounded, so a model that is read differs a little from
    /// the one that was written. The same model always produces the same bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut content = self.origin.to_le_bytes().to_vec();
        content.extend_from_slice(&self.speech_s.to_le_bytes());
        content.extend_from_slice(&self.recordings.to_le_bytes());
        let mut code = [0; 8];
        code.iter_mut().zip(self.language.code().bytes()).for_each(|(to, byte)| *to = byte);
        content.extend_from_slice(&code);
        content.extend_from_slice(&self.model.to_bytes());
        let mut bytes = MAGIC.to_vec();
        bytes.extend_from_slice(&XxHash3_64::oneshot(&content).to_le_bytes());
        bytes.extend_from_slice(&content);
        bytes
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// If the bytes are not a model, or are damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<TrainedModel, ModelError> {
        if !bytes.starts_with(MAGIC) {
            return Err(ModelError::OtherFile);
        }
        let (head, model) = bytes.split_at_checked(HEAD).ok_or(ModelError::Damaged)?;
        let eight = |at: usize| head.get(at..at + 8).and_then(|eight| eight.try_into().ok()).unwrap_or([0; 8]);
        let [speech_s, recordings] = [24, 28].map(|at| {
            let four = head.get(at..at + 4).and_then(|four| four.try_into().ok()).unwrap_or([0; 4]);
            u32::from_le_bytes(four)
        });
        if XxHash3_64::oneshot(&bytes[16..]) != u64::from_le_bytes(eight(8)) {
            return Err(ModelError::Damaged);
        }
        let code = eight(32);
        let code = std::str::from_utf8(&code).map_err(|_| ModelError::Damaged)?.trim_end_matches('\0');
        let language = Language::from_locale(code).ok_or(ModelError::Damaged)?;
        let model = Model::from_bytes(model).map_err(|_| ModelError::Damaged)?;
        Ok(TrainedModel { model, language, origin: u64::from_le_bytes(eight(16)), speech_s, recordings })
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ModelError::OtherFile => "it is not a voice model",
            ModelError::Damaged => "it is damaged",
        })
    }
}

impl Error for ModelError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_is_read_as_it_was_written_and_nothing_else_is() {
        let model = TrainedModel::new(Model::english().clone(), Language::OTHER, 7, 61, 12);
        let bytes = model.to_bytes();
        assert!(bytes.len() as u64 <= TrainedModel::LONGEST_FILE);
        let read = TrainedModel::from_bytes(&bytes).unwrap();
        assert_eq!((read.language, read.origin, read.speech_s, read.recordings), (Language::OTHER, 7, 61, 12));
        assert!(read.to_bytes() == bytes);
        for length in [0, 7, 8, 39, 40, 41, 500, bytes.len() - 1] {
            assert!(TrainedModel::from_bytes(&bytes[..length]).is_err(), "{length}");
        }
        for at in (0..bytes.len()).step_by(997).chain(0..HEAD) {
            let mut other = bytes.clone();
            other[at] ^= 0x10;
            assert!(TrainedModel::from_bytes(&other).is_err(), "{at}");
        }
    }

    #[test]
    fn no_file_that_ends_early_is_a_model_although_its_hash_is_right() {
        let whole = TrainedModel::new(Model::english().clone(), Language::ENGLISH, 0, 0, 0).to_bytes();
        // Every byte of both heads and of the last probabilities, and some bytes in between.
        let heads = 0..HEAD + 16 + 8 * 42;
        let last = whole.len() - 64..whole.len();
        for length in heads.clone().chain((heads.end..last.start).step_by(29_989)).chain(last) {
            let mut short = whole[..length].to_vec();
            if let Some((head, content)) = short.split_at_mut_checked(16) {
                head[8..].copy_from_slice(&XxHash3_64::oneshot(content).to_le_bytes());
            }
            let expected = if length < MAGIC.len() { ModelError::OtherFile } else { ModelError::Damaged };
            assert_eq!(TrainedModel::from_bytes(&short).err(), Some(expected), "{length}");
        }
    }

    #[test]
    fn numbers_that_make_no_sense_are_refused_although_the_hash_is_right() {
        let model = TrainedModel::new(Model::english().clone(), Language::ENGLISH, 0, 0, 0).to_bytes();
        // A mean, a sigma, and the last probability, as NaN, infinite or negative numbers.
        let sigmas = HEAD + 16 + 8 * 42 + 2 * 42 * 3 * 128 * 13;
        for at in [HEAD + 16 + 8 * 42, sigmas, model.len() - 40 * 40 - 2] {
            for half in [0x7e00_u16, 0x7c00, 0xbc00] {
                let mut other = model.clone();
                other[at..at + 2].copy_from_slice(&half.to_le_bytes());
                let hash = XxHash3_64::oneshot(&other[16..]).to_le_bytes();
                other[8..16].copy_from_slice(&hash);
                let is_mean = half == 0xbc00 && at < sigmas;
                assert_eq!(TrainedModel::from_bytes(&other).is_ok(), is_mean, "{at} {half:x}");
            }
        }
    }
}
